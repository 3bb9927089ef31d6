// scene/effects/motor.hpp, added_mass.hpp, and the current of drag.hpp. References are closed forms, and Kirchhoff's
// equations integrated here.

#include <gtest/gtest.h>

#include "recorded.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// A mass of 2 kg on a rail; ratio 10, J = 0.03: M = 2 + 3 = 5 kg. Stall 1: T = 10 N. No load 50: v_0 = 5 m/s.
const double M = 5, T = 10, v_0 = 5;
const std::string rail = "robot: {body: ball, mass: 2, radius: 0.1, root: prismatic, axis: [1, 0, 0]}\n",
                  drive = "actuation: [motor: {ratio: 10, rotor_inertia: 0.03, ",
                  curve = "stall_torque: 1, no_load_speed: 50, ",
                  end =
                      "integrator: {name: gauss6, step: 10 ms}\nduration: 1 s\nobservers: [state, energy]\n";

std::string from(double v) {
  return "initial: {joint_velocities: {root_joint: " + std::to_string(v) + "}}\n";
}

TEST(Motor, CarriesItsRotor) {
  const Recorded run(rail + drive + "force: 4}]\n" + end);
  EXPECT_NEAR(run["v.root_joint"].back(), 4 / M, 1e-14);
  EXPECT_NEAR(run["kinetic"].back(), M / 2 * 16 / M / M, 1e-14);
}

TEST(Motor, RunsUpAlongItsTorqueSpeedCurve) {
  const Recorded run(rail + drive + curve + "force: 100}]\n" + end);
  for (std::size_t i = 0; i < run["t"].size(); i += 20)
    EXPECT_NEAR(run["v.root_joint"][i], v_0 * (1 - std::exp(-T / (M * v_0) * run["t"][i])), 1e-12);
}

TEST(Motor, BrakesWithItsStallTorqueAndThenDrivesAlongTheCurve) {
  const Recorded run(rail + from(-1) + drive + curve + "force: 100}]\n" + end);
  const double rest = M / T;  // at this time it stands
  EXPECT_NEAR(run["v.root_joint"][25], -1 + T / M * 0.25, 1e-12);
  EXPECT_NEAR(run["v.root_joint"].back(), v_0 * (1 - std::exp(-T / (M * v_0) * (1 - rest))), 1e-11);
  EXPECT_GE(run.run.outcome.events, 1);
}

TEST(Motor, DrivesNothingAboveItsNoLoadSpeedAndFollowsSmallCommands) {
  EXPECT_NEAR(Recorded(rail + from(6) + drive + curve + "force: 100}]\n" + end)["v.root_joint"].back(), 6,
              1e-14);
  EXPECT_NEAR(Recorded(rail + from(6) + drive + curve + "force: -100}]\n" + end)["v.root_joint"].back(),
              6 - T / M, 1e-13);
  EXPECT_NEAR(Recorded(rail + drive + curve + "force: -4}]\n" + end)["v.root_joint"].back(), -4 / M, 1e-13);
}

TEST(Motor, LosesItsShareOfThePowerInTheGearbox) {
  const std::string lossy = "efficiency: 0.8, slip: 1e-9, force: 4}]\n";
  EXPECT_NEAR(Recorded(rail + from(1) + drive + lossy + end)["v.root_joint"].back(), 1 + 0.8 * 4 / M, 1e-12);
  EXPECT_NEAR(Recorded(rail + from(-3) + drive + lossy + end)["v.root_joint"].back(), -3 + 1.2 * 4 / M,
              1e-12);
}

TEST(Motor, FollowsATrajectory) {
  const Recorded run(
      rail + from(0.5) + drive + curve +
      "stiffness: 50, damping: 20, rows: [[0, 0], [1, 0.5], [2, 1]], interpolation: cubic}]\n" + end);
  EXPECT_NEAR(run["q.root_joint"].back(), 0.5, 1e-14);
  const Recorded forces(rail + drive + "forces: [[0, 0], [1, 4]]}]\n" + end);
  EXPECT_NEAR(forces["v.root_joint"].back(), 2 / M, 1e-14);
}

TEST(Motor, RefusesWhatItCannotBe) {
  for (const char* keys : {"efficiency: 1.1", "no_load_speed: 3", "force: 1, forces: [[0, 1]]"})
    EXPECT_THROW(Recorded(rail + drive + keys + "}]\n" + end), SceneError) << keys;
}

TEST(Drag, InACurrentTendsToTheVelocityOfTheFluid) {
  const Recorded run(
      "robot: {body: ball, mass: 2, radius: 0.1}\n"
      "initial: {attitude: [0.3, -1, 0.5], angular_velocity: [2, 1, -1], velocity: [0, 0, 0]}\n"
      "effects: [drag: {frame: body, linear: 3, current: [1, -2, 0.5]}]\n"
      "integrator: {name: gauss6, step: 10 ms}\nduration: 1 s\nobservers: [frame: {frame: body}]\n");
  const double share = 1 - std::exp(-3. / 2);
  EXPECT_NEAR(run["body.vx"].back(), share, 1e-10);
  EXPECT_NEAR(run["body.vy"].back(), -2 * share, 1e-10);
  EXPECT_NEAR(run["body.vz"].back(), 0.5 * share, 1e-10);
}

/// A body with three different added masses and inertias.
const std::string hull =
    "robot: {body: body, mass: 2, moments: [0.4, 0.9, 1.1]}\n"
    "initial: {attitude: [0.5, 0.2, 1], velocity: [1, 0.3, -0.2], angular_velocity: [0.2, 0.7, -0.4]}\n"
    "effects: [added_mass: {masses: [0.2, 3, 1], inertias: [0.1, 0.5, 0.2]}]\n";

TEST(AddedMass, MovesABodyByKirchhoffsEquations) {
  const Recorded run(hull +
                     "integrator: {name: gauss12, step: 10 ms}\nduration: 3 s\nobservers: [state, energy]\n");
  const V3 m(2.2, 5, 3), j(0.5, 1.4, 1.3);
  // P_dot = P x omega, L_dot = L x omega + P x u, by the classical Runge-Kutta method
  Vector6<double> h;
  h << m.cwiseProduct(V3(1, 0.3, -0.2)), j.cwiseProduct(V3(0.2, 0.7, -0.4));
  const auto rate = [&](const Vector6<double>& x) {
    const V3 P = x.head<3>(), L = x.tail<3>(), u = P.cwiseQuotient(m), omega = L.cwiseQuotient(j);
    Vector6<double> dx;
    dx << P.cross(omega), L.cross(omega) + P.cross(u);
    return dx;
  };
  rungeKutta(h, 1e-3, 3000, rate);
  const char* const parts[] = {"x", "y", "z", "wx", "wy", "wz"};
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(run[std::string("v.root_joint.") + parts[k]].back(), h[k] / (k < 3 ? m[k] : j[k - 3]), 1e-10)
        << k;
  EXPECT_LE(run.figure("largest change of energy"), 1e-13);
}

TEST(AddedMass, OfASphereSlowsItsFall) {
  const Recorded run(
      "robot: {body: ball, mass: 2, radius: 0.1}\ninitial: {angular_velocity: [1, 2, 3]}\n"
      "effects: [gravity, buoyancy: {frame: body, volume: 1 l}, added_mass: {masses: [0.5, 0.5, 0.5]}]\n"
      "integrator: {name: gauss6, step: 10 ms}\nduration: 1 s\nobservers: [frame: {frame: body}]\n");
  EXPECT_NEAR(run["body.vz"].back(), -(2 - 1) * 9.81 / 2.5, 1e-12);
}

TEST(AddedMass, NeedsAFreeFlyer) {
  EXPECT_THROW(Recorded(rail + "effects: [added_mass: {masses: [1, 1, 1]}]\n" + end), SceneError);
}

}  // namespace
