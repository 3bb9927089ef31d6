// scene/phase_check.hpp, scene/conserved.hpp: phases of the forces that are shorter than a step.

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

struct Short {
  std::string name, text;
};
std::ostream& operator<<(std::ostream& out, const Short& s) {
  return out << s.name;
}

/// Forces that begin and end within steps of 1 to 20 ms.
const std::vector<Short>& shortPhases() {
  static const std::vector<Short> all = {
      {"ball",
       "robot: {body: ball, mass: 1 kg, radius: 0.1}\nground: {height: 0}\ninitial: {position: [0, 0, 0.6]}\n"
       "effects: [gravity, {contact: {bodies: all, stiffness: 300 kN/m, dissipation: 0.05}}]\nduration: "
       "0.9\n"},
      {"ball_from_within",
       "robot: {body: ball, mass: 1 kg, radius: 0.1}\nground: {height: 0}\ninitial: {position: [0, 0, "
       "0.099]}\n"
       "effects: [gravity, {contact: {bodies: all, stiffness: 300 kN/m}}]\nduration: 0.18\n"},
      {"box",
       "robot: {body: box, mass: 1 kg, size: [0.2, 0.3, 0.1]}\nground: {height: 0}\n"
       "initial: {position: [0, 0, 0.4], attitude: [0.5, 0.2, 0]}\n"
       "effects: [gravity, {contact: {bodies: all, stiffness: 100 kN/m, dissipation: 0.1}}]\nduration: "
       "0.36\n"},
      {"friction",
       "robot: {body: ball, mass: 1 kg, radius: 0.1}\nground: {height: 0}\n"
       "initial: {position: [0, 0, 0.4], velocity: [2, 0, 0]}\n"
       "effects: [gravity, {contact: {bodies: all, stiffness: 50 kN/m, friction: 0.3, slip: 1 "
       "cm/s}}]\nduration: 0.36\n"},
      {"collision",
       "robot: {bodies: [{name: a, body: ball, radius: 0.1, velocity: [1, 0, 0]}, "
       "{name: b, body: ball, radius: 0.1, position: [0.3, 0.05, 0]}]}\n"
       "effects: [{collisions: {stiffness: 400 kN/m}}]\nduration: 0.36\n"},
      {"clamp",
       "robot: {body: box, root: revolute, axis: [1, 0, 0], size: [0.02, 0.02, 1], centre: [0, 0, -0.5]}\n"
       "initial: {joints: {root_joint: 0.5}, joint_velocities: {root_joint: 1}}\n"
       "effects: [gravity]\nactuation:\n  - motor: {stiffness: 1e5, damping: 300, target: 0.6, stall_torque: "
       "20}\n"
       "duration: 0.36\n"},
      {"window",
       "robot: {body: box, mass: 1 kg, size: [0.2, 0.3, 0.1]}\n"
       "effects: [wrench: {frame: body, moment: [3, 2, -4], from: 41 ms, until: 47 ms}]\nduration: 0.36\n"}};
  return all;
}

class AShortPhase : public testing::TestWithParam<Short> {};

/// Right or an alarm, whatever the step is.
TEST_P(AShortPhase, IsResolvedOrTold) {
  const auto run = [](const std::string& integrator) {
    return scene::run(loadSceneText(GetParam().text + "integrator: " + integrator +
                                    "\nobservers: [state]\noutput: {every: 180 ms}\n"),
                      {}, true);
  };
  const scene::Scene s = loadSceneText(GetParam().text + "integrator: {name: rkmk4, step: 1 ms}\n");
  const scene::Run exact = run("{name: dopri5, tolerance: 1e-12}");
  ASSERT_FALSE(exact.outcome.diverged);
  for (const char* method :
       {"rk2", "implicit_midpoint", "rkmk4", "rkmk6", "gauss6", "gauss12", "dopri5", "radau5"})
    for (const char* step : {"0.1 ms", "1 ms", "6 ms", "10 ms", "20 ms"}) {
      const bool adaptive = scene::methodInfo(method).adaptive;
      if (adaptive && step != std::string("1 ms")) continue;
      const scene::Run r = run(std::string("{name: ") + method +
                               (adaptive ? ", tolerance: 1e-6" : std::string(", step: ") + step) + "}");
      if (r.outcome.diverged) continue;
      const Vec apart = difference(s.model, exact.q, r.q);
      double excess = 0;
      for (int k = 0; k < s.model.nv; ++k)
        excess =
            std::max(excess, std::abs(apart[k]) / (s.model.nv > 1 && k % 6 < 3 ? r.estimate->accepted.position
                                                                               : r.estimate->accepted.angle));
      if (excess > 2) {
        EXPECT_FALSE(r.estimate->alarms.empty()) << method << " " << step << ": " << excess;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Scene, AShortPhase, testing::ValuesIn(shortPhases()),
                         [](const auto& i) { return i.param.name; });

TEST(PhaseCheck, TakesSomeStepsInAContactWhateverTheStepOfTheRunIs) {
  const double half_period = std::numbers::pi * std::sqrt(1 / 300e3);
  const scene::Run exact =
      scene::run(loadSceneText(shortPhases()[0].text + "integrator: {name: dopri5, tolerance: 1e-10}\n"));
  for (const char* step : {"6 ms", "10 ms", "20 ms"}) {
    const scene::Run run =
        scene::run(loadSceneText(shortPhases()[0].text + "integrator: {name: rkmk4, step: " + step + "}\n"));
    EXPECT_EQ(run.outcome.events, 2) << step;
    EXPECT_GT(run.outcome.phases.count, 8) << step;
    EXPECT_LT(run.outcome.phases.count, 60) << step;
    EXPECT_LT(run.outcome.phases.shortest, half_period / 4) << step;
    EXPECT_FALSE(run.outcome.phases.unresolved) << step;
    EXPECT_NEAR(run.q[2], exact.q[2], 1e-3) << step;
  }
}

/// The lowest point of the path is 10 um below the ground, in the middle of a step whose ends are 0.5 mm above it.
TEST(EventSteps, AGrazingContactThatNoStepSeesIsLocated) {
  const scene::Run run =
      scene::run(loadSceneText("robot: {body: ball, mass: 1 kg, radius: 0.1}\nground: {height: 0}\n"
                               "initial: {position: [0, 0, 0.26], velocity: [0, 0, -1.788910282]}\n"
                               "effects: [gravity: {acceleration: [0, 0, 10]}, {contact: {bodies: all, "
                               "stiffness: 10 N/m}}]\nduration: 0.34\n"
                               "integrator: {name: rkmk4, step: 20 ms}\n"));
  EXPECT_EQ(run.outcome.events, 2);
}

TEST(Estimate, NamesTheEnergyThatDissipationMustNotIncrease) {
  const scene::Run run = scene::run(
      loadSceneText(
          "robot: {body: box, root: revolute, axis: [1, 0, 0], size: [0.02, 0.02, 1], centre: [0, 0, -0.5]}\n"
          "initial: {joints: {root_joint: 1}}\neffects: [gravity, joint_damping: {coefficient: 1e-5}]\n"
          "accuracy: {angle: 10}\nduration: 5 s\nintegrator: {name: euler, step: 5 ms}\n"),
      {}, true);
  ASSERT_EQ(run.estimate->alarms.size(), 1U);
  EXPECT_TRUE(has(run.estimate->alarms[0].what, "energy grows"));
}

TEST(Radau5, DoesNotDependOnTheDistanceOfSamples) {
  std::optional<Vec> first;
  for (const char* every : {"1 ms", "15 ms", "75 ms"}) {
    const scene::Run run =
        scene::run(loadSceneText("robot: {urdf: ../robots/quadruped.urdf}\nground: {height: 0}\n"
                                 "initial: {position: [0, 0, 0.4], joints: {front_left_thigh: 0.6, "
                                 "front_left_knee: -1.2, hind_left_knee: -1.2}}\n"
                                 "effects:\n  - gravity\n  - contact: {frames: [front_left_foot, "
                                 "front_right_foot, hind_left_foot, hind_right_foot], "
                                 "stiffness: 50 kN/m, dissipation: 0.5, friction: 0.7, slip: 10 mm/s}\n"
                                 "actuation: [pd: {stiffness: 80, damping: 2}]\nintegrator: {name: radau5, "
                                 "tolerance: 1e-7}\nduration: 0.075\n"
                                 "output: {every: " +
                                     std::string(every) + "}\n",
                                 "drop", LIECHECK_FIXTURES "/scenes"));
    ASSERT_FALSE(run.outcome.diverged) << every << ": " << run.outcome.why;
    if (!first) first = run.q;
    EXPECT_LT((run.q - *first).norm(), 1e-5) << every;
  }
}

}  // namespace
