// Libraries that behave badly, as a shared library in a process of its own and as a program in Python: the campaign ends
// as it should, and names the outcome with its input.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <support/files.hpp>

#include "../sample.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::properties {
namespace {

struct BadWay {
  const char* name;
  const char* outcome;  ///< the field of the record that counts it; "" if the campaign passes
  const char* words;    ///< in the output of the campaign or of the replay of its failure
  int cases = 300;
  const char* adapter = LIECHECK_BAD_CITIZENS;
};

BadWay in_python(const char* name, const char* outcome, const char* words, int cases = 150) {
  return {name, outcome, words, cases, "'/usr/bin/python3 " LIECHECK_BAD_PYTHON "'"};
}

void PrintTo(const BadWay& way, std::ostream* to) {
  *to << way.name;
}

class BadCitizen : public testing::TestWithParam<BadWay> {
 protected:
  std::string text(const char* file) const { return read_whole(folder_ / file); }
  /// Returns the exit code. Standard output goes to `out`.
  int run(const std::string& arguments, const char* out, const char* way = GetParam().name) const {
    return shell("cd " + folder_.string() + " && LIECHECK_BAD=" + way + " timeout 350 " LIECHECK_PROGRAM " " +
                 arguments + " > " + out + " 2> err")
        .code;
  }
  /// A campaign of the adapter, with a record. Returns the exit code.
  int campaign(const std::string& adapter, const char* way) const {
    std::ofstream(folder_ / "bad.limits")
        << "version = 1\nsubject = bad\n[limits]\n*, *, any, forward = 16\n";
    return run("campaign --adapter " + adapter +
                   " --subject bad --subject liecheck --property exp_oracle --scalar double -j 1 "
                   "--no-hard-cases --limits bad.limits --json record.json --cases " +
                   std::to_string(GetParam().cases),
               "out", way);
  }
  /// The sum of a field over the rows of the bad subject.
  std::uint64_t sum(const char* field) const {
    std::uint64_t n = 0;
    const auto record = nlohmann::json::parse(text("record.json"));
    for (const auto& row : record["results"])
      if (row["subject"] == "bad") n += row[field].get<std::uint64_t>();
    return n;
  }
  const std::filesystem::path folder_ = own_folder();
};

TEST_P(BadCitizen, IsAnOutcomeOfItsInputAndTheCampaignIsComplete) {
  const BadWay& way = GetParam();
  if (way.cases == 0)
    GTEST_SKIP() << "waits for a minute; the preset nightly runs it, and a shared library's loop runs here";
  const bool passes = !*way.outcome;
  ASSERT_EQ(campaign(LIECHECK_BAD_CITIZENS, "refuse"), 1);
  const std::uint64_t bad_inputs = sum("refused");
  ASSERT_EQ(campaign(way.adapter, way.name), passes ? 0 : 1) << text("out") << text("err");
  const auto record = nlohmann::json::parse(text("record.json"));
  EXPECT_EQ(record["verdict"], passes ? "pass" : "fail");
  for (const auto& row : record["results"])
    if (row["subject"] == "liecheck") {
      EXPECT_EQ(row["status"], "pass");
    }
  EXPECT_GT(sum("count"), way.cases * 3u / 4);
  if (passes) return;
  const std::string outcome = way.outcome;
  const std::uint64_t outcomes = sum(way.outcome);
  if (outcome == "not_repeatable") {
    EXPECT_GE(outcomes, 1u);
  } else {  // each bad input, and no other of the same call; a result that is not finite counts in two blocks
    EXPECT_EQ(outcomes, outcome == "not_finite" ? 2 * bad_inputs : bad_inputs);
    EXPECT_GE(bad_inputs, 1u);
  }
  const std::string out = text("out");
  const auto at = out.find("liecheck replay ");
  ASSERT_NE(at, std::string::npos) << out;
  const std::string line = out.substr(at + 9, out.find('\n', at) - at - 9);
  const std::string said = text("err");
  const int code = run(line, "replay");
  EXPECT_NE((out + said + text("replay") + text("err")).find(way.words), std::string::npos)
      << text("replay") << text("err");
  // These depend on the calls of other cases.
  if (outcome != "not_repeatable") {
    EXPECT_EQ(code, 1) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(
    InPython, BadCitizen,
    testing::Values(
        in_python("none", "", ""), in_python("segfault", "crashed", "signal 11"),
        in_python("abort", "crashed", "signal 6"),
        in_python("loop", "crashed", "in 5 s where", sample(0, 12)), in_python("slow", "", "", 40),
        in_python("exit", "crashed", "ended with exit code 0"), in_python("memory", "crashed", "MemoryError"),
        in_python("throw", "crashed", "not a rotation"),
        in_python("print", "crashed", "does it print to standard output?"),
        in_python("half", "crashed", "and then nothing for", sample(5, 12)),
        in_python("count", "crashed", "bytes more than"), in_python("status", "crashed", "the status 77"),
        in_python("nan", "not_finite", "NaN"),
        in_python("stateful", "not_repeatable", "not repeatable", 1500),
        in_python("order", "not_repeatable", "not repeatable", 1500),
        // What a process does to its own memory and processor shows only in results. An input gives another result
        // once its call has changed the rounding mode; the other two change no result.
        in_python("rounding", "not_repeatable", "not repeatable"), in_python("input", "", ""),
        in_python("flush", "", "")),
    [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(
    Of, BadCitizen,
    testing::Values(
        BadWay{"none", "", ""}, BadWay{"segfault", "crashed", "signal 11"},
        BadWay{"abort", "crashed", "signal 6"}, BadWay{"loop", "crashed", "gave no answer in", sample(5, 20)},
        BadWay{"slow", "", "", 60}, BadWay{"cut", "", ""},
        BadWay{"exit", "crashed", "ended with exit code 0"}, BadWay{"memory", "crashed", "signal 11"},
        BadWay{"rounding", "environment_changed", "rounding mode"},
        BadWay{"flush", "environment_changed", "treatment of subnormals"},
        BadWay{"input", "argument_written", "writes to its inputs"},
        BadWay{"unwritten", "output_unwritten", "unwritten"}, BadWay{"stdio", "printed", "standard output"},
        BadWay{"cout", "printed", "standard output"}, BadWay{"write", "printed", "standard output"},
        BadWay{"throw", "crashed", "not a rotation"}, BadWay{"status", "crashed", "the status 77"},
        BadWay{"refuse", "refused", "gave no reason"}, BadWay{"nan", "not_finite", "NaN"},
        BadWay{"stateful", "not_repeatable", "not repeatable", 1200},
        BadWay{"order", "not_repeatable", "is another one after other calls", 5000},
        BadWay{"threads", "not_repeatable", "when two threads call at the same time", 3000}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(BadCitizens, ThatEndTheProgramAreNamedAndDoNotPass) {
  for (const auto& [way, how] :
       {std::pair("exit", "exit()"), {"abort", "the signal SIGABRT"}, {"segfault", "the signal SIGSEGV"}}) {
    const auto [code, text] = shell(std::string("LIECHECK_BAD=") + way +
                                    " " LIECHECK_PROGRAM
                                    " campaign --no-hard-cases --no-probe --property exp_oracle "
                                    "--adapter in-process:" LIECHECK_BAD_CITIZENS);
    EXPECT_EQ(code, 3) << text;
    const std::string words = std::string("ended the program, in whose process it runs, by ") + how;
    // While one thread is in exit(), others may use what it has destroyed.
    const bool beside = way == std::string("exit") && text.find("by the signal SIGSEGV") != text.npos;
    EXPECT_TRUE(beside || text.find(words) != text.npos) << text;
    EXPECT_NE(text.find("liecheck: bad: exp"), text.npos) << text;
  }
}

// Each input loops: a time limit or a signal does not wait for all of them.
TEST(BadCitizens, ThatNeverAnswerEndWithTheCampaignAndAreNamed) {
  for (const char* stop : {"--for 1s", "--cases 1000000 & p=$!; sleep 4; kill -TERM $p; wait $p"}) {
    const auto begin = std::chrono::steady_clock::now();
    const auto [code, text] = shell(
        std::string(
            "(LIECHECK_BAD=always timeout 60 " LIECHECK_PROGRAM
            " campaign --no-hard-cases --no-probe --property exp_oracle -j 1 --adapter " LIECHECK_BAD_CITIZENS
            " ") +
        stop + ")");
    EXPECT_EQ(code, 3) << text;
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 20);
    EXPECT_NE(text.find("bad: exp"), text.npos) << text;
  }
}

// After a signal, no command waits for the end of a call or takes what it gave up for a result, and what is printed at
// the end begins at most one call that never returns.
TEST(BadCitizens, ThatNeverAnswerAreGivenUpAfterASignal) {
  const std::string hangs = liecheck::scratch() + "hangs";
  for (const auto& [command, first] : {std::pair("hard-cases -j 1", true),
                                       {"hunt --subject bad --op exp3_quaternion", true},
                                       {"campaign --no-hard-cases --no-probe -j 1 --cases 1000000", false}}) {
    std::filesystem::remove(hangs);
    if (first) std::ofstream(hangs).close();
    const auto [code, text] = shell(fmt::format(
        "(LIECHECK_BAD=nan LIECHECK_HANGS={0} timeout 60 " LIECHECK_PROGRAM
        " {1} --adapter " LIECHECK_BAD_CITIZENS " & p=$!; sleep 3; touch {0}; kill -TERM $p; wait $p)",
        hangs, command));
    EXPECT_EQ(code, 3) << command << text;
    EXPECT_EQ(text.find("in time"), text.npos) << command << text;
    EXPECT_LE(std::filesystem::file_size(hangs), 2U) << command << text;
    if (first) {
      EXPECT_GT(std::filesystem::file_size(hangs), 0U) << command << text;
    } else {
      EXPECT_NE(text.find("interrupted: this case is not measured again"), text.npos) << text;
    }
  }
}

TEST(BadCitizens, ThatNeverAnswerInTheProcessOfTheProgramAreNamedAfterASignal) {
  const std::string said = liecheck::scratch() + "said";
  const auto [code, text] =
      shell("(LIECHECK_BAD=always timeout 60 " LIECHECK_PROGRAM
            " campaign --no-hard-cases --no-probe -j 1 --adapter in-process:" LIECHECK_BAD_CITIZENS " 2>" +
            said +
            " & p=$!; sleep 2; kill -TERM $p; for i in $(seq 300); do grep 'bad: exp3_quaternion runs in "
            "this process' " +
            said + " && break; sleep 0.1; done; kill -HUP $p; wait $p)");
  EXPECT_NE(text.find("a second signal ends the program"), text.npos) << text;
  EXPECT_EQ(code, 128 + SIGHUP) << text;
}

TEST(BadCitizens, ThatNeverAnswerInTheProcessOfTheProgramEndItTenSecondsAfterASignal) {
  const auto [code, text] =
      shell("(LIECHECK_BAD=always timeout 60 " LIECHECK_PROGRAM
            " campaign --no-hard-cases --no-probe -j 1 --adapter in-process:" LIECHECK_BAD_CITIZENS
            " 2>&1 & p=$!; sleep 1; pkill -TERM -P $p; wait $p)");
  EXPECT_NE(text.find("bad: exp3_quaternion did not return: its results are lost"), text.npos) << text;
  EXPECT_EQ(code, 3) << text;
}

// Of an adapter that takes trees from URDFs only, a campaign without one does not call the functions on trees.
TEST(TreesOfUrdfs, AreNotMeasuredWithoutOneWhichIsSaidAndIsNoPass) {
  std::ostringstream text;
  text << std::ifstream(LIECHECK_BAD_PYTHON).rdbuf();
  std::string program = text.str();
  const std::string offers = R"("operations": {"exp3_quaternion": ["double"])";
  const std::size_t end = program.find(offers) + offers.size();
  program.insert(end, R"(, "tree_crba": ["double"]}, "trees": {"models": ["urdf"])");
  const std::string file = liecheck::scratch() + "urdfs_only.py";
  std::ofstream(file) << program;
  for (const auto& [adapter, expected] : {std::pair<std::string, int>(LIECHECK_BAD_PYTHON, 0), {file, 3}}) {
    const auto [code, said] = shell("LIECHECK_BAD=none " LIECHECK_PROGRAM
                                    " campaign --no-hard-cases --cases 20 --adapter '/usr/bin/python3 " +
                                    adapter + "'");
    EXPECT_EQ(code, expected) << said;
    EXPECT_EQ(said.find("NOT MEASURED  the functions of bad on trees") != said.npos, expected == 3) << said;
  }
}

TEST(BadCitizens, OfAnotherVersionOfTheInterfaceAreRefusedWithBothVersions) {
  for (const char* way : {"", "in-process:"}) {
    const auto [code, text] =
        shell(std::string("LIECHECK_BAD=version " LIECHECK_PROGRAM " campaign --cases 1 --adapter ") + way +
              LIECHECK_BAD_CITIZENS);
    EXPECT_EQ(code, 2);
    EXPECT_NE(text.find("has version 7 of the interface, and liecheck 0."), text.npos) << text;
    EXPECT_NE(text.find(" versions 1 to 2\n"), text.npos) << text;
  }
}

}  // namespace
}  // namespace liecheck::properties
