// What the process protocol sends of a tree of bodies or a robot: docs/adapters.md.

#include <gtest/gtest.h>

#include <adapters/trees.hpp>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <nlohmann/json.hpp>
#include <operations/numbers.hpp>

#include "../own_subject.hpp"
#include "pages.hpp"

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
const Scalar& in_double = oracles::scalar_of<double>;

Adapter& nobody() {
  throw AdapterFailed("the adapter was called");
}

TEST(TreeModels, AreSentAsTheDocumentationSays) {
  const std::string page = read("docs/adapters.md");
  const adapters::Model model(pendulum(), {}, in_double, nobody);
  EXPECT_NE(page.find("\n    model " + model.text() + "\n"), page.npos) << model.text();
  for (const std::string& name : joint_names()) EXPECT_NE(page.find('`' + name + '`'), page.npos) << name;
}

TEST(TreeModels, OfAUrdfAreItsTextIfTheAdapterTakesIt) {
  Tree<double> tree = pendulum();
  tree.urdf = std::make_shared<UrdfModel>(UrdfModel{"<robot/>", true, false, {"hinge"}, 1, 1});
  const std::string joints = adapters::Model(pendulum(), {}, in_double, nobody).text();
  EXPECT_EQ(adapters::Model(tree, {}, in_double, nobody).text(), joints);
  Description reader;
  reader.models = {"urdf", "joints"};
  EXPECT_EQ(adapters::Model(pendulum(), reader, in_double, nobody).text(), joints);
  EXPECT_EQ(
      adapters::Model(tree, reader, in_double, nobody).text(),
      R"({"gravity":[0.0,0.0,-9.81],"nq":1,"nv":1,"order":["hinge"],"root":"fixed","urdf":"<robot/>"})");
}

TEST(TreeModels, OfOtherJointsAreNotSent) {
  using Taken = std::set<std::string>;
  const std::pair<Taken, Outcome> cases[] = {{Taken{"revolute"}, Outcome::outside_domain},
                                             {Taken{"armature", "prismatic"}, Outcome::outside_domain},
                                             {Taken{"revolute", "armature"}, Outcome::crashed}};
  for (const auto& [takes, outcome] : cases) {
    Description adapter;
    adapter.joints = takes;
    const double q = 0;
    double result;
    try {
      adapters::Model(pendulum(), adapter, in_double, nobody).call(op::tree_crba, &q, &result);
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
  const adapters::Model model(tree, {}, in_double, nobody);
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

/// The operations on configurations of liecheck itself. With a fault, derivatives are those of the other argument.
class OwnRobots final : public Adapter {
 public:
  OwnRobots() {
    RobotOperations<double>::for_each(
        [&](const Operation& o) { description_.offered.emplace(std::string(o.name), "double"); });
  }
  bool fault = false;
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    const auto model = nlohmann::json::parse(b.model);
    const std::string urdf = model["urdf"];
    const auto order = urdf_model(urdf, model["root"] == "fixed");
    EXPECT_EQ(model["order"], nlohmann::json(order->joints));
    const auto o = own_subject().operations.robot(urdf, order->fixed);
    const auto give = [&](const auto& slot, const auto& operation) {
      if (b.operation.operation != operation.name) return;
      const auto numbers =
          called(slot, operation, reinterpret_cast<const double*>(b.inputs.data()), {order->nq, order->nv});
      EXPECT_EQ(numbers.size(), b.operation.results);
      std::ranges::copy(numbers, reinterpret_cast<double*>(b.results.data()));
    };
    const auto& arg0 = o[op::robot_d_integrate_arg0];
    give(o[op::robot_integrate], op::robot_integrate), give(o[op::robot_difference], op::robot_difference);
    give(o[op::robot_is_same], op::robot_is_same), give(arg0, op::robot_d_integrate_arg0);
    give(fault ? arg0 : o[op::robot_d_integrate_arg1], op::robot_d_integrate_arg1);
    give(o[op::robot_d_difference_arg0], op::robot_d_difference_arg0);
    give(o[op::robot_d_difference_arg1], op::robot_d_difference_arg1);
    return "";
  }

 private:
  Description description_{"own_robots", "1", {}, {}, {}, {"urdf"}, {}};
};
OwnRobots& own_robots() {
  static OwnRobots own;
  return own;
}

TEST(RobotModels, TakeTheOperationsOnConfigurationsOverTheWire) {
  Subject tested{"own_robots", "1", "", &in_double};
  tested.operations.robot = [](const std::string& urdf, bool fixed) {
    RobotOperations<double> o;
    fill_robot(o, *urdf_model(urdf, fixed), in_double, []() -> Adapter& { return own_robots(); });
    return o;
  };
  EXPECT_TRUE(offers_robots(own_robots().description(), "double"));
  EXPECT_FALSE(offers_robots(own_robots().description(), "float"));
  for (const bool fault : {false, true}) {
    own_robots().fault = fault;
    for (const char* law : {"robot_configuration", "robot_derivatives"}) {
      Tally tally;
      for (std::uint64_t i = 0; i < 20; ++i) series_of(law, tested, built_in_robot())->run(42, i, tally);
      std::uint64_t failed = 0;
      for (const auto& [cell, row] : tally.rows) failed += row.failed;
      EXPECT_EQ(failed > 0, fault && law == std::string("robot_derivatives")) << law;
    }
  }
}

}  // namespace
}  // namespace liecheck::properties::adapters
