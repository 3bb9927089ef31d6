// scene/integrators/collocation.hpp, stage_newton.hpp: implicit methods where a fixed-point iteration fails.

#include <gtest/gtest.h>

#include <liecheck/scene/integrators/stage_newton.hpp>

#include "bodies.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

const std::string hinge =
    "robot: {body: box, root: revolute, axis: [1, 0, 0], mass: 1 kg, size: [0.02, 0.02, 1], "
    "centre: [0, 0, -0.5]}\n";

class EachImplicitMethod : public testing::TestWithParam<const char*> {};

/// The velocity of the damped hinge falls to 1e-308 after 5.9 s, where a bound relative to it underflows.
TEST_P(EachImplicitMethod, LetsABodyComeToRest) {
  const scene::Scene s = loadSceneText(
      hinge +
      "initial: {joint_velocities: {root_joint: 1}}\neffects: [joint_damping: {coefficient: 40}]\n"
      "integrator: {name: " +
      GetParam() + ", step: 5 ms}\nduration: 8 s\n");
  auto system = scene::makeSystem<scene::Tree<double>>(s);
  scene::State<scene::Tree<double>> state(system, s.q, s.v);
  const auto method = scene::makeMethod<scene::Tree<double>>(s.integrator);
  const auto outcome =
      scene::simulate(system, *method, state, s.span, [](const auto&, long) { return true; });
  EXPECT_FALSE(outcome.diverged) << outcome.t << " s: " << outcome.why;
  EXPECT_LE(std::abs(state.v[0]), 1e-15);
  const double inertia = (0.02 * 0.02 + 1) / 12 + 0.25;        // m (b^2 + c^2)/12 + m d^2
  EXPECT_NEAR(state.q[0], inertia / 40, 2e-3 * inertia / 40);  // omega I/c in all
}

/// Dry friction of 2 N m against at most 4.9 N m of gravity: the hinge stops, and its friction changes by
/// 4 N m within 2 mrad/s, so that h |da/dv| is 6 and a fixed-point iteration does not converge.
TEST_P(EachImplicitMethod, StopsAHingeWithDryFriction) {
  const std::string text =
      hinge +
      "initial: {joints: {root_joint: 1}}\nduration: 3 s\n"
      "effects: [gravity, joint_damping: {coefficient: 1}, joint_friction: {force: 2, slip: 1 mrad/s}]\n";
  const auto end = [&](const std::string& integrator) {
    const scene::Scene s = loadSceneText(text + "integrator: " + integrator + "\nobservers: [energy]\n");
    auto system = scene::makeSystem<scene::Tree<double>>(s);
    scene::State<scene::Tree<double>> state(system, s.q, s.v);
    const auto method = scene::makeMethod<scene::Tree<double>>(s.integrator, s.options);
    const auto outcome =
        scene::simulate(system, *method, state, s.span, [](const auto&, long) { return true; });
    EXPECT_FALSE(outcome.diverged) << integrator << " " << outcome.t << " s: " << outcome.why;
    return state.q[0];
  };
  EXPECT_NEAR(end("{name: " + std::string(GetParam()) + ", step: 1 ms}"),
              end("{name: dopri5, tolerance: 1e-10}"), 2e-4);
}

INSTANTIATE_TEST_SUITE_P(Scene, EachImplicitMethod, testing::Values("implicit_midpoint", "gauss6", "gauss12"),
                         [](const auto& i) { return std::string(i.param); });

/// y' = -1000 atan(1000 y) from y = 1: steps of Newton's method overshoot without a line search.
TEST(StageNewton, ConvergesWhereNewtonsMethodAloneOvershoots) {
  scene::StageNewton solver;
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(2, 1), F;
  const auto rate = [](int, const Vec& y, Vec& f) {
    f = Vec::Zero(2);
    f[1] = -1000 * std::atan(1000 * (1 + y[1]));
  };
  const double h = 1e-3;
  const auto made = solver.solve({{0.5}}, h, 1, rate, Y, F);
  ASSERT_TRUE(made);
  EXPECT_NEAR(Y(1, 0), h / 2 * F(1, 0), 1e-14);
  EXPECT_LT(*made, 30);
}

TEST(StageNewton, SaysThatAnEquationHasNoSolution) {
  scene::StageNewton solver;
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(2, 1), F;
  const auto rate = [](int, const Vec& y, Vec& f) {
    f = Vec::Zero(2);
    f[1] = 1 + 10 * y[1] * y[1];  // y = h/2 (1 + 10 y^2) has no real solution for h = 1
  };
  EXPECT_FALSE(solver.solve({{0.5}}, 1, 1, rate, Y, F));
}

}  // namespace
