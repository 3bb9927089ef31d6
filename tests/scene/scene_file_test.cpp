// scene_file: the messages of errors, the fixtures, and the program `liecheck scene`.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <liecheck/scene_file/units.hpp>
#include <sstream>
#include <tuple>

#include "program.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
namespace fs = std::filesystem;

const fs::path scenes = fs::path(LIECHECK_FIXTURES) / "scenes";

/// The lines of a valid scene. Each invalid scene differs from it in one line.
const std::vector<std::string> good = {"robot: {body: box, size: [1, 2, 3]}",
                                       "initial: {angular_velocity: [0, 0, 1]}",
                                       "effects: [gravity]",
                                       "integrator: {name: rkmk4, step: 1 ms}",
                                       "duration: 1 s",
                                       "observers: [energy]"};
std::string with(std::size_t line, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < good.size(); ++i) all += (i + 1 == line ? text : good[i]) + "\n";
  return all + (line > good.size() ? text + "\n" : "");
}
std::string refusalOfText(const std::string& text) {
  return refusal(text, scenes.string());
}

TEST(SceneFile, AValidSceneIsRead) {
  const scene::Scene s = loadSceneText(with(99, ""));
  EXPECT_EQ(s.span.steps, 1000);
  EXPECT_EQ(s.model.nv, 6);
}

TEST(SceneFile, TheWarningsOfItsUrdfAreReturned) {
  const std::string file = "warned_" + std::to_string(::getpid()) + ".urdf";
  const fs::path folder = fs::temp_directory_path();
  std::ofstream(folder / file)
      << "<robot name='r'><link name='a'><inertial>\n<mass value='1' kg='1'/>"
         "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>";
  std::vector<std::string> warnings;
  loadSceneText("robot: {urdf: " + file + "}\nduration: 1 s\nintegrator: {name: rkmk4, step: 1 ms}", "s.yaml",
                folder.string(), &warnings);
  fs::remove(folder / file);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(
      warnings[0].starts_with((folder / file).string() + ":2: an unknown attribute of <mass> is ignored"))
      << warnings[0];
}

struct Bad {
  std::size_t line;
  std::string text, message;
};

TEST(SceneFile, AnInvalidSceneIsRefusedWithFileLineAndRemedy) {
  const std::vector<Bad> table = {
      {3, "effects: [gravty]",
       "s.yaml:3: 'gravty' is not known in effects, the nearest are 'gravity', 'drag' and 'wrench'"},
      {3, "effects: [gravity: {acceleration: [0, 0, -9.81 m/h]}]",
       "s.yaml:3: gravity.acceleration[2]: 'm/h' is not a unit of this quantity: write a number in m/s^2"},
      {3, "effects: [gravity: {acceleration: [0, 0, -9.81 furlong]}]",
       "s.yaml:3: gravity.acceleration[2]: unknown unit 'furlong' in 'furlong', the nearest are 'turn', "
       "'deg' and 'g'"},
      {3, "effects: [gravity: {acceleration: [0, 0, -9.81 kg]}]",
       "s.yaml:3: gravity.acceleration[2]: 'kg' is not a unit of this quantity: write a number in m/s^2"},
      {3, "effects: [gravity: {acceleration: [0, -9.81]}]",
       "s.yaml:3: gravity.acceleration is a list of 3 numbers, as [0, 0, 1], not of 2"},
      {3, "effects: [gravity: {accelerate: 1}]",
       "s.yaml:3: gravity has no key 'accelerate', the nearest is 'acceleration'"},
      {3, "effects: gravity", "s.yaml:3: effects is a list: '- energy' on separate lines, or [energy]"},
      {3, "effects: [drag: {frame: bodi}]",
       "s.yaml:3: no frame is named 'bodi', the nearest are 'body', 'root_joint' and 'universe'"},
      {3, "effects: [drag: {linear: 1}]", "s.yaml:3: drag needs 'frame': where it acts"},
      {3, "effects: [drag: {frame: body, linear: -1}]",
       "s.yaml:3: drag.linear is '-1': it must not be below 0"},
      {3, "effects: [joint_damping: {joints: hip}]",
       "s.yaml:3: no joint is named 'hip', the nearest are 'universe' and 'root_joint'"},
      {3, "effects: [contact: {frames: [body], stiffness: 1 kN/m}]",
       "s.yaml:3: contact without a ground: write 'ground: {height: 0}' in the scene"},
      {3, "effects: [thruster: {frame: body, thrust: 1, direction: [0, 0, 0]}]",
       "s.yaml:3: thruster.direction is zero: it has no direction"},
      {3, "effects: [armature: {joints: root_joint, inertia: 1}]", ""},
      {4, "integrator: {name: rkmk4, step: -1 ms}",
       "s.yaml:4: integrator.step is '-1 ms': it must be above 0"},
      {4, "integrator: {name: rkmk4, step: .nan}", "s.yaml:4: integrator.step: '.nan' is not a number in s"},
      {4, "integrator: {name: rkmk4, step: nan}",
       "s.yaml:4: integrator.step: 'nan' is not finite: write a number in s"},
      {4, "integrator: {name: rkmk4, step: 1e999}",
       "s.yaml:4: integrator.step: '1e999' is outside the range of double"},
      {4, "integrator: {name: rkmk4, step: 1e-400}",
       "s.yaml:4: integrator.step: '1e-400' is outside the range of double"},
      {4, "integrator: {name: rkmk4, step: 1e-323 ms}",
       "s.yaml:4: integrator.step: '1e-323 ms' is outside the range of double"},
      {4, "integrator: {name: rkmk4, step: +-1}", "s.yaml:4: integrator.step: '+-1' is not a number in s"},
      {4, "integrator: {name: rkmk4, step: [1]}", "s.yaml:4: integrator.step is one number, not a list"},
      {4, "integrator: {name: rkmk4, step: fast}", "s.yaml:4: integrator.step: 'fast' is not a number in s"},
      {4, "integrator: {name: rkmk4, step: 3 ms}",
       "s.yaml:4: duration is not a multiple of integrator.step: it fits 333.333333 times"},
      {4, "integrator: {name: rkmk5, step: 1 ms}",
       "s.yaml:4: no integrator is named 'rkmk5', the nearest are 'rkmk4', 'rkmk6' and 'rk2'"},
      {4, "integrator: {name: rkmk4}", "s.yaml:4: integrator 'rkmk4' needs 'step', such as 1 ms"},
      {4, "integrator: {name: rkmk4, step: 1 ms, tolerance: 1}",
       "s.yaml:4: integrator 'rkmk4' takes a step, not a tolerance"},
      {4, "integrator: {name: dopri5, tolerance: 1e-20}",
       "s.yaml:4: integrator.tolerance is below 1e-15, which double cannot reach"},
      {4, "", "s.yaml: the scene needs 'integrator': {name: rkmk4, step: 1 ms}"},
      {5, "duration: 0 s", "s.yaml:5: duration is '0 s': it must be above 0"},
      {6, "observers: [imu: {frame: head}]",
       "s.yaml:6: no frame is named 'head', the nearest are 'body', 'universe' and 'root_joint'"},
      {6, "observers: [imu: {frame: body, seed: 1.5}]",
       "s.yaml:6: imu.seed is not a whole number up to 9e15"},
      {6, "observer: [energy]",
       "s.yaml:6: the scene has no key 'observer', the nearest are 'observers', 'scene' and 'shapes'"},
      {7, "duration: 2 s", "s.yaml:7: key 'duration' of the scene is given twice: keep one"},
      {7, "truth: [a", "s.yaml:8: is not YAML: end of sequence flow not found"},
      {7, "actuation: [pd: {stiffness: 1}]", "s.yaml:7: pd needs 'damping' [N m s/rad|N s/m]: d"},
      {7, "actuation: [table: {times: [1, 0], forces: [1, 2]}]",
       "s.yaml:7: table.times[1] is before the time before it: write the times in order, and a time twice "
       "for a jump"},
      {7, "actuation: [table: {joints: root_joint, times: [0, 1], forces: [1]}]",
       "s.yaml:7: a table of 2 times and 1 forces: give one force for each time"},
      {7, "frames: [{name: body, on: body}]",
       "s.yaml:7: the robot has a frame 'body' already: take another name"},
      {1, "robot: {body: bax, size: [1, 2, 3]}",
       "s.yaml:1: no built-in body is named 'bax', the nearest are 'box', 'ball' and 'body'"},
      {1, "robot: {body: body, moments: [1, 1, 3]}",
       "s.yaml:1: no body can have these moments of inertia: each must be above 0 and no larger than the sum "
       "of the other two"},
      {1, "robot: {body: box, size: [1, 2, 3], mass: 0}", "s.yaml:1: robot.mass is '0': it must be above 0"},
      {1, "robot: {body: box, size: [1e200, 2, 3]}",
       "s.yaml:1: the moments of inertia overflow: take a smaller mass or size"},
      {1, "robot: {body: box, size: [1, 2, 3], root: revolute, axis: [0, 0, 0]}",
       "s.yaml:1: robot.axis is zero: it has no direction"},
      {1, "robot: {urdf: none.urdf}",
       "s.yaml:1: robot.urdf: " + (scenes / "none.urdf").lexically_normal().string() +
           ": cannot be opened (No such file or directory)"},
      {1, "robot: {urdf: chain.urdf, body: box}", "s.yaml:1: robot needs one of 'urdf', 'body' and 'bodies'"},
      {1, "robot: box", "s.yaml:1: robot is a map: {body: box, size: [1, 1, 1]} or {urdf: FILE}"},
      {1, "robot: {body: box, size: [1, 2, 3], root: flying}",
       "s.yaml:1: robot.root is 'flying', the nearest are 'fixed', 'planar' and 'continuous'"},
      {2, "initial: {quaternion: [0, 0, 0, 0]}",
       "s.yaml:2: initial.quaternion is zero, which is not a rotation"},
      {2, "initial: {start: dzanibekov}",
       "s.yaml:2: no start is named 'dzanibekov', the nearest are 'dzhanibekov', 'major_spin' and "
       "'minor_spin'"},
      {2, "initial: {start: sleeping_top, rate: 1}",
       "s.yaml:2: start 'sleeping_top' needs a top on a spherical root, symmetric about its z axis"},
      {3, "effects: [joint_damping: {coefficient: 1}]",
       "s.yaml:3: the robot has no joint that this can act on, except a free-flyer, which must be named"},
      {3, "effects: [joint_damping: {joints: [universe], coefficient: 1}]",
       "s.yaml:3: none of the joints named has a coordinate"},
      {1, "robot: {body: box, size: [1, 2, 3], root: spherical, axis: [1, 0, 0]}",
       "s.yaml:1: robot.axis needs a revolute, continuous or prismatic root, not 'spherical'"},
      {2, "initial: {start: dzhanibekov, angular_velocity: [1, 2, 3]}",
       "s.yaml:2: start 'dzhanibekov' sets the angular velocity, and initial gives it, too: keep one"},
      {6, "observers: [energy]\ntruth: triaxal",
       "s.yaml:7: no closed form is named 'triaxal', the nearest are 'triaxial', 'free_fall' and 'pendulum'"},
      {1, "robot: {body: box, size: [1, -2, 3]}", "s.yaml:1: a side of a box is below 0"},
      {3, "effects: [gravity, gravity]", "s.yaml:3: 'gravity' is given twice with the same keys: keep one"},
      {3, "effects: [contact: {frames: [body, body]}]",
       "s.yaml:3: contact.frames names 'body' twice: keep one"},
      {3, "effects: [wrench: {frame: body, from: 2, until: 1}]",
       "s.yaml:3: the wrench's 'until' is not after its 'from'"},
      {6, "observers: [energy, energy]",
       "s.yaml:6: observer 'energy' writes kinetic, which another observer writes too: keep one"},
      {6, "observers: [energy]\nreason: \"a\\nb\"",
       "s.yaml:7: reason holds a control character or a line break: write one line of text"},
      {6, "observers: [energy]\nreason: \xff", "s.yaml:7: is not UTF-8"},
      {5, "duration: 1e308 s",
       "s.yaml:4: duration is not a multiple of integrator.step: it fits more than 1e15 times"},
      {2, "initial: {joints: {root: 1}}",
       "s.yaml:2: initial.joints has no key 'root', the nearest are 'root_joint' and 'universe'"},
  };
  for (const Bad& bad : table) {
    const std::string said = refusalOfText(with(bad.line, bad.text));
    if (bad.message.empty())
      EXPECT_EQ(said, "accepted") << bad.text;
    else
      EXPECT_EQ(said, bad.message) << bad.text;
  }
}

TEST(SceneFile, ATextThatIsNoSceneIsRefused) {
  EXPECT_EQ(refusalOfText(""),
            "s.yaml: is not a scene: it has no keys such as 'robot: {body: box, size: [1, 1, 1]}'");
  EXPECT_EQ(refusalOfText(std::string("a\0b", 3)), "s.yaml: is not text: it contains a zero byte");
  EXPECT_NE(refusalOfText("%PDF-1.4 \x01\x02"), "accepted");
  EXPECT_NE(refusalOfText(std::string(100000, '[')),
            "accepted");  // a recursive parser would overflow its stack
  EXPECT_TRUE(has(refusalOfText(std::string(max_scene_bytes + 1, 'a')), "longer than the limit of a scene"));
  EXPECT_NE(refusalOfText("a: &x [*x]\n"), "accepted");
  EXPECT_THROW(loadScene((scenes / "missing.yaml").string()), SceneError);
  EXPECT_THROW(loadScene(scenes.string()), SceneError);
  // yaml-cpp's LoadAll returns documents without end here.
  EXPECT_EQ(refusalOfText(", a: 1}\n"), "s.yaml:1: is not YAML: a value cannot begin so");
  EXPECT_EQ(refusalOfText("\n" + std::string(3000, '[')), "s.yaml:2: is nested too deeply");
  EXPECT_EQ(refusalOfText("a: 1\n---\nb: 2\n"),
            "s.yaml:2: contains several documents: a scene is one document");
}

/// The seconds of the program's own work to read a scene and plan it. A busy machine changes them less than the time of
/// a clock.
double planned(const std::string& text) {
  const auto used = [] {
    rusage all{};
    ::getrusage(RUSAGE_SELF, &all);
    return static_cast<double>(all.ru_utime.tv_sec) + 1e-6 * static_cast<double>(all.ru_utime.tv_usec);
  };
  const double start = used();
  const scene::Scene s = loadSceneText(text, "s.yaml", scenes.string());
  EXPECT_FALSE(scene::plan(s, scene::Measuring()).stages.empty());
  return used() - start;
}
/// They take less than 1 s on an idle core; comparing each with each other takes ten times as long.
TEST(SceneFile, FifteenThousandEffectsOrTwentyThousandFramesAreReadInSeconds) {
  const auto effects = [](int n) {
    std::string text = with(3, "effects:\n  - gravity");
    std::string all = "effects:\n  - gravity\n";
    for (int i = 0; i < n; ++i)
      all += "  - wrench: {frame: body, force: [" + std::to_string(i) + ", 0, 0]}\n";
    return text.replace(text.find("effects:\n  - gravity\n"), 21, all);
  };
  const auto frames = [](int n) {
    std::string all = "frames:\n";
    for (int i = 0; i < n; ++i)
      all += "  - {name: f" + std::to_string(i) + ", on: body, position: [0.1, 0, 0]}\n";
    return with(1, good[0] + "\n" + all);
  };
  EXPECT_LT(planned(effects(15000)), 6);
  EXPECT_LT(planned(frames(20000)), 6);
}

TEST(SceneFile, AStartKeepsWhatItDoesNotSet) {
  const scene::Scene s = loadSceneText(
      with(2, "initial: {start: dzhanibekov, rate: 3 rad/s, position: [1, 2, 3], velocity: [4, 0, 5]}"),
      "s.yaml", scenes.string());
  EXPECT_EQ(s.q.head<3>(), V3(1, 2, 3));
  EXPECT_EQ(s.v.head<3>(), V3(4, 0, 5));
  EXPECT_NEAR(s.v.tail<3>().norm(), 3, 1e-3);
}

TEST(SceneFile, TheVariationalMethodNeedsALoneBody) {
  std::string text =
      "robot: {urdf: chain.urdf}\nintegrator: {name: variational, step: 1 ms}\nduration: 1 s\n";
  EXPECT_EQ(
      refusalOfText(text),
      "s.yaml:2: integrator 'variational' is for one body on a free_flyer root only: take implicit_midpoint");
}

TEST(Units, AreConvertedToSi) {
  EXPECT_EQ(parseQuantity("2 ms", "s"), 0.002);
  EXPECT_DOUBLE_EQ(parseQuantity("180 deg", "rad"), pi<double>());
  EXPECT_DOUBLE_EQ(parseQuantity("60 rpm", "rad/s"), 2 * pi<double>());
  EXPECT_DOUBLE_EQ(parseQuantity("9.81 m s^-2", "m/s^2"), 9.81);
  EXPECT_DOUBLE_EQ(parseQuantity("3 kN/m", "N m/rad|N/m"), 3000);
  EXPECT_DOUBLE_EQ(parseQuantity("5 g m^2", "kg m^2"), 0.005);
  EXPECT_DOUBLE_EQ(parseQuantity("1 rad/s/sqrt(Hz)", "rad/s/sqrt(Hz)"), 1);
  EXPECT_DOUBLE_EQ(parseQuantity("36 km/h", "m/s"), 10);
  std::string inverse, back;  // their product is 1, but the first is below the range of double
  for (int i = 0; i < 12; ++i) inverse += " km^-9", back += " km^9";
  EXPECT_THROW(parseQuantity("1 m" + inverse + back, "m"), std::invalid_argument);
  EXPECT_EQ(parseQuantity("5e-324 m", "m"), 5e-324);
  EXPECT_THROW(parseQuantity("5e-324 deg", "rad"), std::invalid_argument);
  EXPECT_THROW(parseQuantity("1 m^", "m"), std::invalid_argument);
  EXPECT_THROW(parseQuantity("1 m^99", "m"), std::invalid_argument);
  EXPECT_THROW(parseQuantity("0x10", "1"), std::invalid_argument);
}

/// What the program warns of when it reads a scene.
std::string warningsOf(const std::string& text) {
  std::vector<std::string> all;
  loadSceneText(text + "integrator: {name: rkmk4, step: 1 ms}\nduration: 10 ms\n", "s.yaml", scenes.string(),
                &all);
  std::string lines;
  for (const std::string& one : all) lines += one + "\n";
  return lines;
}

TEST(Warnings, NameWhatASceneMayNotMean) {
  const std::string ball = "robot: {body: ball, radius: 0.1, root: free_flyer}\n",
                    effects = ball + "effects:\n  - ";
  EXPECT_EQ(warningsOf(effects + "drag: {frame: body, linear: 1}\n"), "");
  EXPECT_TRUE(has(warningsOf(effects + "drag: {frame: body, current: [1, 0, 0]}\n"),
                  "s.yaml:3: this drag has no coefficient"));
  EXPECT_TRUE(
      has(warningsOf(effects + "wrench: {frame: body}\n"), "s.yaml:3: this wrench has no coefficient"));
  const std::string fluid =
      effects + "added_mass: {masses: [1, 1, 1]}\n  - drag: {frame: body, linear: 1, current: ";
  EXPECT_EQ(warningsOf(fluid + "[0, 0, 0]}\n"), "");
  EXPECT_TRUE(
      has(warningsOf(fluid + "[1, 0, 0]}\n"), "in the current of the drag in line 4 its forces are wrong"));
  const auto drop = [&](const char* z) {
    return warningsOf(ball + "ground: {height: 0}\ninitial: {position: [0, 0, " + z +
                      "]}\neffects: [gravity, {contact: {bodies: all, stiffness: 1e5}}]\n");
  };
  EXPECT_EQ(drop("0.0999"), "");  // where it would rest
  EXPECT_TRUE(has(drop("-0.2"), "s.yaml:4: this contact begins 0.3 m below the ground"));
  const auto leg = [&](const char* angle) {
    return warningsOf("robot: {urdf: ../robots/quadruped.urdf}\ninitial: {joints: {front_left_knee: " +
                      std::string(angle) + "}}\n");
  };
  EXPECT_TRUE(has(leg("40"), "s.yaml:2: joints begin beyond their limits: 'front_left_knee' at 40, limit "));
}

TEST(SceneFile, SaysWhatToWriteInsteadOfAUnitBehindAListOrAnUnknownOne) {
  EXPECT_TRUE(has(refusalOfText(with(2, "initial: {attitude: [30, 0, 0] deg}")),
                  "each number has its own unit: write [30 deg, 0 deg, 0 deg]"));
  const std::string pounds = refusalOfText(with(1, "robot: {body: ball, radius: 1, mass: 1 lb}"));
  EXPECT_TRUE(has(pounds, "unknown unit 'lb' in 'lb', the nearest are 'g', 'kg' and 't'") ||
              has(pounds, "unknown unit 'lb' in 'lb', the nearest are 'g', 't' and 'kg'"))
      << pounds;
}

TEST(SceneFile, AMimicJointHasNoStartOfItsOwn) {
  written(
      "tied.urdf",
      "<robot name='tied'><link name='a'/><link name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' "
      "izz='1' "
      "ixy='0' ixz='0' iyz='0'/></inertial></link><link name='c'/><joint name='one' "
      "type='continuous'><parent "
      "link='a'/><child link='b'/></joint><joint name='two' type='continuous'><parent link='b'/><child "
      "link='c'/><mimic joint='one'/></joint></robot>");
  const std::string scene =
      written("tied.yaml", "robot: {urdf: tied.urdf, root: fixed}\ninitial: {joints: {two: 1}}\n");
  expectSaid("scene run " + scene, 2, {"joint 'two' has no coordinates because it mimics 'one'"});
}

TEST(Fixtures, EachSceneGivesItsReasonRunsAndStaysFinite) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(scenes)) {
    if (entry.path().extension() != ".yaml") continue;
    ++count;
    SCOPED_TRACE(entry.path().filename().string());
    scene::Scene s = loadScene(entry.path().string());
    EXPECT_FALSE(s.reason.empty());
    // a twentieth of its duration
    s.span.duration /= 20, s.span.steps = std::max(1L, s.span.steps / 20),
                           s.span.every = std::max(1L, s.span.steps / 10);
    const scene::Run run = scene::run(s);
    EXPECT_FALSE(run.outcome.diverged) << run.outcome.why;
    for (const double x : run.rows) ASSERT_TRUE(std::isfinite(x));
    EXPECT_FALSE(scene::plan(s).stages.empty());
  }
  EXPECT_GE(count, 25);
}

/// Effects that a scene does not list, or lists as none, do not change its results.
TEST(Fixtures, EffectsThatASceneDoesNotListChangeNoBit) {
  const auto bits = [](const std::string& more) {
    return scene::run(
               loadSceneText(
                   with(3, "initial_: 0").replace(with(3, "initial_: 0").find("initial_: 0"), 11, more) +
                   "\n"))
        .rows;
  };
  const auto bare = bits("");
  EXPECT_EQ(bits("effects: []"), bare);
  EXPECT_EQ(bits("effects: none\nactuation: none\nground: {height: -1}"), bare);
  EXPECT_NE(bits("effects: [gravity]"), bare);
  EXPECT_EQ(bits(""), bare);
}

TEST(Fixtures, TheReadmeContainsTheSchema) {
  std::ifstream f(scenes / "README.md");
  std::ostringstream text;
  text << f.rdbuf();
  EXPECT_TRUE(has(text.str(), sceneSchema()))
      << "put into fixtures/scenes/README.md what 'liecheck scene keys' prints";
}

TEST(Program, AnInvalidScenePrintsOneLineAndExitsWithTwo) {
  const std::string path = written("bad.yaml", with(3, "effects: [gravty]"));
  EXPECT_EQ(expectSaid("scene run " + path, 2),
            "liecheck: " + path +
                ":3: 'gravty' is not known in effects, the nearest are 'gravity', 'drag' and 'wrench'\n");
}

TEST(Program, ComparesTheEndWithTheClosedFormThatTheSceneNames) {
  const std::string pendulum =
      "robot: {body: box, root: revolute, axis: [1, 0, 0], size: [0.02, 0.02, 1], centre: [0, 0, -0.5]}\n"
      "initial: {joints: {root_joint: 1}}\n";
  const std::string swing = pendulum + "effects: [gravity]\naccuracy: {angle: 1e-3}\nduration: 5 s\n";
  const auto expect = [](int code, const std::string& text, const std::vector<std::string>& parts) {
    expectSaid("scene run " + written("truth.yaml", text), code, parts);
  };
  expect(0, swing + "integrator: {name: rkmk4, step: 1 ms}\ntruth: pendulum\n",
         {"error at the end, attitude", "beside the closed form 'pendulum'"});
  expect(1, swing + "integrator: {name: rk2, step: 50 ms}\ntruth: pendulum\n",
         {"the error beside the closed form exceeds what the scene accepts"});
  expect(2, swing + "integrator: {name: rk2, step: 1 ms}\ntruth: damped_spring\n",
         {"the closed form of this motion is 'pendulum', not 'damped_spring'"});
  expect(2,
         pendulum +
             "effects: [gravity, joint_friction: {force: 1}]\nduration: 1 s\n"
             "integrator: {name: rkmk4, step: 1 ms}\ntruth: pendulum\n",
         {"has no closed form"});
}

TEST(Program, ADivergingRunWritesItsSamplesAndExitsWithThree) {
  const std::string csv = liecheck::scratch() + "diverging.csv";
  const std::string path =
      written("diverging.yaml",
              "robot: {body: ball, root: prismatic, radius: 1}\ninitial: {joints: {root_joint: 1 m}}\n"
              "effects: [joint_spring: {stiffness: 1e6 N/m}]\nintegrator: {name: euler, step: 1 s}\n"
              "duration: 1000 s\nobservers: [energy]\noutput: {every: 1 s}\n");
  expectSaid("scene run " + path + " --csv " + csv, 3, {"diverged at step ", "a number is no longer finite"});
  std::ifstream f(csv);
  std::string line;
  int lines = 0;
  while (std::getline(f, line)) {
    ++lines;
    EXPECT_FALSE(has(line, "nan"));
    EXPECT_FALSE(has(line, "inf"));
  }
  EXPECT_GT(lines, 10);
}

std::string chainOf(const std::string& integrator) {
  fs::copy_file(scenes / "chain.urdf", liecheck::scratch() + "chain.urdf", fs::copy_options::update_existing);
  return "robot: {urdf: chain.urdf}\ninitial: {angular_velocity: [0.5, 1, 0.2], joint_velocities: {hinge1: "
         "1, hinge2: -2, hinge3: "
         "1.5}}\n"
         "integrator: " +
         integrator + "\nduration: 5 s\nobservers: [momentum]\noutput: {every: 2.5 s}\n";
}

TEST(Program, ARunDivergesIfAnObservedNumberIsNotFinite) {
  // so heavy that its energy overflows one step before its state does
  const std::string csv = liecheck::scratch() + "overflow.csv";
  const std::string path = written(
      "overflow.yaml",
      "robot: {body: ball, root: prismatic, radius: 1, mass: 1e6}\ninitial: {joints: {root_joint: 1 m}}\n"
      "effects: [joint_spring: {stiffness: 1e12 N/m}]\nintegrator: {name: euler, step: 1 s}\n"
      "duration: 1000 s\nobservers: [energy]\noutput: {every: 1 s}\n");
  const std::string said = expectSaid("scene run " + path + " --csv " + csv, 3, {" is no longer finite"});
  EXPECT_FALSE(has(said, "a number is"));  // the message names the number
  EXPECT_FALSE(has(said, "inf "));
  EXPECT_FALSE(has(said, "nan"));
  std::ifstream rows(csv);
  std::string line, last;
  int lines = 0;
  while (std::getline(rows, line)) ++lines, last = line;
  ASSERT_GT(lines, 10);
  EXPECT_FALSE(has(last, "inf"));
  EXPECT_FALSE(has(last, "nan"));
  // The CSV has a header, the start, and a row for each good step. The program reports the last good step.
  const std::string good = std::to_string(lines - 2);
  EXPECT_EQ(last.substr(0, last.find(',')), good);
  EXPECT_TRUE(has(said, good + " s in " + good + " steps of 1 s"));
  EXPECT_TRUE(has(said, "diverged at step " + std::to_string(lines - 1) + " of 1000 (t = " + good + " s): "));
  // A scene that is not finite at the start is refused.
  const std::string fast = written("fast.yaml", with(2, "initial: {angular_velocity: [0, 0, 1e160]}"));
  expectSaid("scene run " + fast, 2, {fast + ": at the start kinetic is not a finite number"});
  // A change whose square overflows is still finite.
  const std::string figures =
      expectSaid("scene run " + written("coarse.yaml", chainOf("{name: rkmk4, step: 2.5 s}")), 1,
                 {"energy changes by more than 1 %"});
  EXPECT_FALSE(has(figures, " inf "));
}

TEST(Program, ARotationBeyondPiInAStepIsAWarningUnlessTheMethodChoosesItsSteps) {
  const auto [code, said] =
      printed("scene run " + written("turns.yaml", chainOf("{name: rkmk4, step: 2.5 s}")));
  EXPECT_TRUE(has(said, "beyond pi"));
  const std::string own =
      expectSaid("scene run " + written("own.yaml", chainOf("{name: dopri5, step: 2.5 s}")), 0);
  EXPECT_FALSE(has(own, "warning"));
}

TEST(Program, TheSceneTheCsvAndTheJsonMustBeDifferentFiles) {
  const std::string path = written("apart.yaml", with(5, "duration: 10 ms")),
                    out = liecheck::scratch() + "apart.out";
  expectSaid("scene run " + path + " --csv " + path, 2, {path + ": would replace the file of FILE"});
  expectSaid("scene run " + path, 0);  // the scene was not overwritten
  expectSaid("scene run " + path + " --csv " + out + " --json " + out, 2,
             {"would replace the file of --csv"});
  EXPECT_FALSE(fs::exists(out));
}

TEST(Program, AColumnNameWithACommaIsQuotedInTheCsv) {
  const std::string csv = liecheck::scratch() + "quoted.csv";
  const std::string path = written(
      "quoted.yaml", with(6, "frames: [{name: 'a,\"b', on: body}]\nobservers: [frame: {frame: 'a,\"b'}]"));
  expectSaid("scene run " + path + " --csv " + csv, 0);
  std::ifstream rows(csv);
  std::string head;
  std::getline(rows, head);
  EXPECT_TRUE(head.starts_with("t [s],\"a,\"\"b.")) << head;
}

/// SIGTERM stops a run within 2.5 s: between distant samples, inside one step of a method that chooses its
/// steps, or inside the second run of attitude_error. A tolerance that no step can meet is reported.
TEST(Program, StopsAtASignalWhereverTheRunIs) {
  for (const auto& [name, line, text] :
       {std::tuple("far.yaml", 4, "integrator: {name: rkmk4, step: 1e-9}"),
        {"own.yaml", 4, "integrator: {name: dopri5, tolerance: 1e-14}"},
        {"twin.yaml", 6, "observers: [attitude_error: {refinement: 1e9}]"}}) {
    std::string scene = with(std::size_t(line), text);
    if (line == 4) scene += "output: {every: 1 s}\n";
    if (std::string(name) == "own.yaml") scene.replace(scene.find("[0, 0, 1]"), 9, "[1e6, 1e6, 1]");
    expectSaid("scene run " + written(name, scene) +
                   " & p=$!; (sleep 3; kill -KILL $p) > /dev/null 2>&1 & sleep 0.5; kill -TERM $p; wait $p",
               3, {"interrupted at t = "});
  }
  std::string scene = with(4, "integrator: {name: dopri5, tolerance: 1e-8}");
  scene.replace(scene.find("[0, 0, 1]"), 9, "[1e100, 1e100, 1]");
  expectSaid("scene run " + written("lost.yaml", scene), 3, {"no step is small enough for the tolerance"});
}

TEST(Program, AStopSignalWritesTheSamplesAndExitsWithThree) {
  const std::string csv = liecheck::scratch() + "stopped.csv";
  const std::string path = written("long.yaml", with(5, "duration: 20000 s"));
  // SIGTERM, because the background jobs of a shell ignore SIGINT
  expectSaid("scene run " + path + " --csv " + csv + " & p=$!; sleep 1; kill -TERM $p; wait $p", 3,
             {"interrupted at t = "});
  EXPECT_TRUE(fs::exists(csv));
}

TEST(Program, ExplainsThePlan) {
  expectSaid("scene explain " + (scenes / "dzhanibekov_1e-6.yaml").string(), 0,
             {"a lone rigid body", "rigid-body equations", "gravity", "articulated bodies", "left out"});
}

}  // namespace
