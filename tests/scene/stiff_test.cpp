// scene/integrators/collocation.hpp, stage_newton.hpp: implicit methods where a fixed-point iteration fails.

#include <gtest/gtest.h>

#include <liecheck/scene/integrators/stage_newton.hpp>
#include <regex>

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
  const Moment end = endOf<scene::Tree<double>>(s);
  EXPECT_LE(std::abs(end.v[0]), 1e-15);
  const double inertia = (0.02 * 0.02 + 1) / 12 + 0.25;      // m (b^2 + c^2)/12 + m d^2
  EXPECT_NEAR(end.q[0], inertia / 40, 2e-3 * inertia / 40);  // omega I/c in all
}

/// Dry friction of 2 N m against at most 4.9 N m of gravity: the hinge stops, and its friction changes by
/// 4 N m within 2 mrad/s, so that h |da/dv| is 6 and a fixed-point iteration does not converge.
TEST_P(EachImplicitMethod, StopsAHingeWithDryFriction) {
  const std::string text =
      hinge +
      "initial: {joints: {root_joint: 1}}\nduration: 3 s\n"
      "effects: [gravity, joint_damping: {coefficient: 1}, joint_friction: {force: 2, slip: 1 mrad/s}]\n";
  const auto end = [&](const std::string& integrator) {
    return endOf<scene::Tree<double>>(
               loadSceneText(text + "integrator: " + integrator + "\nobservers: [energy]\n"))
        .q[0];
  };
  EXPECT_NEAR(end("{name: " + std::string(GetParam()) + ", step: 1 ms}"),
              end("{name: dopri5, tolerance: 1e-10}"), 2e-4);
}

/// Of four contacts at rest, rounding errors would make some begin and end within each step. The box slides with
/// mu g until it stops after v^2/(2 mu g); its contacts are compressed by m g/(4 k).
TEST_P(EachImplicitMethod, LetsABoxSlideUntilItRests) {
  const scene::Scene s = loadSceneText(
      sliding_box +
      "  - contact: {frames: [c1, c2, c3, c4], stiffness: 20 kN/m, dissipation: 0.5 s/m, friction: 0.5, "
      "slip: 1 mm/s}\nduration: 0.3 s\nintegrator: {name: " +
      std::string(GetParam()) + ", step: 1 ms}\n");
  const Moment end = endOf<Body>(s);
  EXPECT_NEAR(end.q[0], 1 / (2 * 0.5 * 9.81), 1e-3);
  // It still rocks on its contacts, whose damping is weak.
  auto system = scene::makeSystem<Body>(s);
  static const auto exact = after(system, "dopri5", s.q, s.v, 0.3, 3, 1e-8);
  EXPECT_LE((end.q - exact.q).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LE((end.v - exact.v).cwiseAbs().maxCoeff(), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Scene, EachImplicitMethod,
                         testing::Values("implicit_midpoint", "gauss6", "gauss12", "radau5"),
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

/// A damping that is 1e5 times as fast as the motion: x decays as exp(-k t/c).
TEST(Radau5, TakesStepsFarAboveTheFastestMode) {
  const scene::Scene s = loadSceneText(
      "robot: {body: ball, root: prismatic, mass: 1 kg, radius: 0.1}\ninitial: {joints: "
      "{root_joint: 1}}\neffects: [joint_damping: {coefficient: 1e5}, joint_spring: {stiffness: 1e5}]\n"
      "integrator: {name: radau5, tolerance: 1e-8}\nduration: 4 s\noutput: {every: 4 s}\n"
      "observers: [{frame: {frame: body}}]\n");
  const scene::Run run = scene::run(s);
  ASSERT_FALSE(run.outcome.diverged) << run.outcome.why;
  EXPECT_LE(run.counts.steps, 1200);  // 1 % of the steps of an explicit method, whose limit is 3.3/c
  // The roots of s^2 + c s + k are close to -1 and -c.
  const double c = 1e5, slow = -2 * c / (c + std::sqrt(c * c - 4 * c)), fast = -c - slow;
  const double x = (slow * std::exp(4 * fast) - fast * std::exp(4 * slow)) / (slow - fast);
  EXPECT_NEAR(run.rows[run.rows.size() - run.columns.size() + 3], x, 1e-6);
}

/// Newton's method may keep a Jacobian during a run, but not beyond it.
TEST_P(EachImplicitMethod, GivesTheSameBitsAfterAnotherRun) {
  const scene::Scene s =
      loadSceneText(hinge +
                    "effects: [gravity, joint_spring: {stiffness: 1e4}, joint_damping: {coefficient: 10}]\n"
                    "integrator: {name: " +
                    GetParam() + ", step: 20 ms}\nduration: 0.2 s\n");
  using Sys = scene::Tree<double>;
  auto system = scene::makeSystem<Sys>(s);
  const auto last = [&](scene::Method<Sys>& method, double angle) {
    scene::State<Sys> state(system, VectorX<double>::Constant(1, angle), s.v);
    scene::simulate(system, method, state, s.span, [](const auto&, long) { return true; });
    return std::pair(state.q[0], state.v[0]);
  };
  const auto method = scene::makeMethod<Sys>(s.integrator), other = scene::makeMethod<Sys>(s.integrator);
  last(*other, 1.5);
  EXPECT_EQ(last(*other, 1), last(*method, 1));
}

/// Dry friction of 200 N stops 1 kg after v^2/(2 a) = 2.76 mm. It changes its sign within 1 um/s, so that steps of
/// 1 ms only swing about the rest, and an explicit method would need steps of 10 ns.
TEST(Estimate, AdvisesAnLStableMethodWhereForcesAreStiff) {
  const std::string text =
      "robot: {body: ball, root: prismatic, mass: 1 kg, radius: 0.1}\ninitial: {joint_velocities: "
      "{root_joint: 1.05 m/s}}\neffects: [joint_friction: {force: 200, slip: 1e-6}]\nduration: 0.1 s\n"
      "accuracy: {position: 0.01 mm}\nobservers: [{frame: {frame: body}}]\noutput: {every: 10 ms}\n";
  const scene::Run bad =
      scene::run(loadSceneText(text + "integrator: {name: rkmk4, step: 1 ms}\n"), {}, true);
  ASSERT_TRUE(bad.estimate);
  ASSERT_FALSE(bad.estimate->alarms.empty());
  std::smatch found;
  const std::string& remedy = bad.estimate->alarms[0].remedy;
  ASSERT_TRUE(std::regex_search(remedy, found, std::regex("integrator: (\\{name: radau5[^}]*\\})")))
      << remedy;
  const scene::Run cured = scene::run(loadSceneText(text + "integrator: " + found.str(1) + "\n"), {}, true);
  ASSERT_TRUE(cured.estimate) << cured.outcome.why;
  EXPECT_TRUE(cured.estimate->alarms.empty());
  EXPECT_NEAR(cured.rows[cured.rows.size() - cured.columns.size() + 3], 1.05 * 1.05 / 400, 1e-5);
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
