// scene/estimate.hpp, scene/stability.hpp: the estimated error of a run, its alarms, and what they advise.

#include <gtest/gtest.h>

#include <filesystem>
#include <liecheck/scene/stability.hpp>
#include <regex>

#include "bodies.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

const std::string folder = std::string(LIECHECK_FIXTURES) + "/scenes";

struct Judged {
  std::string name, text;  ///< without the integrator
  double position, angle;  ///< accepted [m, rad]
};

const std::vector<Judged>& judgedScenes() {
  static const std::vector<Judged> all = {
      {"a quadruped dropped on compliant ground",
       "robot: {urdf: ../robots/quadruped.urdf}\nground: {height: 0}\n"
       "initial: {position: [0, 0, 0.4], joints: {front_left_thigh: 0.6, front_right_thigh: 0.6, "
       "hind_left_thigh: 0.6, hind_right_thigh: 0.6, front_left_knee: -1.2, front_right_knee: -1.2, "
       "hind_left_knee: -1.2, hind_right_knee: -1.2}}\neffects:\n  - gravity\n"
       "  - contact: {frames: [front_left_foot, front_right_foot, hind_left_foot, hind_right_foot], "
       "stiffness: 20 kN/m, dissipation: 0.5 s/m, friction: 0.8, slip: 10 mm/s}\n"
       "  - armature: {inertia: 5 g m^2}\nactuation:\n  - pd: {joints: all, stiffness: 80, damping: 3, "
       "target: [0, 0.6, -1.2, 0, 0.6, -1.2, 0, 0.6, -1.2, 0, 0.6, -1.2]}\nduration: 0.4 s\n",
       2e-3, 0.02},
      {"a stiff spring without damping",
       "robot: {body: ball, root: prismatic, mass: 1 kg, radius: 0.1}\n"
       "initial: {joints: {root_joint: 0.01 m}}\neffects: [joint_spring: {stiffness: 1e6 N/m}]\n"
       "duration: 1 s\n",
       1e-4, 1},
      {"a box that slides and rests",
       sliding_box + "  - contact: {frames: [c1, c2, c3, c4], stiffness: 20 kN/m, dissipation: 0.5 s/m, "
                     "friction: 0.5, slip: 10 mm/s}\nduration: 1 s\n",
       1e-3, 0.01},
      {"a damped hinge that comes to rest",
       "robot: {body: box, root: revolute, axis: [1, 0, 0], mass: 1 kg, size: [0.02, 0.02, 1], centre: [0, "
       "0, -0.5]}\ninitial: {joints: {root_joint: 1}}\n"
       "effects: [gravity, joint_damping: {coefficient: 1}, joint_friction: {force: 0.2, slip: 0.01}]\n"
       "duration: 10 s\n",
       1, 1e-3},
      {"a wrench from 1 s",
       "robot: {body: box, mass: 2 kg, size: [0.3, 0.4, 0.6]}\ninitial: {angular_velocity: [1, 0.5, 2]}\n"
       "effects: [wrench: {frame: body, force: [3, -2, 1], moment: [1, 2, -1], from: 1 s}]\nduration: 2 s\n",
       1e-6, 1e-6}};
  return all;
}

scene::Scene load(const Judged& s, const std::string& integrator) {
  const std::string text =
      s.text + "accuracy: {position: " + std::to_string(s.position) + ", angle: " + std::to_string(s.angle) +
      "}\nintegrator: " + integrator + "\n" +
      "observers: [{frame: {frame: " + (s.text.find("urdf") == std::string::npos ? "body" : "trunk") +
      "}}]\noutput: {every: 20 ms}\n";
  return loadSceneText(text, s.name, folder);
}

std::string steps(const std::string& method, double h) {
  char text[80];
  std::snprintf(text, sizeof text, "{name: %s, step: %.12g s}", method.c_str(), h);
  return text;
}

/// The larger ratio of an error to the accepted one, over all samples of the frame's position and quaternion.
double excess(const Judged& s, const scene::Run& run, const scene::Run& exact) {
  EXPECT_EQ(run.rows.size(), exact.rows.size());
  double worst = 0;
  const std::size_t n = run.columns.size();
  for (std::size_t i = 0; i < std::min(run.rows.size(), exact.rows.size()); i += n) {
    double p = 0, turned = 0;
    for (std::size_t k = 1; k < 4; ++k) p = std::max(p, std::abs(run.rows[i + k] - exact.rows[i + k]));
    double same = 0, opposite = 0;  // |Q1 -+ Q2| is half the angle between them
    for (std::size_t k = 4; k < 8; ++k)
      same += std::pow(run.rows[i + k] - exact.rows[i + k], 2),
          opposite += std::pow(run.rows[i + k] + exact.rows[i + k], 2);
    turned = 2 * std::sqrt(std::min(same, opposite));
    worst = std::max({worst, p / s.position, turned / s.angle});
  }
  return worst;
}

class EachJudgedScene : public testing::TestWithParam<Judged> {};

/// An alarm where the accepted error is missed, and none where the error is below a third of it. Between them
/// an estimate by a run that is not exact itself may decide either way.
TEST_P(EachJudgedScene, IsAlarmedWhereItMissesItsAccuracyAndCuredByWhatIsAdvised) {
  const Judged& s = GetParam();
  const scene::Run exact = scene::run(load(s, "{name: dopri5, tolerance: 1e-10}"));
  ASSERT_FALSE(exact.outcome.diverged) << exact.outcome.why;
  std::vector<std::string> advised;
  for (const char* method : {"rkmk4", "semi_implicit_euler"})
    for (const double h : {1e-4, 5e-4, 2e-3, 5e-3}) {
      const scene::Run run = scene::run(load(s, steps(method, h)), {}, true);
      if (run.outcome.diverged) continue;
      ASSERT_TRUE(run.estimate);
      const double error = excess(s, run, exact);
      const auto& alarms = run.estimate->alarms;
      if (error > 1) {
        EXPECT_FALSE(alarms.empty()) << s.name << ", " << method << " " << h << ": " << error;
      } else if (error < 1. / 3) {
        EXPECT_TRUE(alarms.empty()) << s.name << ", " << method << " " << h << ": " << error << ", "
                                    << alarms[0].what << ": " << alarms[0].cause;
      }
      if (alarms.empty()) continue;
      EXPECT_FALSE(alarms[0].cause.empty());
      std::smatch found;
      const std::string& remedy = alarms[0].remedy;
      if (std::regex_search(remedy, found, std::regex("steps of (\\S+) s")))
        advised.push_back(steps(method, std::stod(found[1])));
      else if (std::regex_search(remedy, found, std::regex("integrator: (\\{[^}]*\\})")))
        advised.push_back(found[1]);
      else
        ADD_FAILURE() << remedy;
    }
  std::sort(advised.begin(), advised.end());
  advised.erase(std::unique(advised.begin(), advised.end()), advised.end());
  for (const std::string& integrator : advised) {
    const scene::Run run = scene::run(load(s, integrator), {}, true);
    ASSERT_TRUE(run.estimate) << s.name << " " << integrator;
    EXPECT_LE(excess(s, run, exact), 1) << s.name << " " << integrator;
  }
}

INSTANTIATE_TEST_SUITE_P(Scene, EachJudgedScene, testing::ValuesIn(judgedScenes()), [](const auto& i) {
  return std::regex_replace(i.param.name, std::regex("[^a-z0-9]"), "_");
});

/// The closed forms with 100 digits show that the two scenes that are accused are wrong by half a turn: between
/// two flips, the motion amplifies its rounding errors by 1e10 and 1e12.
TEST(Estimate, AccusesNoSceneOfTheFixturesButThoseThatAmplifyRoundingErrors) {
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".yaml") continue;
    const std::string name = file.path().stem().string();
    const scene::Run run = scene::run(loadScene(file.path().string()), {}, true);
    ASSERT_TRUE(run.estimate) << name;
    const auto& alarms = run.estimate->alarms;
    if (name == "dzhanibekov_1e-10" || name == "dzhanibekov_1e-12") {
      ASSERT_EQ(alarms.size(), 1U) << name;
      EXPECT_EQ(alarms[0].cause, "the motion amplifies rounding errors");
    } else {
      EXPECT_TRUE(alarms.empty()) << name << ": " << alarms[0].what << ": " << alarms[0].cause;
    }
  }
}

/// Its contacts last 5 ms, two steps, which steps three times as long would miss.
TEST(Estimate, OfABallThatBouncesInShortPhasesCostsHalfOfTheRun) {
  const scene::Scene s = loadSceneText(
      "robot: {body: ball, radius: 0.1, mass: 1 kg}\nground: {height: 0}\ninitial: {position: [0, 0, 0.3]}\n"
      "effects: [gravity, contact: {bodies: all, stiffness: 400 kN/m, dissipation: 0.1}]\nduration: 0.5 s\n"
      "integrator: {name: rkmk6, step: 2.5 ms}\n");
  const scene::Run run = scene::run(s, {}, true);
  EXPECT_GT(run.outcome.phases.count, 0);
  EXPECT_LE(run.estimate->cost, 0.5) << run.estimate->by;
}

/// Longer steps and a larger tolerance differ by 9.7 orders here, since steps end at events and samples.
TEST(Estimate, BelievesNoOrderAboveThatOfAToleranceAtAll) {
  const auto balls = [](const std::string& tolerance) {
    return loadSceneText(
        "robot: {bodies: [{name: a, body: ball, radius: 0.1, mass: 0.93, position: [0.00995, -0.0744, "
        "0.419], velocity: [0.55, 0.21, -0.14]}, {name: b, body: ball, radius: 0.1, mass: 2, position: "
        "[0.271, 0.027, 0.321], velocity: [-0.21, -0.048, 0.12]}]}\nground: {height: 0}\neffects: [gravity, "
        "collisions: {bodies: all, stiffness: 1730, dissipation: 0.77, friction: 0.84, slip: 0.028}, contact: "
        "{bodies: all, stiffness: 2.31e5, dissipation: 1.9}, buoyancy: {frame: a, volume: 0.0012}]\n"
        "duration: 0.24\noutput: {every: 0.012}\nintegrator: {name: dopri5, tolerance: " +
        tolerance + "}\n");
  };
  const scene::Run run = scene::run(balls("3e-7"), {}, true), truth = scene::run(balls("1e-13"));
  double error = 0;
  for (const int body : {0, 7})
    error = std::max(error, (run.q.segment<3>(body) - truth.q.segment<3>(body)).norm());
  EXPECT_GT(run.estimate->order.value_or(0), 6);
  EXPECT_GT(run.estimate->error.position, error / 5);
}

/// Steps of h and h/2 are wrong alike where the box meets the ground: they differ by an order of 1.6, and rkmk6 has 6.
TEST(Estimate, TrustsNoHalvedStepsThatDoNotShowTheOrderOfTheMethod) {
  const auto box = [](const std::string& integrator) {
    return loadSceneText(
        "robot: {body: box, size: [0.1, 0.1, 0.4], centre: [0.01, 0, 0.05], mass: 0.59}\nground: {height: 0}\n"
        "initial: {position: [0, 0, 0.226], attitude: [1.32, 1.46, 0.446], velocity: [-1.63, -0.774, 1.55], "
        "angular_velocity: [-0.0549, -0.0711, 0.0436]}\n"
        "effects: [gravity, contact: {bodies: all, stiffness: 7.94e+04, friction: 0.75, slip: 0.0038}]\n"
        "duration: 0.228\noutput: {every: 0.0057}\nintegrator: " +
        integrator + "\n");
  };
  const scene::Scene s = box("{name: rkmk6, step: 0.00057}");
  const scene::Run run = scene::run(s, {}, true), truth = scene::run(box("{name: dopri5, tolerance: 1e-11}"));
  const VectorX<double> error = difference(s.model, run.q, truth.q);
  EXPECT_GT(error.tail<3>().lpNorm<Eigen::Infinity>(), run.estimate->accepted.angle);
  EXPECT_GT(run.estimate->error.angle, error.tail<3>().lpNorm<Eigen::Infinity>() / 2);
  EXPECT_FALSE(run.estimate->alarms.empty());
}

TEST(Estimate, NamesTheEnergyThatASceneMustKeep) {
  // 1 % of the energy is lost before the error of the angle is 10 rad.
  const scene::Scene s = loadSceneText(
      "robot: {body: box, root: revolute, axis: [1, 0, 0], size: [0.02, 0.02, 1], centre: [0, 0, -0.5]}\n"
      "initial: {joints: {root_joint: 1}}\neffects: [gravity]\naccuracy: {angle: 10}\nduration: 5 s\n"
      "integrator: {name: euler, step: 5 ms}\n");
  const scene::Run run = scene::run(s, {}, true);
  ASSERT_EQ(run.estimate->alarms.size(), 1U);
  EXPECT_TRUE(has(run.estimate->alarms[0].what, "energy"));
  EXPECT_GT(run.estimate->alarms[0].t, 0);
}

TEST(Estimate, NamesTheStiffestEffectAndAStepThatIsStable) {
  const scene::Scene s = loadSceneText(
      "robot: {body: ball, root: prismatic, mass: 1 kg, radius: 0.1}\ninitial: {joint_velocities: "
      "{root_joint: 1}}\neffects: [joint_damping: {coefficient: 1000}, joint_spring: {stiffness: "
      "10}]\nduration: 0.1 s\n"
      "integrator: {name: rkmk4, step: 4 ms}\n");
  scene::Setup<scene::Tree<double>> setup(s);
  const auto at = [&](double h) { return scene::stabilityOf(setup, setup.start, h); };
  EXPECT_NEAR(at(1e-3).stiffest, 1000, 1);
  EXPECT_TRUE(at(2.7e-3).stable());  // |lambda| h = 2.7 and 2.9: the limit of the method is 2.785
  EXPECT_FALSE(at(2.9e-3).stable());
  EXPECT_EQ(scene::stiffestEffect(setup, setup.start), "joint_damping");
  const scene::Run run = scene::run(s, {}, true);
  ASSERT_FALSE(run.estimate->alarms.empty());
  EXPECT_TRUE(has(run.estimate->alarms[0].cause, "stability limit of 'joint_damping'"));
}

TEST(Estimate, APendulumUpsideDownIsUnstableAndItsMethodIsNot) {
  const scene::Scene s = loadSceneText(
      "robot: {body: box, root: revolute, axis: [1, 0, 0], size: [0.02, 0.02, 1], centre: [0, 0, 0.5]}\n"
      "initial: {joints: {root_joint: 1e-3}}\neffects: [gravity]\nduration: 1 s\n"
      "integrator: {name: rkmk4, step: 50 ms}\n");
  scene::Setup<scene::Tree<double>> setup(s);
  const scene::Stability shown = scene::stabilityOf(setup, setup.start, 0.05);
  EXPECT_GT(shown.growth, 1.1);
  EXPECT_TRUE(shown.stable());
}

/// Steps of 3 h lose a stiff contact of which phases resolve the short time, and what follows takes ever shorter ones.
TEST(Estimate, GivesUpATwinWhosePhasesTakeTooManySteps) {
  const scene::Run run = scene::run(loadSceneText(
      "robot: {body: box, size: [0.1, 0.1, 0.4], centre: [0.01, 0, 0.05], mass: 5.2}\nground: {height: 0}\n"
      "initial: {position: [0, 0, 0.566], attitude: [1.29, -0.721, -0.0807], velocity: [0.231, -0.316, -0.219], "
      "angular_velocity: [-0.146, 0.222, 0.362]}\n"
      "effects: [gravity, {contact: {bodies: all, stiffness: 1.16e+07, dissipation: 1.6}}]\n"
      "integrator: {name: rkmk4, step: 0.0038}\nduration: 0.9804\n"), {}, true);
  ASSERT_TRUE(run.estimate);
  EXPECT_LT(run.estimate->cost, 20);  // it had no end before
}

/// The comparisons of a step have an end: the modes of this friction would take over a minute.
TEST(Estimate, IsAnAlarmWhereAPhaseTakesTooManyStepsOfOne) {
  const scene::Run run = scene::run(
      loadSceneText("robot: {body: needle, length: 0.5, radius: 0.02, mass: 0.67}\nground: {height: 0}\n"
                    "initial: {position: [0, 0, 0.173], attitude: [1.72, 1.32, 1.16], "
                    "velocity: [0.193, 0.227, -0.494], angular_velocity: [0.271, 0.192, -0.273]}\n"
                    "effects: [gravity, {contact: {bodies: all, stiffness: 1.34e+05, friction: 0.48, slip: 0.0029}}, "
                    "{drag: {frame: body, linear: 0.044, quadratic: 0.22}}, {wrench: {frame: body, "
                    "force: [-8.82, -4.43, 8.94], moment: [0.00988, -0.029, 0.0294]}}]\n"
                    "integrator: {name: rkmk6, step: 0.019}\nduration: 1.501\n"),
      {}, true);
  ASSERT_TRUE(run.estimate);
  EXPECT_FALSE(run.estimate->alarms.empty());
}

}  // namespace
