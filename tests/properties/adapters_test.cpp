// Libraries from outside the program: the process protocol, the C interface, and what becomes of bad ones.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <adapters/check.hpp>
#include <adapters/shared_memory.hpp>
#include <adapters/subjects.hpp>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <hard_cases/attempt.hpp>
#include <liecheck/spatial/euler.hpp>
#include <sstream>

#include "../campaigns.hpp"
#include "../refusal.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::properties::adapters {
namespace {

const std::string fixtures = LIECHECK_FIXTURES "/adapters/";

/// An adapter in shell that offers exp3_quaternion in double, and answers each call with `answer`.
std::string shell_adapter(const std::string& answer,
                          const std::string& description =
                              R"({"protocol": 1, "name": "shell", "version": "1", "operations": )"
                              R"({"exp3_quaternion": ["double"]}})") {
  const auto file = std::filesystem::path(liecheck::scratch()) /
                    ("adapter_" + std::to_string(std::hash<std::string>()(answer + description)) + ".sh");
  std::ofstream(file) << "read hello\necho '" << description
                      << "'\nwhile read call operation scalar n; do\nhead -c $((24 * n)) > /dev/null\n"
                      << answer << "\ndone\n";
  return "sh " + file.string();
}

/// The message of the exception of one call of exp3_quaternion.
std::string failure_of(const std::string& command, double timeout_s = 5) {
  std::array<double, 3> phi{0.1, 0.2, 0.3};
  std::array<double, 4> Q{};
  std::array<Status, 1> status{};
  return test::refusal<AdapterFailed>([&] {
    start_process(command, timeout_s)
        ->call({*sizes_of("exp3_quaternion"), true, 1, std::as_bytes(std::span(phi)),
                std::as_writable_bytes(std::span(Q)), status});
  });
}

TEST(Adapters, WhatIsWrongWithACallIsSaidInWords) {
  EXPECT_EQ(failure_of(shell_adapter("echo 'done 1'; head -c 33 /dev/zero")), "");
  const std::pair<const char*, const char*> cases[] = {
      {"kill -SEGV $$", "the adapter ended by signal 11 (Segmentation fault)"},
      {"kill -ABRT $$", "the adapter ended by signal 6 (Aborted)"},
      {"exit 0", "the adapter ended with exit code 0"},
      {"echo 'done 1'; head -c 20 /dev/zero; exit 3", "the adapter ended with exit code 3"},
      {"echo 'Hello'",
       "the adapter wrote 'Hello' where the line 'done 1' is due: does it print to standard output?"},
      {"echo 'done 2'", "the adapter wrote 'done 2' where the line 'done 1' is due"},
      {"echo 'done 1'; head -c 40 /dev/zero", "the adapter wrote 7 bytes more than its answer has"}};
  for (const auto& [answer, message] : cases) EXPECT_EQ(failure_of(shell_adapter(answer)), message) << answer;
}

TEST(Adapters, ThatDoNotAnswerInTimeAreEnded) {
  EXPECT_EQ(failure_of(shell_adapter("sleep 1000"), 0.2),
            "the adapter wrote nothing in 0.2 s where the line 'done 1' is due");
  EXPECT_EQ(failure_of(shell_adapter("echo 'done 1'; head -c 20 /dev/zero; sleep 1000"), 0.2),
            "the adapter wrote 19 of 32 bytes of its results, and then nothing for 0.2 s");
}

TEST(Adapters, ADescriptionThatIsWrongIsRefusedInWords) {
  const auto refusal = [](const std::string& description) {
    return failure_of(shell_adapter("exit 1", description));
  };
  EXPECT_NE(refusal("hello").find("is no JSON"), std::string::npos);
  EXPECT_NE(refusal("{}").find("has no member 'protocol'"), std::string::npos);
  const std::string newer = refusal(R"({"protocol": 2})");
  EXPECT_TRUE(newer.starts_with("the adapter speaks version 2 of the protocol, and liecheck 0.")) << newer;
  EXPECT_TRUE(newer.ends_with(" version 1")) << newer;
  EXPECT_NE(refusal(R"({"protocol": 1, "name": 3})").find("has no text 'name'"), std::string::npos);
  EXPECT_NE(refusal(R"({"protocol": 1, "name": "a", "version": "1", "operations": {"exp6": ["half"]}})")
                .find("neither \"float\" nor \"double\""),
            std::string::npos);
  EXPECT_NE(
      refusal(
          R"({"protocol": 1, "name": "a", "version": "1", "operations": {"exp6": ["float"], "exp6": ["double"]}})")
          .find("has 'exp6' twice"),
      std::string::npos);
  EXPECT_NE(failure_of("/does/not/exist").find("the shell did not find the command"), std::string::npos);
}

TEST(Adapters, ThatDescribeThemselvesOtherwiseWhenTheyAreStartedAgainAreNamed) {
  const std::string words = liecheck::scratch() + "description", script = liecheck::scratch() + "changes.sh";
  const auto describe = [&](const char* version) {
    std::ofstream(words) << R"({"protocol": 1, "name": "changes", "version": ")" << version
                         << R"(", "operations": {"exp3_quaternion": ["double"]}})"
                         << "\n";
  };
  std::ofstream(script) << "read hello; cat " << words << "; read call";  // it ends at the first call
  describe("1");
  const auto adapter = start_process("sh " + script, 5);
  std::array<double, 3> phi{0.1, 0.2, 0.3};
  std::array<double, 4> Q{};
  std::array<Status, 1> status{};
  const auto failure = [&] {
    return test::refusal<AdapterFailed>([&] {
      adapter->call({*sizes_of("exp3_quaternion"), true, 1, std::as_bytes(std::span(phi)),
                     std::as_writable_bytes(std::span(Q)), status});
    });
  };
  EXPECT_NE(failure().find("ended"), std::string::npos);
  describe("2");
  EXPECT_EQ(
      failure(),
      "the adapter was started again and describes itself otherwise: its version was '1' and is '2' now");
}

TEST(Adapters, ACrashIsAnOutcomeOfItsCaseAndTheCampaignGoesOn) {
  // It ends at each call of many inputs, so that each is asked alone, and then at every seventh one: so the number of
  // crashes does not depend on how many inputs the campaign's pace puts into a call.
  const std::string count = liecheck::scratch() + "calls";
  const std::string name = register_adapter(shell_adapter(
      "[ $n = 1 ] && i=$(($(cat " + count + " 2>/dev/null || echo 0) + 1)) && echo $i > " + count +
      "; if [ $n -gt 1 ] || [ $((i % 7)) = 0 ]; then kill -SEGV $$; fi; echo \"done "
      "$n\"; head -c $((33 * n)) /dev/zero"));
  EXPECT_EQ(name, "shell");
  const CampaignResult r = run_quietly({{"shell", "liecheck"}, {"exp_oracle"}, {"double"}}, 40);
  std::uint64_t crashed = 0;
  for (const SeriesResult& s : r.series)
    for (const auto& [cell, row] : s.tally.rows) {
      EXPECT_EQ(s.series->subject == "shell" ? 0 : row.crashed + row.failed, 0u);
      crashed += row.crashed;
    }
  EXPECT_GE(crashed, 4u);
  EXPECT_LE(crashed, 40u);
  EXPECT_THROW(register_adapter(shell_adapter("i=0")), std::invalid_argument);  // the name exists
}

/// python3 and nodejs are among the packages of the tests.
TEST(Adapters, TheExamplesAnswerAsTheyShould) {
  for (const std::string& command :
       {"/usr/bin/python3 " + fixtures + "rotations.py",
        "node " + fixtures + "../../install/npm/package/adapter.js " + fixtures + "rotations.mjs",
        std::string("in-process:" LIECHECK_C_ADAPTER)}) {
    const auto adapter = start(command);
    const Checked checked = check(*adapter);
    EXPECT_EQ(checked.operations.size(), adapter->description().offered.size()) << command;
    EXPECT_FALSE(checked.operations.empty());
    EXPECT_TRUE(std::ranges::all_of(checked.findings, &conventions::Finding::usual))
        << "choices as liecheck's";
    for (const CheckedOperation& o : checked.operations)
      EXPECT_EQ(o.complaint, "") << command << " " << o.operation;
  }
}

TEST(Adapters, ACheckNamesAnOperationWithOtherResults) {
  const auto adapter = start(shell_adapter("echo 'done 3'; head -c 99 /dev/zero"));
  const auto checked = check(*adapter).operations;
  ASSERT_EQ(checked.size(), 1u);
  EXPECT_NE(checked[0].complaint, "");
}

/// An adapter in Python whose quaternions are w x y z, whose log3_matrix is wrong, and which states `conventions`.
std::string python_adapter(const std::string& conventions = "{}") {
  const auto file = std::filesystem::path(liecheck::scratch()) /
                    ("w_first_" + std::to_string(std::hash<std::string>()(conventions)) + ".py");
  std::ofstream(file) << "conventions = " << conventions << R"(
import json, math, struct, sys
def exp3_quaternion(p):
    t = math.sqrt(sum(x * x for x in p)) or 1e-300
    return [math.cos(t / 2)] + [math.sin(t / 2) / t * x for x in p]
def log3_quaternion(q):
    s = math.sqrt(sum(x * x for x in q[1:])) or 1e-300
    return [2 * math.atan2(math.copysign(s, q[0]), abs(q[0])) / s * x for x in q[1:]]
functions = {"exp3_quaternion": (exp3_quaternion, 3), "log3_quaternion": (log3_quaternion, 4),
             "log3_matrix": (lambda R: [R[7], R[2], R[3]], 9)}
functions = {name: f for name, f in functions.items() if name in globals().get("only", functions)} 
calls, answers = sys.stdin.buffer, sys.stdout.buffer
calls.readline()
answers.write(json.dumps({"protocol": 1, "name": "w_first", "version": "1",
                          "operations": {name: ["double"] for name in functions},
                          "conventions": conventions}).encode() + b"\n")
answers.flush()
for call in iter(calls.readline, b""):
    _, name, _, n = call.decode().split()
    f, size = functions[name]
    results = [f(struct.unpack(f"<{size}d", calls.read(8 * size))) for _ in range(int(n))]
    answers.write(f"done {n}\n".encode() + bytes(int(n)) + b"".join(struct.pack(f"<{len(r)}d", *r) for r in results))
    answers.flush()
)";
  return "/usr/bin/python3 " + file.string();
}

/// Runs the program, and returns its exit code and what it printed.
Answer run(const std::string& arguments) {
  return shell(LIECHECK_PROGRAM " " + arguments);
}

TEST(Adapters, OperationsInOtherConventionsAreNamedAndNotJudged) {
  const std::string adapter = "'" + python_adapter() + "'",
                    named =
                        "quaternions are stored w x y z in exp3_quaternion "
                        "and log3_quaternion: store them x y z w",
                    unexplained = "no known convention explains log3_matrix: its phi[",
                    options =
                        " --property exp_oracle --property log_oracle --cases 100 --no-hard-cases --adapter ";
  const auto [checked, findings] = run("adapter check " + adapter);
  EXPECT_EQ(checked, 1);
  EXPECT_NE(findings.find("\n" + named), std::string::npos) << findings;
  EXPECT_NE(findings.find("\n" + unexplained), std::string::npos) << findings;
  const auto [refused, reason] = run("campaign" + options + adapter);
  EXPECT_EQ(refused, 1);
  EXPECT_NE(reason.find("\nNOT JUDGED  " + named), std::string::npos) << reason;
  EXPECT_NE(reason.find("\n1  log3_matrix (rotation vector): "), std::string::npos) << reason;
  EXPECT_EQ(reason.find("log3_quaternion (rotation vector): "), std::string::npos) << reason;
  const auto [nothing, why] =
      run("campaign --property exp_oracle --cases 100 --no-hard-cases --adapter " + adapter);
  EXPECT_EQ(nothing, 2) << "no operation of this law is left";
  EXPECT_NE(why.find("nothing is judged: " + named), std::string::npos) << why;
  const std::string alone = python_adapter("{}\nonly = ['exp3_quaternion']");
  const auto [left, told] = run("test '" + alone + "' --cases 100");
  EXPECT_EQ(left, 2) << "no operation of this adapter is left";
  EXPECT_NE(told.find("nothing is judged: quaternions are stored w x y z in exp3_quaternion"),
            std::string::npos)
      << told;
  const auto [judged, verdict] = run("campaign --no-probe" + options + adapter);
  EXPECT_EQ(judged, 1);
  EXPECT_NE(verdict.find("  log3_quaternion (rotation vector): "), std::string::npos) << verdict;
}

/// inverse of poses, whose matrices are stored column by column in float.
class ColumnsInFloat final : public Adapter {
 public:
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    if (!b.is_double)
      invert(reinterpret_cast<const float*>(b.inputs.data()), reinterpret_cast<float*>(b.results.data()), b.n,
             3, 1);
    else
      invert(reinterpret_cast<const double*>(b.inputs.data()), reinterpret_cast<double*>(b.results.data()),
             b.n, 1, 3);
    return "";
  }

 private:
  template <class S>
  static void invert(const S* x, S* to, std::size_t n, int row, int column) {
    for (; n > 0; --n, x += 12, to += 12)
      for (int i = 0; i < 3; ++i) {
        to[9 + i] = 0;
        for (int j = 0; j < 3; ++j) {
          to[3 * i + j] = x[3 * j + i];
          to[9 + i] -= x[row * i + column * j] * x[9 + j];
        }
      }
  }
  Description description_{"columns", "1", {{"inverse", "float"}, {"inverse", "double"}}, {}};
};

TEST(Adapters, AConventionOfOneScalarSaysInWhich) {
  ColumnsInFloat adapter;
  const Checked checked = check(adapter);
  ASSERT_EQ(checked.findings.size(), 1u);
  EXPECT_EQ(checked.findings[0].sentence,
            "in float: matrices are stored column by column in inverse: store them row by row, or state "
            "\"matrix\": "
            "\"columns\"");
}

/// euler_to_matrix of the orders up to `last`, with static axes where `right` is false; it refuses all other orders.
class SomeOrders final : public Adapter {
 public:
  SomeOrders(int last, bool right) : last_(last), right_(right) {}
  const Description& description() const override { return description_; }
  std::string call(const Batch& b) override {
    const auto* x = reinterpret_cast<const double*>(b.inputs.data());
    auto* R = reinterpret_cast<double*>(b.results.data());
    for (std::size_t k = 0; k < b.n; ++k, x += 4, R += 9) {
      const int order = static_cast<int>(x[0]);
      b.status[k] = order <= last_ ? Status::done : Status::refused;
      const Eigen::Matrix3d M =
          eulerToMatrix<double>(EulerOrder::numbered(right_ ? order : order / 2 * 2), {x[1], x[2], x[3]});
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{R} = M;
    }
    return "no such order";
  }

 private:
  int last_;
  bool right_;
  Description description_{"orders", "1", {{"euler_to_matrix", "double"}}, {}};
};

TEST(Adapters, ALibraryMayHaveSomeOrdersOfEulerAngles) {
  for (const int last : {0, 11, 23}) {
    SomeOrders adapter(last, true);
    const Checked checked = check(adapter);
    EXPECT_EQ(checked.findings.size(), 0u);
    EXPECT_EQ(checked.operations.at(0).complaint, "") << last;
  }
  SomeOrders wrong(11, false), none(-1, true);
  EXPECT_EQ(check(wrong).findings.size(), 1u);
  EXPECT_EQ(check(none).operations.at(0).complaint, "the input is refused: no such order");
}

TEST(Adapters, ACrashInTheProbeDoesNotEndTheCampaign) {
  const auto [code, text] = run("campaign --property exp_oracle --cases 20 --no-hard-cases --adapter '" +
                                shell_adapter("kill -SEGV $$") + "'");
  EXPECT_EQ(code, 1) << text;
  EXPECT_NE(text.find("\nverdict "), std::string::npos) << text;
}

TEST(Adapters, StatedConventionsAreConverted) {
  const auto sentences = [](const std::string& stated) {
    std::string text;
    for (const conventions::Finding& f : check(*start(python_adapter(stated))).findings)
      if (!f.choice) text += f.sentence.substr(0, 50) + "\n";
    return text;
  };
  const std::string unexplained = "no known convention explains log3_matrix: its phi[\n";
  EXPECT_EQ(sentences("{}"), "quaternions are stored w x y z in exp3_quaternion \n" + unexplained);
  EXPECT_EQ(sentences(R"({"quaternion": "wxyz", "twist": "linear first"})"), unexplained);
}

TEST(Adapters, StatedConventionsThatAreUnknownOrWrongAreSaidInWords) {
  const auto refusal = [](const std::string& stated) {
    return test::refusal<AdapterFailed>([&] { start(python_adapter(stated)); });
  };
  EXPECT_EQ(
      refusal(R"({"quaternion": "zyxw"})"),
      R"(of the conventions that the adapter states, "quaternion": "zyxw" is no convention: it is "xyzw" or "wxyz")");
  EXPECT_NE(
      refusal(R"({"quaternions": "wxyz"})").find(R"("quaternions" is no convention: known are "matrix", )"),
      std::string::npos);
  EXPECT_NE(refusal(R"({"angle": "degrees"})")
                .find("cannot be converted without rounding: in the adapter, convert"),
            std::string::npos);
  EXPECT_NE(refusal("[]").find("has no object 'conventions'"), std::string::npos);
  EXPECT_NE(refusal(R"({"quaternion": 4})").find("has no text for the convention 'quaternion'"),
            std::string::npos);

  const auto adapter = start("in-process:" LIECHECK_STATED_ADAPTER);
  const auto& stated = adapter->description().conventions;
  EXPECT_EQ(stated, (conventions::Statements{{"quaternion", "wxyz"}, {"twist", "angular first"}}));
  const Checked checked = check(*adapter);
  ASSERT_EQ(checked.findings.size(), 1u);
  EXPECT_EQ(checked.findings[0].sentence,
            R"(the adapter states "quaternion": "wxyz", but its results are right without that)");
  // The same from a process of its own, which only the program starts.
  EXPECT_EQ(std::system(LIECHECK_PROGRAM " adapter check " LIECHECK_STATED_ADAPTER
                                         " | grep -q 'but its results are right without that'"),
            0);
}

TEST(Adapters, TwoLibrariesInOneProcessWhoseStructsHaveOneNameStayApart) {
  const std::string folder = own_folder();
  std::ofstream(folder + "named.cpp") << R"(#include <liecheck_adapter.hpp>
struct Mine {
  const char *name = NAME, *version = "1";
  void normalize(std::span<const double, 4> Q, std::span<double, 4> Q_n) {
    for (int i = 0; i < 4; ++i) Q_n[i] = Q[i];
  }
};
LIECHECK_ADAPTER(Mine, normalize)
)";
  for (const std::string name : {"first", "second"}) {
    const std::string file = folder + name + ".so";
    const std::string compile = "c++ -std=c++20 -shared -fPIC -I " LIECHECK_FIXTURES
                                "/../properties/adapters -DNAME='\"" +
                                name + "\"' " + folder + "named.cpp -o " + file;
    ASSERT_EQ(std::system(compile.c_str()), 0);
    EXPECT_EQ(start("in-process:" + file)->description().name, name);
  }
}

TEST(Adapters, TheListForAdaptersInCppHasEveryOperation) {
  std::string expected =
      "// Every operation that an adapter can offer: how many numbers it takes and gives.\n";
  for (const OperationSizes& o : operation_sizes())
    expected += "LIECHECK_OPERATION(" + std::string(o.operation) + ", " + std::to_string(o.inputs) + ", " +
                std::to_string(o.results) + ")\n";
  std::ostringstream text;
  text << std::ifstream(LIECHECK_FIXTURES "/../properties/adapters/liecheck_operations.inc").rdbuf();
  EXPECT_EQ(text.str(), expected) << expected;
}

TEST(SharedMemory, IsNotLookedAtAgainAndAgainAfterARequestToStop) {
  std::atomic<bool> sleeps{false};
  int looks = 0;
  bool slept = false;
  stop_requested = true;
  wait_for(
      sleeps, [&] { return ++looks, slept; }, [&] { slept = true; });
  stop_requested = false;
  EXPECT_EQ(looks, 2);  // before and after it slept
}

}  // namespace
}  // namespace liecheck::properties::adapters
