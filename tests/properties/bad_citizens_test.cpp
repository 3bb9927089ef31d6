// Libraries that behave badly, as a shared library in a process of its own and as a program in Python: the campaign ends
// as it should, and names the outcome with its input.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace liecheck::properties {
namespace {

struct BadWay {
  const char* name;
  const char* outcome;  ///< the field of the record that counts it; "" if the campaign passes
  const char* words;    ///< in the output of the campaign or of the replay of its failure
  int cases = 1200;
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
  std::string text(const char* file) const {
    std::ostringstream all;
    all << std::ifstream(folder_ / file).rdbuf();
    return all.str();
  }
  /// Returns the exit code. Standard output goes to `out`.
  int run(const std::string& arguments, const char* out) const {
    const std::string command = "cd " + folder_.string() + " && LIECHECK_BAD=" + GetParam().name +
                                " timeout 120 " LIECHECK_PROGRAM " " + arguments + " > " + out + " 2> err";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("bad_") + GetParam().name + std::to_string(GetParam().cases));
    std::filesystem::create_directories(folder_);
  }
  std::filesystem::path folder_;
};

TEST_P(BadCitizen, IsAnOutcomeOfItsInputAndTheCampaignIsComplete) {
  const BadWay& way = GetParam();
  const bool passes = !*way.outcome;
  std::ofstream(folder_ / "bad.limits") << "version = 1\nsubject = bad\n[limits]\n*, *, any, forward = 16\n";
  ASSERT_EQ(run(std::string("campaign --adapter ") + way.adapter +
                    " --subject bad --subject liecheck --property exp_oracle --scalar double -j 1 "
                    "--no-hard-cases --limits "
                    "bad.limits --json record.json --cases " +
                    std::to_string(way.cases),
                "out"),
            passes ? 0 : 1)
      << text("out") << text("err");
  const auto record = nlohmann::json::parse(text("record.json"));
  EXPECT_EQ(record["verdict"], passes ? "pass" : "fail");
  std::uint64_t outcomes = 0, cases = 0;
  for (const auto& row : record["results"]) {
    if (row["subject"] == "liecheck") {
      EXPECT_EQ(row["status"], "pass");
    } else if (!passes) {
      outcomes += row[way.outcome].get<std::uint64_t>();
    }
    cases += row["subject"] == "bad" ? row["count"].get<std::uint64_t>() : 0;
  }
  EXPECT_GT(cases, way.cases * 3u / 4);
  if (passes) return;
  EXPECT_GE(outcomes, 1u);
  EXPECT_LT(outcomes, cases / 3);
  const std::string out = text("out");
  const auto at = out.find("liecheck replay ");
  ASSERT_NE(at, std::string::npos) << out;
  const std::string line = out.substr(at + 9, out.find('\n', at) - at - 9);
  const std::string said = text("err");
  const int code = run(line, "replay");
  EXPECT_NE((out + said + text("replay") + text("err")).find(way.words), std::string::npos)
      << text("replay") << text("err");
  // These depend on the calls of other cases.
  if (std::string(way.outcome) != "not_repeatable") {
    EXPECT_EQ(code, 1) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(
    InPython, BadCitizen,
    testing::Values(
        in_python("none", "", ""), in_python("segfault", "crashed", "signal 11"),
        in_python("abort", "crashed", "signal 6"), in_python("loop", "crashed", "in 5 s where", 30),
        in_python("slow", "", "", 40), in_python("exit", "crashed", "ended with exit code 0"),
        in_python("memory", "crashed", "MemoryError"), in_python("throw", "crashed", "not a rotation"),
        in_python("print", "crashed", "does it print to standard output?"),
        in_python("half", "crashed", "and then nothing for", 30), in_python("count", "crashed", "bytes more than"),
        in_python("less", "crashed", "and then nothing for", 30),
        in_python("status", "crashed", "the status 77"), in_python("nan", "not_finite", "NaN"),
        in_python("stateful", "not_repeatable", "not repeatable", 1500),
        // What a process does to its own memory and processor shows only in results: these are right.
        in_python("input", "", ""), in_python("rounding", "", ""), in_python("flush", "", "")),
    [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(
    Of, BadCitizen,
    testing::Values(
        BadWay{"none", "", ""}, BadWay{"segfault", "crashed", "signal 11"},
        BadWay{"abort", "crashed", "signal 6"}, BadWay{"loop", "crashed", "gave no answer in", 40},
        BadWay{"slow", "", "", 60}, BadWay{"exit", "crashed", "ended with exit code 0"},
        BadWay{"memory", "crashed", "signal 11"}, BadWay{"rounding", "environment_changed", "rounding mode"},
        BadWay{"flush", "environment_changed", "treatment of subnormals"},
        BadWay{"input", "argument_written", "writes to its inputs"},
        BadWay{"unwritten", "output_unwritten", "unwritten"}, BadWay{"stdio", "printed", "standard output"},
        BadWay{"cout", "printed", "standard output"}, BadWay{"write", "printed", "standard output"},
        BadWay{"throw", "crashed", "not a rotation"}, BadWay{"status", "crashed", "the status 77"},
        BadWay{"refuse", "refused", "gave no reason"}, BadWay{"nan", "not_finite", "NaN"},
        BadWay{"stateful", "not_repeatable", "not repeatable"},
        BadWay{"order", "not_repeatable", "is another one after other calls", 5000},
        BadWay{"threads", "not_repeatable", "when two threads call at the same time", 3000}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace liecheck::properties
