// Trees of bodies over the process protocol: the example in Python, copies of it with planted faults, and what
// becomes of bad answers.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <adapters/check.hpp>
#include <adapters/subjects.hpp>
#include <adapters/trees.hpp>
#include <filesystem>
#include <fstream>
#include <subjects/typed.hpp>
#include <support/files.hpp>

#include "../campaigns.hpp"
#include "../refusal.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"
#include "asked.hpp"

namespace liecheck::properties::adapters {
namespace {

namespace fs = std::filesystem;
const fs::path example = LIECHECK_FIXTURES "/adapters/trees";

/// The command of a copy of the example named `name`, in whose `file` the text `from` is `to`.
std::string altered(const std::string& name, const std::string& file, const std::string& from,
                    const std::string& to) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = fs::path(liecheck::scratch()) / ("trees_" + test + "_" + name);
  fs::create_directories(folder);
  for (const auto& each : fs::directory_iterator(example)) {
    if (each.path().extension() != ".py") continue;
    std::string text = read_whole(each.path().string());
    const auto replace = [&](const std::string& old, const std::string& now) {
      const std::size_t at = text.find(old);
      EXPECT_NE(at, std::string::npos) << file << " has no " << old;
      if (at != std::string::npos) text.replace(at, old.size(), now);
    };
    if (each.path().filename() == "adapter.py") replace(R"("name": "trees")", R"("name": ")" + name + '"');
    if (each.path().filename() == file) replace(from, to);
    std::ofstream(folder / each.path().filename()) << text;
  }
  return "/usr/bin/python3 -B -W ignore " + (folder / "adapter.py").string();
}

CampaignResult campaign(const std::string& subject, const std::vector<std::string>& laws, std::uint64_t cases,
                        const Robot& robot = built_in_robot()) {
  return run_quietly({{subject}, laws, {}}, cases, 2, robot);
}

/// The rows of one law on an adapter that is not registered, by operation and block.
std::map<std::string, Row> rows_of(const std::string& command, const char* law, std::uint64_t cases,
                                   const Robot& robot, double timeout_s = 5) {
  const std::shared_ptr<Adapter> adapter = start_process(command, timeout_s);
  Subject tested{adapter->description().name, "1", command, &oracles::scalar_of<double>};
  tested.operations.tree = [adapter](const Tree<double>& tree) {
    TreeOperations<double> o;
    fill_tree(o, tree, adapter->description(), oracles::scalar_of<double>,
              [adapter]() -> Adapter& { return *adapter; });
    return o;
  };
  const auto series = series_of(law, tested, robot);
  Tally tally;
  for (std::uint64_t i = 0; i < cases; ++i) series->run(42, i, tally);
  std::map<std::string, Row> rows;
  for (const auto& [cell, row] : tally.rows) {
    const Output& o = series->outputs[static_cast<std::size_t>(cell.first)];
    rows[std::string(o.operation) + " " + std::string(o.block)].merge(row);
  }
  return rows;
}

Robot robot(const char* name, bool fixed = false) {
  return load_robot(LIECHECK_FIXTURES "/robots/" + std::string(name), fixed);
}

TEST(TreeAdapters, TheExampleObeysEveryLawByJointsAndByItsUrdfReader) {
  const std::string name = register_adapter("/usr/bin/python3 -B " + (example / "adapter.py").string());
  const CampaignResult random = campaign(name, {}, 12);
  EXPECT_FALSE(random.failed);
  std::set<std::string> laws;
  for (const SeriesResult& s : random.series) laws.insert(s.series->property);
  EXPECT_EQ(laws,
            (std::set<std::string>{"forward_dynamics", "frame_jacobian", "frame_motion", "lagrange",
                                   "mass_matrix", "power_balance", "tree_invariance", "tree_momentum"}));
  EXPECT_FALSE(campaign(name, {}, 6, robot("mixed_joints.urdf")).failed);
  EXPECT_FALSE(campaign(name, {}, 6, robot("quadruped.urdf", true)).failed);
}

struct Fault {
  const char *name, *file, *from, *to, *law, *found;  ///< `found`: the outputs that fail
  std::string robot = {};                             ///< a URDF, or "" for random trees
};

/// Two joints on one link, one of them rotated about all axes, with a link fixed to its body.
const std::string two_joints = R"(<robot name="two">
  <link name="base"/>
  <joint name="z" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0.6 0.8"/>
    <origin xyz="0.1 0.2 0.3" rpy="0.5 -0.7 0.9"/><limit effort="1" velocity="1" lower="-9" upper="9"/></joint>
  <joint name="a" type="prismatic"><parent link="base"/><child link="slide"/><axis xyz="1 0 0"/>
    <limit effort="1" velocity="1" lower="-9" upper="9"/></joint>
  <joint name="tool_mount" type="fixed"><parent link="arm"/><child link="tool"/>
    <origin xyz="0.4 0 0.1" rpy="0 0 0.3"/></joint>
  <link name="arm"><inertial><mass value="2"/><origin xyz="0.1 0 0"/>
    <inertia ixx="0.1" ixy="0.01" ixz="0" iyy="0.2" iyz="0" izz="0.25"/></inertial></link>
  <link name="slide"><inertial><mass value="1"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <link name="tool"><inertial><mass value="0.5"/><origin xyz="0.1 0.1 0"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
</robot>)";

const Fault faults[] = {
    {"coriolis_sign", "tree.py", "I @ A[i] - ad(V[i]).T @ I", "I @ A[i] + ad(V[i]).T @ I", "lagrange",
     "tree_nonlinear_effects torque, tree_rnea torque"},
    {"body_forgotten", "tree.py", "for b in bodies:", "for b in bodies[1:]:", "power_balance",
     "tree_power power"},
    {"jacobian_in_local", "tree.py", "self.seen(q, frame, reference) @ J", "self.seen(q, frame, 1) @ J",
     "frame_jacobian", "frame_jacobian angular, frame_jacobian linear"},
    {"nan_at_zero", "tree.py", "np.sin(q[0]))", "np.sin(q[0]) * q[0] / q[0])", "power_balance",
     "tree_power power"},
    {"gravity_twice", "tree.py", "-self.gravity)", "-2 * self.gravity)", "power_balance", "tree_power power"},
    {"wrench_sign", "tree.py", "F[joint] - wrench", "F[joint] + wrench", "forward_dynamics",
     "tree_aba acceleration"},
    {"no_armature", "tree.py", "np.diag(self.armature)", "np.zeros((self.nv, self.nv))", "mass_matrix",
     "crba_columns matrix, crba_positive matrix"},
    {"rpy_reversed", "urdf.py", "R = turn @ R", "R = R @ turn", "frame_jacobian",
     "frame_jacobian angular, frame_jacobian linear", two_joints},
    {"fixed_link_lost", "urdf.py", "if joint < 0 or", "if joint < 0 or p.any() or", "power_balance",
     "tree_power power", two_joints},
    {"other_order", "urdf.py", "model[\"order\"]", "model[\"order\"][::-1]", "power_balance",
     "tree_power power", two_joints},
};

TEST(TreeAdapters, TheLawsFindEachPlantedFault) {
  for (const Fault& f : faults) {
    const Robot on = f.robot.empty() ? built_in_robot() : robot_of(f.robot, "two.urdf", true);
    std::set<std::string> found;
    for (const auto& [output, row] : rows_of(altered(f.name, f.file, f.from, f.to), f.law, 40, on)) {
      if (row.failed > 0) found.insert(output);
      EXPECT_TRUE(f.name != std::string("nan_at_zero") || row.not_finite == row.failed);
      EXPECT_EQ(row.refused + row.crashed, 0u) << f.name << output;
    }
    EXPECT_EQ(fmt::format("{}", fmt::join(found, ", ")), f.found) << f.name;
  }
}

TEST(TreeAdapters, AFailureIsPrintedWithWhatTheAdapterReturned) {
  const Fault& f = faults[0];
  const std::string command =
      "timeout -s KILL 60 " LIECHECK_PROGRAM
      " campaign --no-hard-cases --verbose --cases 3 -j 1 --property lagrange --adapter '" +
      altered(f.name, f.file, f.from, f.to) + "'";
  const auto [code, text] = shell(command);
  EXPECT_EQ(code, 1) << text;
  for (const char* part : {"\n  result    tau of tree_nonlinear_effects\n",
                           "\n  replay    liecheck replay raw", "\nverdict fail"})
    EXPECT_NE(text.find(part), text.npos) << part << text;
}

TEST(TreeAdapters, AFaultOfTheUrdfReaderIsNoneOfRandomTrees) {
  const Fault& f = *std::ranges::find(faults, std::string("rpy_reversed"), &Fault::name);
  for (const auto& [output, row] :
       rows_of(altered(f.name, f.file, f.from, f.to), f.law, 10, built_in_robot()))
    EXPECT_EQ(row.failed, 0u);
}

/// What becomes of one call of tree_crba of a pendulum, in words.
std::string failure_of(const std::string& command, double timeout_s) {
  const auto adapter = start_process(command, timeout_s);
  const auto urdf = urdf_model(two_joints, true);
  const adapters::Model model(*urdf, oracles::scalar_of<double>, [&]() -> Adapter& { return *adapter; });
  try {
    const auto M = asked(model, op::tree_crba, {0.1, 0.2});
    EXPECT_EQ(M.size(), 4u);
    EXPECT_EQ(asked(model, op::tree_crba, {0.1, 0.2}), M);
  } catch (const CallFailed& e) {
    EXPECT_EQ(e.outcome, Outcome::crashed);
    return e.what();
  } catch (const std::domain_error& e) {
    return e.what();
  }
  return "";
}

TEST(TreeAdapters, WhatIsWrongWithACallIsSaidInWords) {
  struct {
    const char *from, *to, *said;
  } const cases[] = {
      {"\"done\"", "\"done\"", ""},
      {"tree, said = Tree(json.loads(line[6:])), \"done\"", "raise ValueError(\"no arms\")",
       "the input is refused: the model is refused: ValueError('no arms')"},
      {"\"done\"", "\"hello\"",
       "the adapter wrote 'hello' where the line 'done' or 'refused' after a model is due"},
      {"tree, said =", "while True: pass  #",
       "the adapter wrote nothing in 1 s where the line 'done' or 'refused' after a model is due"},
      {"tree, said =", "sys.exit(3)  #", "the adapter ended with exit code 3"},
      {"\"vv\": tree.nv**2", "\"vv\": tree.nv", "the adapter ended with exit code 1"},
      {".tobytes())\n    answers", ".tobytes()[:-8])\n    answers",
       "the adapter wrote 24 of 32 bytes of its results, and then nothing for 1 s"},
      {".tobytes())\n    answers", ".tobytes() + b'x')\n    answers",
       "the adapter wrote 1 bytes more than its answer has"},
      {"results[i] = ", "raise np.linalg.LinAlgError(\"singular\")  #", "the input is refused: singular"},
  };
  int number = 0;
  for (const auto& [from, to, said] : cases) {
    const bool late = std::string(said).find(" 1 s") != std::string::npos;
    EXPECT_EQ(failure_of(altered("answer" + std::to_string(number++), "adapter.py", from, to), late ? 1 : 20),
              said);
  }
}

TEST(TreeAdapters, AnAdapterThatIsStartedAgainGetsItsModelAgain) {
  const auto adapter = start_process(
      altered("ends", "adapter.py",
              "results[i] = ", "sys.exit(4) if x[0] == 7 else None\n                results[i] = "),
      5);
  const adapters::Model model(*urdf_model(two_joints, true), oracles::scalar_of<double>,
                              [&]() -> Adapter& { return *adapter; });
  const auto M = asked(model, op::tree_crba, {0.1, 0.2});
  EXPECT_THROW(asked(model, op::tree_crba, {7, 0.2}), CallFailed);
  EXPECT_EQ(asked(model, op::tree_crba, {0.1, 0.2}), M);
}

TEST(TreeAdapters, WhatIsNotOfferedHasNoRow) {
  const std::string only =
      altered("only_crba", "adapter.py", R"({name: ["float", "double"] for name in CALLS})",
              R"({"tree_crba": ["double"]})");
  std::set<std::string> measured;
  for (const char* law : {"lagrange", "mass_matrix", "forward_dynamics", "frame_motion"})
    for (const auto& [output, row] : rows_of(only, law, 4, built_in_robot())) measured.insert(output);
  EXPECT_EQ(measured,
            (std::set<std::string>{"crba_positive matrix", "crba_symmetric matrix", "tree_crba matrix"}));
}

TEST(TreeAdapters, AReaderOfUrdfsIsAskedOnlyAboutARobot) {
  const std::string name =
      register_adapter(altered("urdf_only", "adapter.py", R"(["joints", "urdf", "mimics"])", R"(["urdf"])"));
  EXPECT_TRUE(select({{name}, {}, {}}, built_in_robot()).empty());
  std::set<std::string> laws;
  const CampaignResult r = campaign(name, {}, 4, robot("quadruped.urdf"));
  for (const SeriesResult& s : r.series) laws.insert(s.series->property);
  EXPECT_FALSE(r.failed);
  EXPECT_EQ(laws.size(), 7u);
  EXPECT_FALSE(laws.contains("tree_invariance"));
}

TEST(TreeAdapters, TreesWithOtherJointsAreOutsideTheDomainAndNoPass) {
  const auto takes = [](const std::string& name, const std::string& joints) {
    return altered(name, "adapter.py", R"("models": ["joints", "urdf", "mimics"])",
                   "\"joints\": [" + joints + "]");
  };
  for (const auto& [output, row] : rows_of(takes("hinges", R"("revolute", "continuous", "armature")"),
                                           "mass_matrix", 60, built_in_robot())) {
    EXPECT_GT(row.outside_domain, 40u);
    EXPECT_GT(row.inside(), 0u);
    EXPECT_EQ(row.failed, 0u);
  }
  const std::string none = "campaign --no-hard-cases --cases 4 --property lagrange --robot " LIECHECK_FIXTURES
                           "/robots/quadruped.urdf --adapter '" +
                           takes("planar", R"("planar")") + "' > /dev/null 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system((LIECHECK_PROGRAM " " + none).c_str())), 3);  // incomplete
}

TEST(TreeAdapters, ACheckSaysWhichNumberIsWrong) {
  const std::string wrong = "number 1 of its result is -0.693901, and 0.383501 is right",
                    J = "return self.seen(q, frame, reference) @ J";
  const std::pair<const char*, std::string> cases[] = {
      {"return self.seen(q, frame, 1) @ J", wrong},
      {"J = self.seen(q, frame, reference) @ J; return -J",
       "number 1 of its result is -0.383501, and 0.383501 is right: it has the opposite sign"},
      {"return np.roll(self.seen(q, frame, reference) @ J, 3, 0)", ": its angular part comes first"},
      {"return (self.seen(q, frame, reference) @ J).T", ": it is stored column by column"}};
  int number = 0;
  for (const auto& [to, said] : cases) {
    const Checked checked = check(*start(altered("checked" + std::to_string(number++), "tree.py", J, to)));
    ASSERT_EQ(checked.findings.size(), 2u);
    const std::string& sentence = checked.findings[0].sentence;
    EXPECT_EQ(sentence.find("frame_jacobian of a chain of joints with two bodies each in WORLD: "), 0u);
    EXPECT_TRUE(sentence.ends_with(said)) << sentence;
    for (const CheckedOperation& o : checked.operations)
      EXPECT_EQ(o.complaint, o.operation == "frame_jacobian" ? "is wrong" : "") << o.operation;
  }
}

TEST(TreeAdapters, ACheckSaysWhereTheRateOfAJacobianLacksTheFramesOwnVelocity) {
  const std::string calls = "calls, answers = sys.stdin.buffer", rate = R"(
def rate(t, q, v, seen, frame):
    from tree import action, ad, inverse, rotation
    (R, p), i, J, V = (rotation(frame[1:5]), frame[5:]), int(frame[0]), np.zeros((6, t.nv)), t.motion(q, v, v)[0]
    while i >= 0:
        j = t.joints[i]
        J[:, j["v"]] += action(*inverse(R, p)) @ ad(V[i]) @ j["S"]
        R_i, p_i = t.pose(j, q)
        R, p, i = R_i @ R, p_i + R_i @ p, j["parent"]
    return t.seen(q, frame, seen[0]) @ J
CALLS["frame_jacobian_rate"] = ("q v 1 8", "6v", rate)
)";
  const Checked checked = check(*start(altered("rate", "adapter.py", calls, rate + calls)));
  ASSERT_FALSE(checked.findings.empty());
  const std::string& sentence = checked.findings[0].sentence;
  EXPECT_EQ(sentence.find("frame_jacobian_rate of a chain of joints with two bodies each in LOCAL: number "),
            0u)
      << sentence;
  EXPECT_TRUE(sentence.ends_with(" is right: it lacks - V x J, the frame's own velocity")) << sentence;
}

/// The functions of a tree of hinges and slides, each with another convention if `altered`.
std::string more_operations(bool altered) {
  return R"(
def static_torque(t, q, joint, F):
    return OTHER * t.rnea(q, np.zeros(t.nv), np.zeros(t.nv), int(joint[0]), F)
def coriolis(t, q, v):  # Christoffel's: half of h(v + e) - h(v) - h(e), without gravity
    h = lambda v: t.rnea(q, v, np.zeros(t.nv)) - t.rnea(q, 0 * v, 0 * v)
    C = np.array([h(v + e) - h(v) - h(e) for e in np.eye(t.nv)]) / 2
    # Another matrix with the same C v and C + C^T: plus a skew matrix that takes v to zero.
    S = np.zeros((t.nv, t.nv))
    S[:3, :3] = [[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]]
    return C - S if OTHER < 0 else C.T + S
def frame_derivatives(t, q, v, seen, frame):
    velocity = lambda q: t.frame_motion(q, v, 0 * v, seen[0], frame)[0]
    both = [np.array([velocity(q + 1e-5 * e) - velocity(q - 1e-5 * e) for e in np.eye(t.nv)]).T / 2e-5,
            t.frame_jacobian(q, seen[0], frame)]
    return both[::OTHER]
CALLS.update({"tree_static_torque": ("q 1 6", "v", static_torque), "tree_coriolis": ("q v", "vv", coriolis),
              "frame_velocity_derivatives": ("q v 1 8", "12v", frame_derivatives)})
description["operations"] = {name: ["double"] for name in CALLS}
description["trees"] = {"models": ["joints"], "joints": ["revolute", "prismatic", "helical"]}
OTHER = )" +
         std::string(altered ? "-1\n" : "1\n");
}

TEST(TreeAdapters, ACheckNamesTheConventionsOfMoreOperations) {
  const std::string start_of_answers = "answers.write(json.dumps(description)";
  const auto checked = [&](bool other) {
    return check(*start(altered(other ? "other" : "same", "adapter.py", start_of_answers,
                                more_operations(other) + start_of_answers)));
  };
  for (const conventions::Finding& f : checked(false).findings) ADD_FAILURE() << f.sentence;
  std::map<std::string, std::string> said;
  for (const conventions::Finding& f : checked(true).findings)
    said[f.operations.at(0)] = f.sentence.substr(f.sentence.rfind(": "));
  EXPECT_EQ(said, (std::map<std::string, std::string>{
                      {"frame_velocity_derivatives", ": its two parts are exchanged, 'by q' comes first"},
                      {"tree_coriolis", ": it is transposed"},
                      {"tree_static_torque", ": it has the opposite sign"}}));
}

TEST(TreeAdapters, AWrongCallOfTheProbeWhoseOperationPassesFails) {
  // Only one law has two bodies on a joint, and only for inverse dynamics.
  const std::string adapter =
      altered("probed", "tree.py", R"(R @ b["c"] + b["p"])", R"(R @ b["c"] + 2 * np.array(b["p"]))");
  const std::string record = liecheck::scratch() + "/probed.json";
  const auto [code, text] = shell("{ " LIECHECK_PROGRAM " test '" + adapter +
                                  "' --cases 30 --no-hard-cases --json " + record + " 2>/dev/null; }");
  EXPECT_EQ(code, 1);
  EXPECT_EQ(text.find("verdict fail: laws failed; calls of the probe are wrong"), 0u) << text;
  EXPECT_NE(text.find("\nWRONG  probed: tree_aba of a chain of joints with two bodies each: number "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(" are wrong there, too\n"), std::string::npos) << text;
  EXPECT_NE(read_whole(record).find(R"("verdict": "fail")"), std::string::npos);
  // Where no law measures them, they are remarks.
  const auto [other, some] = shell("{ " LIECHECK_PROGRAM " test '" + adapter +
                                   "' --cases 5 --no-hard-cases --property frame_jacobian 2>/dev/null; }");
  EXPECT_NE(other, 1);
  EXPECT_NE(some.find("\nremark  tree_rnea of a chain"), std::string::npos) << some;
}

TEST(TreeAdapters, ADescriptionThatIsWrongIsRefusedInWords) {
  const auto refusal = [](const std::string& trees) {
    return test::refusal<AdapterFailed>([&] {
      start(altered("described", "adapter.py", R"({"models": ["joints", "urdf", "mimics"]})", trees));
    });
  };
  EXPECT_NE(refusal("3").find("has no object 'trees'"), std::string::npos);
  EXPECT_NE(refusal(R"({"models": "urdf"})").find("has no list 'models' in 'trees'"), std::string::npos);
  EXPECT_NE(refusal(R"({"models": ["sdf"]})").find("where only joints, urdf, mimics are known"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"joints": []})").find("has an empty list 'joints' in 'trees'"), std::string::npos);
}

}  // namespace
}  // namespace liecheck::properties::adapters
