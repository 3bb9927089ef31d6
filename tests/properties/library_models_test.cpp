// Shared libraries with version 2 of the C interface: models, an object with a state, and a library's own checks.

#include <gtest/gtest.h>

#include <adapters/check.hpp>
#include <adapters/flat_model.hpp>
#include <adapters/liecheck_adapter.hpp>
#include <adapters/subjects.hpp>
#include <adapters/trees.hpp>
#include <array>
#include <set>
#include <span>
#include <stdexcept>

#include "../campaigns.hpp"
#include "../refusal.hpp"
#include "../shell.hpp"
#include "asked.hpp"

namespace liecheck::properties::adapters {
namespace {

constexpr const char* in_process = "in-process:" LIECHECK_HINGES;

UrdfModel pendulum(bool fixed) {
  return *urdf_model(R"(<robot name="pendulum"><link name="base"/><link name="bob"><inertial><mass value="2"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="hinge" type="revolute"><parent link="base"/><child link="bob"/><axis xyz="0 1 0"/>
      <limit effort="1" velocity="1" lower="-9" upper="9"/></joint></robot>)",
                     fixed);
}

TEST(LibraryModels, ASimulatorInCppObeysEveryLawOfWhatItOffers) {
  const auto adapter = start(in_process);
  EXPECT_EQ(adapter->description().joints, (std::set<std::string>{"armature", "prismatic", "revolute"}));
  const Checked checked = check(*adapter);
  EXPECT_TRUE(checked.findings.empty());
  std::set<std::string> operations;
  for (const CheckedOperation& o : checked.operations) {
    operations.insert(o.operation);
    EXPECT_EQ(o.complaint, "") << o.operation << o.scalar;
  }
  EXPECT_EQ(operations,
            (std::set<std::string>{"tree_crba", "tree_gravity", "tree_nonlinear_effects", "tree_rnea"}));

  const CampaignResult r = run_quietly({{register_adapter(in_process)}, {}, {}}, 200, 2);
  EXPECT_FALSE(r.failed);
  std::set<std::string> laws;
  for (const SeriesResult& s : r.series) laws.insert(s.series->property);
  EXPECT_EQ(laws, (std::set<std::string>{"lagrange", "mass_matrix", "power_balance", "tree_invariance"}));
}

TEST(LibraryModels, ASimulatorInAProcessOfItsOwnGivesTheSame) {
  EXPECT_EQ(shell(LIECHECK_PROGRAM " adapter check " LIECHECK_HINGES).code, 0);
  EXPECT_EQ(shell(LIECHECK_PROGRAM
                  " campaign --no-hard-cases --cases 30 --property lagrange --adapter " LIECHECK_HINGES)
                .code,
            0);
}

TEST(LibraryModels, TheListOfOperationsOnModelsHasTheirSizes) {
  std::set<std::string> listed;
  for (const auto kind : {oracles::JointKind::revolute, oracles::JointKind::free_flyer}) {
    Tree<double> tree;
    tree.joints.emplace_back();
    tree.joints[0].kind = kind, tree.joints[0].parent = tree.joints[0].primary = -1;
    tree.index();
    const Model model(tree, Description{}, oracles::scalar_of<double>, nullptr);
    const auto compare = [&](const char* name, adapter::ModelSize in, adapter::ModelSize out) {
      const Operation* const o = model_operation(name);
      ASSERT_TRUE(o) << name;
      const OperationSizes sizes = model.sizes(*o);
      const auto nq = std::size_t(model.size().nq), nv = std::size_t(model.size().nv);
      EXPECT_EQ(in.of(nq, nv), sizes.inputs) << name;
      EXPECT_EQ(out.of(nq, nv), sizes.results) << name;
      listed.insert(name);
    };
#define LIECHECK_MODEL_OPERATION(name, q_in, v_in, one_in, q_out, v_out, vv_out, one_out) \
  compare(#name, {q_in, v_in, 0, one_in}, {q_out, v_out, vv_out, one_out});
#include <adapters/liecheck_model_operations.inc>
#undef LIECHECK_MODEL_OPERATION
  }
  EXPECT_EQ(listed.size(), model_operations().size());
}

TEST(LibraryModels, AModelIsFlatAsItIsWritten) {
  const UrdfModel robot = pendulum(false);
  const Model of_urdf(robot, oracles::scalar_of<double>, nullptr);
  const FlatModel urdf(of_urdf.text());
  EXPECT_EQ(urdf.model().urdf, robot.text);
  EXPECT_EQ(urdf.model().fixed, 0);
  EXPECT_EQ(urdf.model().nq, 8u);
  ASSERT_EQ(urdf.model().order_count, 2u);
  EXPECT_EQ(urdf.model().order[1], std::string("hinge"));

  Tree<double> tree;
  oracles::JointOf<double> j;
  j.kind = oracles::JointKind::helical, j.parent = -1, j.primary = -1, j.pitch = 0.5, j.armature = 3;
  j.Q = {{0.5, -0.5, 0.5, 0.5}}, j.p = {{1, 2, 3}}, j.axis = {{0, 0, 1}};
  j.body = {4, {{5, 6, 7}}, {{1, 0, 0, 0, 2, 0, 0, 0, 3}}};
  tree.joints.push_back(j);
  j.kind = oracles::JointKind::revolute, j.parent = 0, j.primary = 0, j.multiplier = -2, j.offset = 0.25;
  tree.joints.push_back(j);
  tree.gravity = {{0, 0, -9}}, tree.index();
  const Model of_tree(tree, Description{}, oracles::scalar_of<double>, nullptr);
  const FlatModel list(of_tree.text());
  const liecheck_model& m = list.model();
  ASSERT_EQ(m.joint_count, 2u);
  EXPECT_EQ(m.urdf, nullptr);
  EXPECT_EQ(m.nv, 1u);
  EXPECT_EQ(m.gravity[2], -9);
  EXPECT_EQ(m.joints[0].kind, std::string("helical"));
  EXPECT_EQ(m.joints[0].pitch, 0.5);
  EXPECT_EQ(m.joints[0].armature, 3);
  EXPECT_EQ(m.joints[0].mimic, -1);
  EXPECT_EQ(m.joints[0].Q[1], -0.5);
  EXPECT_EQ(m.joints[1].parent, 0);
  EXPECT_EQ(m.joints[1].mimic, 0);
  EXPECT_EQ(m.joints[1].multiplier, -2);
  EXPECT_EQ(m.joints[1].offset, 0.25);
  ASSERT_EQ(m.body_count, 2u);
  EXPECT_EQ(m.bodies[1].joint, 1);
  EXPECT_EQ(m.bodies[0].mass, 4);
  EXPECT_EQ(m.bodies[0].c[2], 7);
  EXPECT_EQ(m.bodies[0].I_C[4], 2);
}

}  // namespace

struct Refusing {
  static constexpr const char *name = "refusing", *version = "1", *models = "urdf";
  struct Model {
    explicit Model(const liecheck_model&) { throw std::domain_error("no arms"); }
    void tree_crba(std::span<const double>, std::span<double>) {}
  };
};
LIECHECK_SUBJECT(Refusing)

struct Odd {
  static constexpr const char *name = "odd", *version = "1", *models = "urdf";
  struct Model {
    explicit Model(const liecheck_model& model) {
      if (model.fixed) throw 42;
    }
    void tree_crba(std::span<const double>, std::span<double> M) { M[0] = 1; }
  };
};
LIECHECK_SUBJECT(Odd)

/// An object with a state: exp3_quaternion is right if factor is 1.
struct Scaled {
  const char *name = "scaled", *version = "1";
  double factor = 1;
  void exp3_quaternion(std::span<const double, 3> phi, std::span<double, 4> Q) const {
    std::ranges::copy(phi, Q.begin());
    Q[3] = factor;
  }
  static void check_quaternion(std::span<const double, 4> Q) {
    if (Q[3] == 0) throw std::domain_error("w is 0");
  }
};
LIECHECK_SUBJECT(Scaled, exp3_quaternion)

/// A library whose words would colour a terminal.
struct Coloured {
  static constexpr const char *name = "coloured", *version = "1\x1b[31m";
  static void exp3_quaternion(std::span<const double, 3>, std::span<double, 4>) {
    throw std::domain_error("no \x1b[2J");
  }
};
LIECHECK_SUBJECT(Coloured, exp3_quaternion)

namespace {

TEST(LibraryModels, WordsOfALibraryHaveNoControlCharacters) {
  const auto adapter = linked(liecheck_subject(static_cast<const Coloured*>(nullptr)));
  EXPECT_EQ(adapter->description().version, "1\\x1b[31m");
  const std::array<double, 3> phi{};
  std::array<double, 4> Q{};
  std::array<Status, 1> status{};
  EXPECT_EQ(adapter->call({*sizes_of("exp3_quaternion"), true, 1, std::as_bytes(std::span(phi)),
                           std::as_writable_bytes(std::span(Q)), status}),
            "no \\x1b[2J");
  EXPECT_EQ(status[0], Status::refused);
}

TEST(LibraryModels, ARefusedModelIsSaidInWords) {
  const auto adapter = linked(liecheck_subject(static_cast<const Refusing*>(nullptr)));
  EXPECT_EQ(adapter->description().models, (std::set<std::string>{"urdf"}));
  const UrdfModel robot = pendulum(true);
  const Model model(robot, oracles::scalar_of<double>, [&]() -> Adapter& { return *adapter; });
  EXPECT_EQ(test::refusal<std::domain_error>([&] { asked(model, op::tree_crba, {0.1}); }),
            "the input is refused: the model is refused: no arms");
}

TEST(LibraryModels, AnotherExceptionIsARefusalAndAnUnwrittenResultIsNone) {
  const auto adapter = linked(liecheck_subject(static_cast<const Odd*>(nullptr)));
  const auto call = [&](const UrdfModel& robot, std::vector<double> q) {
    asked(Model(robot, oracles::scalar_of<double>, [&]() -> Adapter& { return *adapter; }), op::tree_crba, q);
  };
  EXPECT_THROW(call(pendulum(true), {0.1}), std::domain_error);
  try {
    call(pendulum(false), {0, 0, 0, 0, 0, 0, 1, 0.1});
    FAIL() << "its result counts";
  } catch (const CallFailed& e) {
    EXPECT_EQ(e.outcome, Outcome::output_unwritten);
  }
}

TEST(LibraryModels, OfWhatCannotOpenThemAreSaidInWords) {
  liecheck_adapter without = liecheck_subject(static_cast<const Odd*>(nullptr));
  without.open_model = nullptr;
  EXPECT_EQ(test::refusal<AdapterFailed>([&] { linked(without); }),
            "the linked adapter has no open_model, without which it takes no model");
}

TEST(LibraryModels, AnObjectHasItsOwnStateAndChecks) {
  Scaled one, two;
  two.factor = 2;
  for (Scaled* const object : {&one, &two}) {
    const liecheck_adapter described = liecheck_described(*object);
    const auto adapter = linked(described);
    EXPECT_EQ(adapter->description().offered,
              (std::set<std::pair<std::string, std::string>>{{"check_quaternion", "double"},
                                                             {"exp3_quaternion", "double"}}));
    const std::array<double, 4> in{0.1, 0.2, 0.3, 0};
    std::array<double, 4> Q{};
    std::array<Status, 1> status{};
    const std::span<const double> all(in);
    adapter->call({*sizes_of("exp3_quaternion"), true, 1, std::as_bytes(all.first(3)),
                   std::as_writable_bytes(std::span(Q)), status});
    EXPECT_EQ(Q[3], object->factor);
    EXPECT_EQ(adapter->call({*sizes_of("check_quaternion"), true, 1, std::as_bytes(all), {}, status}),
              "w is 0");
    EXPECT_EQ(status[0], Status::refused);
  }
  const std::string name = register_adapter(liecheck_subject(static_cast<const Scaled*>(nullptr)));
  const auto& known = subjects(oracles::scalar_of<double>);
  const auto subject = std::ranges::find(known, name, &Subject::name);
  ASSERT_NE(subject, known.end());
  EXPECT_NO_THROW((*subject)->operations.check_quaternion({0, 0, 0, 1}));
  EXPECT_ANY_THROW((*subject)->operations.check_quaternion({1, 0, 0, 0}));
  EXPECT_FALSE((*subject)->operations.check_rotation);
}

TEST(LibraryModels, AListOfOperationsMayBeLong) {
#define LIECHECK_ONE(subject, operation) +1
#define LIECHECK_TEN a, a, a, a, a, a, a, a, a, a
#define LIECHECK_HUNDRED                                                                            \
  LIECHECK_TEN, LIECHECK_TEN, LIECHECK_TEN, LIECHECK_TEN, LIECHECK_TEN, LIECHECK_TEN, LIECHECK_TEN, \
      LIECHECK_TEN, LIECHECK_TEN, LIECHECK_TEN
  EXPECT_EQ(0 LIECHECK_EACH(LIECHECK_ONE, none, LIECHECK_HUNDRED, LIECHECK_HUNDRED), 200);
#undef LIECHECK_ONE
#undef LIECHECK_TEN
#undef LIECHECK_HUNDRED
}

}  // namespace
}  // namespace liecheck::properties::adapters
