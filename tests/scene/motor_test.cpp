// scene/effects/motor.hpp, added_mass.hpp: what the comparison with another formulation (tests/scenes) leaves out.

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

TEST(Motor, RefusesWhatItCannotBe) {
  for (const char* keys : {"efficiency: 1.1", "no_load_speed: 3", "force: 1, forces: [[0, 1]]"})
    EXPECT_THROW(Recorded(rail + drive + keys + "}]\n" + end), SceneError) << keys;
}

/// A body with three different added masses and inertias.
const std::string hull =
    "robot: {body: body, mass: 2, moments: [0.4, 0.9, 1.1]}\n"
    "initial: {attitude: [0.5, 0.2, 1], velocity: [1, 0.3, -0.2], angular_velocity: [0.2, 0.7, -0.4]}\n"
    "effects: [added_mass: {masses: [0.2, 3, 1], inertias: [0.1, 0.5, 0.2]}]\n";

TEST(AddedMass, HasAKineticEnergyThatIsConstant) {
  const Recorded run(hull + "integrator: {name: gauss12, step: 10 ms}\nduration: 3 s\nobservers: [energy]\n");
  EXPECT_LE(run.figure("largest change of energy"), 1e-13);
}

TEST(AddedMass, NeedsAFreeFlyer) {
  EXPECT_THROW(Recorded(rail + "effects: [added_mass: {masses: [1, 1, 1]}]\n" + end), SceneError);
}

}  // namespace
