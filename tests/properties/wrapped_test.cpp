#include <gtest/gtest.h>
#include <campaign/robots.hpp>
#include <functional>
#include <set>
#include <subjects/wrapped.hpp>
#include <thread>

namespace liecheck::properties {
namespace {

using V3 = Vec<double, 3>;
using V4 = Vec<double, 4>;
using X = VecX<double>;

const TypedSubject<double>& subject(const std::string& name) {
  for (const auto* s : typed_subjects<double>())
    if (s->name == name) return *s;
  throw std::logic_error(name + " is not registered");
}

/// Notes the names of the operations called, and to which robot or tree they belong.
struct Notes {
  std::multiset<std::string>* calls;
  std::string owner = "";

  template <class O, class F, class... A>
  auto operator()(const O& operation, const F& function, const A&... arguments) const {
    calls->insert(owner + std::string(operation.name));
    return function(arguments...);
  }
  Notes on(const std::string&, bool fixed) const { return {calls, fixed ? "fixed robot: " : "robot: "}; }
  Notes on(const Tree<double>& tree) const {
    return {calls, std::to_string(tree.joints.size()) + " joints: "};
  }
};
using Noted = Wrapped<double, Notes>;

TEST(Wrapped, CallsGoThroughTheHookAndReturnItsResult) {
  std::multiset<std::string> calls;
  const Noted noted(subject("liecheck").operations, {&calls});
  const Noted::Active active(noted);
  const V3 phi(0.1, 0.2, 0.3);
  EXPECT_EQ(noted.operations()[op::exp3_quaternion](phi),
            subject("liecheck").operations[op::exp3_quaternion](phi));
  EXPECT_EQ(noted.operations()[op::exp3_matrix](phi), subject("liecheck").operations[op::exp3_matrix](phi));
  EXPECT_EQ(calls, (std::multiset<std::string>{"exp3_matrix", "exp3_quaternion"}));
}

TEST(Wrapped, HasExactlyTheOperationsOfItsBase) {
  std::multiset<std::string> calls;
  for (const auto* s : typed_subjects<double>()) {
    const Noted noted(s->operations, {&calls});
    for (const Operation* o : all_operations())
      EXPECT_EQ(noted.operations().has(*o), s->operations.has(*o)) << s->name << " " << o->name;
    EXPECT_EQ(noted.operations().robot == nullptr, s->operations.robot == nullptr) << s->name;
    EXPECT_EQ(noted.operations().tree == nullptr, s->operations.tree == nullptr) << s->name;
  }
}

TEST(Wrapped, FunctionsOfRobotsAndTreesUseTheHookOfTheirRobotOrTree) {
  std::multiset<std::string> calls;
  const Noted noted(subject("liecheck").operations, {&calls});
  RobotOperations<double> robot;
  {
    const Noted::Active active(noted);
    robot = noted.operations().robot(built_in_robot().urdf, true);
  }
  Tree<double> tree;
  tree.joints.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    auto& j = tree.joints[i];
    j.kind = oracles::JointKind::prismatic, j.parent = static_cast<int>(i) - 1;
    j.Q = {{0, 0, 0, 1}}, j.p = {{1, 0, 0}}, j.axis = {{0, 0, 1}};
    j.pitch = j.multiplier = j.offset = j.armature = 0;
    j.body.mass = 2, j.body.c = {{0, 0, 0}}, j.body.I_C = oracles::symmetric(oracles::Vec6<double>{});
  }
  tree.index();
  tree.frame_Q = {{0, 0, 0, 1}}, tree.frame_p = {{0, 0, 0}}, tree.gravity = {{0, 0, -10}};
  const TreeOperations<double> o = noted.operations().tree(tree);
  EXPECT_TRUE(o[op::tree_gravity](X::Zero(2)).isApprox(Vec<double, 2>(40, 20)));
  EXPECT_THROW(robot[op::robot_integrate](X::Zero(1), X::Zero(1)), std::exception);  // wrong sizes
  EXPECT_EQ(calls, (std::multiset<std::string>{"2 joints: tree_gravity", "fixed robot: robot_integrate"}));
}

/// Adds a number to the first component of a quaternion.
struct Shift {
  double by;
  template <class O, class F, class... A>
  auto operator()(const O&, const F& function, const A&... arguments) const {
    auto result = function(arguments...);
    if constexpr (std::is_same_v<decltype(result), V4>) result[0] += by;
    return result;
  }
};
using Shifted = Wrapped<double, Shift>;

TEST(Wrapped, ManySubjectsAreWrappedAtOnceAndOnManyThreads) {
  const TypedOperations<double>& base = subject("liecheck").operations;
  const Shifted one(base, {1}), two(base, {2});
  const auto calls = [&base](const Shifted& shifted, double by) {
    for (int i = 0; i < 1000; ++i) {
      const Shifted::Active active(shifted);
      const V3 phi(0.1 * i, 0.2, 0.3);
      V4 expected = base[op::exp3_quaternion](phi);
      expected[0] += by;
      EXPECT_EQ(shifted.operations()[op::exp3_quaternion](phi), expected);
    }
  };
  std::thread other(calls, std::cref(two), 2.0);
  calls(one, 1);
  other.join();
  const Shifted::Active outer(one);
  {
    const Shifted::Active inner(two);
    EXPECT_EQ(two.operations()[op::exp3_quaternion](V3::Zero())[0], 2);
  }
  EXPECT_EQ(one.operations()[op::exp3_quaternion](V3::Zero())[0], 1);
}

TEST(Wrapped, ACallWithoutAnActiveSubjectOnItsThreadIsAnError) {
  const Shifted one(subject("liecheck").operations, {1});
  EXPECT_THROW(one.operations()[op::exp3_quaternion](V3::Zero()), std::logic_error);
  const Shifted::Active active(one);
  std::thread([&one] {
    EXPECT_THROW(one.operations()[op::exp3_quaternion](V3::Zero()), std::logic_error);
  }).join();
}

}  // namespace
}  // namespace liecheck::properties
