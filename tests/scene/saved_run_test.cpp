// scene/saved_run.hpp: a run that continues a saved one gives the same bits as the whole run.

#include <gtest/gtest.h>
#include <cmath>
#include <fstream>
#include <sstream>

#include "program.hpp"
#include "recorded.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

struct Case {
  std::string name, text;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

std::vector<Case> cases() {
  const std::string body =
      "robot: {body: box, mass: 2 kg, size: [0.3, 0.4, 0.6], centre: [0.1, -0.05, 0.02]}\n"
      "initial: {velocity: [0.5, 1, -1], angular_velocity: [1, 0.5, 2]}\n"
      "effects: [gravity, wrench: {frame: body, force: [3, 1, 2], from: 0.305 s, until: 0.72 s}]\n"
      "observers: [state, imu: {frame: body, gyro_noise: 0.1, accel_walk: 0.2}, attitude_error, momentum, "
      "power]\n";
  const std::string lone = body.substr(0, body.find(", power")) + "]\n";
  const std::string chain =
      "robot: {urdf: chain.urdf, root: free_flyer}\nground: {height: -1.9}\ninitial: {joints: {hinge1: "
      "0.3}}\n"
      "effects: [gravity, joint_friction: {force: 0.1, slip: 0.1}, contact: {frames: bar5, stiffness: 500, "
      "dissipation: 0.3, friction: 0.4, slip: 0.3}]\nobservers: [energy, state, contact_forces]\n";
  std::vector<Case> all;
  const auto add = [&](const std::string& name, const std::string& text, const std::string& method) {
    all.push_back({name + "_" + method.substr(0, method.find(',')),
                   text + "integrator: {name: " + method + "}\nduration: 1 s\noutput: {every: 50 ms}\n"});
  };
  for (const char* method : {"euler, step: 1 ms", "rkmk4, step: 5 ms", "quaternion_rk4, step: 5 ms",
                             "cf4, step: 5 ms", "implicit_midpoint, step: 5 ms", "gauss6, step: 10 ms",
                             "gauss12, step: 10 ms", "dopri5, tolerance: 1e-8", "radau5, tolerance: 1e-8"})
    add("body", body, method);
  add("body", lone, "variational, step: 5 ms");
  for (const char* method : {"rkmk4, step: 1 ms", "dopri5, tolerance: 1e-7"}) add("chain", chain, method);
  return all;
}

class EachSavedRun : public testing::TestWithParam<Case> {};

TEST_P(EachSavedRun, ContinuesWithTheSameBits) {
  const scene::Scene s = loadSceneText(GetParam().text, "s.yaml", LIECHECK_FIXTURES "/scenes");
  const scene::Run whole = scene::run(s, {}, true);
  std::vector<std::string> saved;
  const scene::Saving saving{[&](const scene::SavedRun& r) { saved.push_back(textOf(r)); }, nullptr, -1};
  scene::run(s, {}, false, saving);
  ASSERT_GT(saved.size(), 10u);
  for (const std::size_t at : {saved.size() / 7, saved.size() / 2, saved.size() - 1}) {
    const scene::SavedRun from = savedRunOf(saved[at], s);
    const scene::Run rest = scene::run(s, {}, true, {{}, &from, 1});
    EXPECT_EQ(rest.rows, whole.rows) << at;
    EXPECT_EQ(rest.q, whole.q) << at;
    EXPECT_EQ(rest.v, whole.v) << at;
    EXPECT_EQ(rest.largest_turn, whole.largest_turn);
    EXPECT_EQ(rest.counts.steps, whole.counts.steps);
    EXPECT_EQ(rest.counts.iterations, whole.counts.iterations);
    EXPECT_EQ(rest.outcome.t, whole.outcome.t);
    ASSERT_EQ(rest.figures.size(), whole.figures.size());
    for (std::size_t k = 0; k < rest.figures.size(); ++k)
      EXPECT_EQ(rest.figures[k].value, whole.figures[k].value) << rest.figures[k].name;
    ASSERT_TRUE(rest.estimate && whole.estimate);
    EXPECT_EQ(rest.estimate->error.angle, whole.estimate->error.angle);
    EXPECT_EQ(rest.estimate->checkpoints, whole.estimate->checkpoints);
  }
}

INSTANTIATE_TEST_SUITE_P(SavedRun, EachSavedRun, testing::ValuesIn(cases()),
                         [](const auto& c) { return c.param.name; });

class SavedRunText : public testing::Test {
 protected:
  static scene::Scene load(const std::string& robot = "{body: box, size: [1, 2, 3]}",
                           const std::string& more = "") {
    return loadSceneText("robot: " + robot + "\ninitial: {angular_velocity: [1, 2, 3]}\n" + more +
                         "integrator: {name: rkmk4, step: 10 ms}\nduration: 1 s\nobservers: [energy]\n");
  }
  static std::string saved(const scene::Scene& s) {
    std::string text;
    scene::run(s, {}, false, {[&](const scene::SavedRun& r) { text = textOf(r); }, nullptr, 1e9});
    return text;
  }
};

TEST_F(SavedRunText, OfAnotherSceneIsRefused) {
  const std::string text = saved(load());
  EXPECT_NO_THROW(savedRunOf(text, load()));
  EXPECT_NO_THROW(savedRunOf(text, load("{size: [1, 2, 3], body: box} # the same robot")));
  for (const scene::Scene& other :
       {load("{body: box, size: [1, 2, 3.1]}"), load("{body: box, size: [1, 2, 3], mass: 2}"),
        load("{body: box, size: [1, 2, 3]}", "effects: [gravity]\n")})
    EXPECT_THROW(savedRunOf(text, other), std::invalid_argument);
}

TEST_F(SavedRunText, ThatIsDamagedIsRefused) {
  const scene::Scene s = load();
  const std::string text = saved(s);
  EXPECT_THROW(savedRunOf("", s), std::invalid_argument);
  EXPECT_THROW(savedRunOf("t,x\n1,2\n", s), std::invalid_argument);
  for (std::size_t size = 0; size + 3 < text.size(); size += text.size() / 50)
    EXPECT_THROW(savedRunOf(text.substr(0, size), s), std::invalid_argument) << size;
}

TEST_F(SavedRunText, OfMoreStatesThanItHasRoomForTakesNoMemory) {
  const scene::Scene s = load();
  scene::SavedRun run;
  scene::run(s, {}, false, {[&](const scene::SavedRun& r) { run = r; }, nullptr, 1e9});
  run.samples.assign(200'000, scene::SavedState());  // of 12 characters, beside states of many numbers
  EXPECT_EQ(refusal<std::invalid_argument>([&] { savedRunOf(textOf(run), s); }),
            "is not a whole checkpoint: a count is wrong");
}

TEST(SavedRun, IsRefusedWhereAnObserverReadsEveryStep) {
  const scene::Scene s = loadSceneText(
      "robot: {body: box, size: [1, 2, 3]}\nintegrator: {name: rkmk4, step: 10 ms}\nduration: 1 s\n"
      "observers: [quaternion_norm]\n");
  EXPECT_THROW(scene::run(s, {}, false, {[](const scene::SavedRun&) {}, nullptr, 1}), std::invalid_argument);
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}
TEST(SavedRunOfTheProgram, ThatASignalStoppedIsResumedToTheSameCsv) {
  const std::string scene = written(
      "saved.yaml",
      "robot: {body: box, size: [1, 2, 3]}\ninitial: {angular_velocity: [0.3, 1, 0.2]}\neffects: [gravity]\n"
      "integrator: {name: rkmk4, step: 1 ms}\nduration: 3000 s\noutput: {every: 1 s}\n"
      "observers: [energy, frame: {frame: body}]\n");
  const std::string run = "scene run --no-estimate " + scene,
                    saved = liecheck::scratch() + "saved.checkpoint",
                    whole = liecheck::scratch() + "whole.csv", rest = liecheck::scratch() + "rest.csv";
  expectSaid(run + " --csv " + whole, 0);
  const auto [code, said] =
      printed(run + " --checkpoint " + saved + " & p=$!; sleep 0.5; kill -TERM $p; wait $p");
  EXPECT_TRUE(code == 3 || code == 0) << said;  // 0 on a machine that is done before
  expectSaid(run + " --resume " + saved + " --csv " + rest, 0);
  EXPECT_EQ(contents(whole), contents(rest));
  EXPECT_GT(contents(whole).size(), 3000u);
}

TEST(SavedRunOfTheProgram, ThatWasChangedIsRefused) {
  const std::string file =
      written("changed.yaml",
              "robot: {body: box, size: [1, 2, 3]}\ninitial: {angular_velocity: [1, 2, 3]}\n"
              "integrator: {name: radau5, tolerance: 1e-9}\nduration: 20 ms\n"
              "observers: [energy]\noutput: {every: 1 ms}\n");
  const scene::Scene s = loadScene(file);
  scene::SavedRun whole;
  scene::run(s, {}, false, {.save = [&](const scene::SavedRun& run) { whole = run; }});
  const auto error = [&](auto change) {
    scene::SavedRun run = whole;
    change(run);
    try {
      run = scene::savedRunOf(scene::textOf(run), s);
      scene::run(s, {}, true, {.from = &run});
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string is = "is not a whole checkpoint: ";
  EXPECT_EQ(error([](auto&) {}), "");
  EXPECT_EQ(error([](auto& run) { run.sections.clear(); }), is + "a state is missing");
  EXPECT_EQ(error([](auto& run) { run.sections.pop_back(); }), is + "a state is missing");
  EXPECT_EQ(error([](auto& run) { run.sections[1].step = 0; }), is + "a state is missing");
  EXPECT_EQ(error([](auto& run) { run.samples.erase(run.samples.begin() + 3); }), is + "a sample is missing");
  EXPECT_EQ(error([](auto& run) { run.samples[2].step = 30; }),
            is + "a state has another size than the scene's");
  EXPECT_EQ(error([](auto& run) { run.samples[2].v[0] = NAN; }), is + "a number is not finite");
  EXPECT_EQ(error([](auto& run) { run.history.push_back(NAN); }), is + "a number is not finite");
  EXPECT_EQ(error([](auto& run) { run.largest_turn = INFINITY; }), is + "a number is not finite");
  EXPECT_EQ(error([](auto& run) { run.memory.clear(); }), is + "what its method remembers has another size");
  EXPECT_EQ(error([](auto& run) { run.memory.assign(3, 1); }),
            is + "what its method remembers has another size");
  std::string text = scene::textOf(whole);
  text[text.size() / 2] ^= 1;
  EXPECT_THROW(scene::savedRunOf(text, s), std::invalid_argument);
}

TEST(SavedRunOfTheProgram, ThatIsNoneOfTheSceneIsRefusedInOneLine) {
  const std::string scene =
                        written("other.yaml",
                                "robot: {body: box, size: [1, 2, 3]}\nintegrator: {name: rkmk4, step: 1 ms}\n"
                                "duration: 1 s\nobservers: [energy]\n"),
                    text = written("no.checkpoint", "t\n0\n");
  EXPECT_EQ(expectSaid("scene run " + scene + " --resume " + text, 2),
            "liecheck: " + text + ": is not a checkpoint: its first line is not 'liecheck checkpoint 3'\n");
}

TEST(TruthOfAScene, IsRefusedByEveryCommandIfItIsNotThatOfTheMotion) {
  const std::string scene =
      written("truth.yaml",
              "robot: {body: box, size: [1, 2, 3]}\nintegrator: {name: rkmk4, step: 1 ms}\n"
              "duration: 1 s\ntruth: pendulum\n");
  for (const char* command : {"run ", "explain ", "sweep --no-peers "})
    expectSaid(std::string("scene ") + command + scene, 2, {scene + ": truth: "});
}

}  // namespace
