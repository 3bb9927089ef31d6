// What the process protocol sends of a tree of bodies: docs/adapters.md.

#include <gtest/gtest.h>

#include <adapters/trees.hpp>
#include <fstream>
#include <invariants/property.hpp>
#include <sstream>

namespace liecheck::properties::adapters {
namespace {

/// A pendulum of 2 kg on an axis along y.
Tree<double> pendulum() {
  oracles::JointOf<double> j;
  j.Q = {{0, 0, 0, 1}}, j.p = {{0, 0, 1}}, j.axis = {{0, 1, 0}};
  j.pitch = j.multiplier = j.offset = 0, j.armature = 0.25;
  j.body = {2, {{0, 0, -0.5}}, {{0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.05}}};
  Tree<double> tree;
  tree.joints = {j}, tree.gravity = {{0, 0, -9.81}};
  tree.frame_Q = j.Q, tree.frame_p = {{0, 0, -1}};
  tree.index();
  return tree;
}
Adapter& nobody() {
  throw AdapterFailed("the adapter was called");
}

TEST(TreeModels, AreSentAsTheDocumentationSays) {
  std::ostringstream page;
  page << std::ifstream(LIECHECK_FIXTURES "/../docs/adapters.md").rdbuf();
  const adapters::Model<double> model(pendulum(), {}, nobody);
  EXPECT_NE(page.str().find("\n    model " + model.text() + "\n"), std::string::npos) << model.text();
  for (const std::string& name : joint_names())
    EXPECT_NE(page.str().find('`' + name + '`'), std::string::npos) << name;
}

TEST(TreeModels, OfAUrdfAreItsTextIfTheAdapterTakesIt) {
  Tree<double> tree = pendulum();
  tree.urdf = std::make_shared<UrdfModel>(UrdfModel{"<robot/>", true, {"hinge"}, 1, 1});
  const std::string joints = adapters::Model<double>(pendulum(), {}, nobody).text();
  EXPECT_EQ(adapters::Model<double>(tree, {}, nobody).text(), joints);
  Description reader;
  reader.models = {"urdf", "joints"};
  EXPECT_EQ(adapters::Model<double>(pendulum(), reader, nobody).text(), joints);
  EXPECT_EQ(adapters::Model<double>(tree, reader, nobody).text(),
            R"({"gravity":[0.0,0.0,-9.81],"order":["hinge"],"root":"fixed","urdf":"<robot/>"})");
}

TEST(TreeModels, OfOtherJointsAreNotSent) {
  using Taken = std::set<std::string>;
  const std::pair<Taken, Outcome> cases[] = {{Taken{"revolute"}, Outcome::outside_domain},
                                             {Taken{"armature", "prismatic"}, Outcome::outside_domain},
                                             {Taken{"revolute", "armature"}, Outcome::crashed}};
  for (const auto& [takes, outcome] : cases) {
    Description adapter;
    adapter.joints = takes;
    try {
      adapters::Model<double>(pendulum(), adapter, nobody).call(op::tree_crba, {0});
      ADD_FAILURE();
    } catch (const CallFailed& e) {
      EXPECT_EQ(e.outcome, outcome) << e.what();
    }
  }
}

TEST(TreeModels, DetermineTheNumbersOfACall) {
  Tree<double> tree = pendulum();
  tree.joints[0].kind = oracles::JointKind::free_flyer;
  tree.index();
  const adapters::Model<double> model(tree, {}, nobody);
  const std::tuple<const Operation&, std::size_t, std::size_t> cases[] = {
      {op::frame_velocity, 22, 6},         {op::frame_pose, 7 + 8, 12},
      {op::tree_rnea, 7 + 6 + 6 + 7, 6},   {op::tree_crba, 7, 36},
      {op::frame_jacobian, 7 + 1 + 8, 36}, {op::rnea_derivatives, 7 + 6 + 6 + 7, 72},
      {op::tree_kinetic_energy, 7 + 6, 1}, {op::tree_momentum, 7 + 6, 6},
      {op::robot_integrate, 7 + 6, 7},     {op::robot_difference, 7 + 7, 6},
      {op::robot_is_same, 7 + 7, 1}};
  for (const auto& [operation, inputs, results] : cases) {
    EXPECT_EQ(model.sizes(operation).inputs, inputs) << operation.name;
    EXPECT_EQ(model.sizes(operation).results, results) << operation.name;
  }
}

}  // namespace
}  // namespace liecheck::properties::adapters
