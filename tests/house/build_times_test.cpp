// The build stays in its budget (build_budget.csv), which building.md repeats, measured by the log of its own compilers.

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>

#include "build_times.hpp"

namespace liecheck::house {
namespace {

const std::string build = LIECHECK_BUILD_DIR "/";

std::map<std::string, double> budget() {
  std::ifstream file(LIECHECK_SOURCE_DIR "/tests/house/build_budget.csv");
  return limits_in(file);
}

/// The objects of C++ that are linked into a target of Ninja. It does not list those of the reference, which nothing links.
std::set<std::string> objects_of(const std::string& target) {
  std::set<std::string> all;
  FILE* const out =
      popen(("'" LIECHECK_NINJA "' -C '" + build + "' -t inputs " + target + " 2>&1").c_str(), "r");
  std::string line;
  for (int c = fgetc(out); c != EOF; c = fgetc(out))
    if (c != '\n') {
      line += static_cast<char>(c);
    } else {
      // What stands elsewhere is linked, such as properties/laws.o.
      const bool compiled = line.find("CMakeFiles/") != line.npos && !line.ends_with(".c.o");
      if (compiled && (line.ends_with(".o") || line.ends_with(".gch"))) all.insert(line);
      line.clear();
    }
  if (pclose(out) != 0) throw std::runtime_error("ninja does not know the target " + target);
  return all;
}

/// The log with paths as Ninja has them: relative to the build.
std::map<std::string, Compilation> log_of_the_build() {
  std::ifstream file(build + "compile_times.txt");
  std::map<std::string, Compilation> all;
  for (const auto& [object, c] : compilations_in(file))
    all[object.starts_with(build) ? object.substr(build.size()) : object] = c;
  return all;
}

TEST(BuildTimes, StayInTheirBudget) {
  if (std::string(LIECHECK_BUILD_TYPE) != "Release") GTEST_SKIP() << "the budget is that of a Release build";
  Scopes scopes{objects_of("bin/liecheck"), objects_of("report"), objects_of("all")};
  // The kernels of `cost --flags`, whose objects Ninja does not know.
  if (std::filesystem::exists(build + "kernels"))
    for (const auto& entry : std::filesystem::directory_iterator(build + "kernels"))
      if (entry.path().extension() == ".so")
        scopes.everything.insert("kernels/" + entry.path().stem().string() + ".o");
  const auto log = log_of_the_build();
  if (const std::string why = gap(log, scopes); !why.empty())
    GTEST_SKIP() << "this build is not measured: " << why << ". A build from nothing without ccache is.";
  const Judgement judgement = judged(log, scopes, budget());
  std::cout << judgement.table;
  for (const std::string& line : judgement.exceeded) ADD_FAILURE() << line;
}

/// A log in which the reference takes twice the seconds of the budget, so that the machine has half its speed.
struct Example {
  std::map<std::string, double> limits = {{"reference", 5},    {"program", 60}, {"report", 100},
                                          {"everything", 150}, {"file", 40},    {"memory", 1}};
  std::string text =
      "99.00 900000 compiled a/CMakeFiles/p.dir/x/one.cpp.o\n"  // compiled again below
      "10.00 300000 compiled r/CMakeFiles/reference.dir/reference.cpp.o\n"
      "80.00 900000 compiled a/CMakeFiles/p.dir/x/one.cpp.o\n"
      "40.00 900000 compiled a/CMakeFiles/p.dir/Unity/unity_x_3_cxx.cxx.o\n"
      "70.00 900000 compiled b/CMakeFiles/q.dir/two.cpp.o\n"
      "80.00 900000 compiled tests/CMakeFiles/t.dir/__/b/three.cpp.o\n";
  Scopes scopes{{"a/CMakeFiles/p.dir/x/one.cpp.o", "a/CMakeFiles/p.dir/Unity/unity_x_3_cxx.cxx.o"}, {}, {}};
  Example() {
    scopes.report = scopes.program;
    scopes.report.insert("b/CMakeFiles/q.dir/two.cpp.o");
    scopes.everything = scopes.report;
    scopes.everything.insert("tests/CMakeFiles/t.dir/__/b/three.cpp.o");
    scopes.everything.insert("r/CMakeFiles/reference.dir/reference.cpp.o");
  }
  std::map<std::string, Compilation> log(const std::string& more = "") const {
    std::istringstream all(text + more);
    return compilations_in(all);
  }
  std::vector<std::string> exceeded(const std::string& more = "") const {
    return judged(log(more), scopes, limits).exceeded;
  }
};

TEST(BuildTimes, AreDividedByTheReferenceAndSummedByFolder) {
  const Example example;
  EXPECT_EQ(gap(example.log(), example.scopes), "");
  const Judgement judgement = judged(example.log(), example.scopes, example.limits);
  EXPECT_EQ(judgement.exceeded, std::vector<std::string>());
  EXPECT_EQ(judgement.table,
            "| what | CPU-minutes |\n|---|---|\n| program | 1.0 |\n| report | 1.6 |\n| everything | 2.2 |\n\n"
            "| folder | CPU-minutes | % |\n|---|---|---|\n| b | 1.25 | 56 |\n| a/x | 1.00 | 44 |\n\n"
            "| file | CPU s | GB |\n|---|---|---|\n| b/three.cpp | 40 | 0.90 |\n| a/x/one.cpp | 40 | 0.90 |\n"
            "| b/two.cpp | 35 | 0.90 |\n| a/x/unity_x_3 | 20 | 0.90 |\n");
}

TEST(BuildTimes, AboveEachLimitAreFound) {
  const Example example;
  using Lines = std::vector<std::string>;
  EXPECT_EQ(example.exceeded("44.00 900000 compiled a/CMakeFiles/p.dir/Unity/unity_x_3_cxx.cxx.o\n"),
            Lines{"program [CPU seconds]: 62 is above the limit 60"});
  EXPECT_EQ(example.exceeded("82.00 900000 compiled tests/CMakeFiles/t.dir/__/b/three.cpp.o\n"),
            Lines{"b/three.cpp [CPU seconds]: 41 is above the limit 40"});
  EXPECT_EQ(example.exceeded("70.00 1100000 compiled b/CMakeFiles/q.dir/two.cpp.o\n"),
            Lines{"b/two.cpp [GB]: 1.1 is above the limit 1"});
  Example less = example;
  less.limits["report"] = 94;
  less.limits["everything"] = 134;
  EXPECT_EQ(less.exceeded(), (Lines{"report [CPU seconds]: 95 is above the limit 94",
                                    "everything [CPU seconds]: 135 is above the limit 134"}));
}

TEST(BuildTimes, OfAnIncompleteLogAreNotJudged) {
  Example example;
  const std::string two = "b/CMakeFiles/q.dir/two.cpp.o";
  EXPECT_EQ(gap(example.log("0.10 15000 ccache " + two + "\n"), example.scopes),
            "0 of 5 objects are not in the log and 1 came from ccache, for example " + two);
  auto log = example.log();
  log.erase(two);
  EXPECT_EQ(gap(log, example.scopes),
            "1 of 5 objects are not in the log and 0 came from ccache, for example " + two);
  log = example.log();
  log["r/CMakeFiles/reference.dir/reference.cpp.o"].from_ccache = true;
  EXPECT_EQ(gap(log, example.scopes), "the reference is not in the log, or came from ccache");
  std::istringstream wrong("12 of something\n");
  EXPECT_THROW(compilations_in(wrong), std::runtime_error);
}

TEST(BuildTimes, HaveTheLimitsOfTheirPage) {
  std::ifstream file(LIECHECK_SOURCE_DIR "/docs/building.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  std::ifstream table(LIECHECK_SOURCE_DIR "/tests/house/build_budget.csv");
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#') || line.starts_with("what,")) continue;
    std::string row = "| " + line + " |";
    for (auto comma = row.find(','); comma != row.npos; comma = row.find(',')) row.replace(comma, 1, " | ");
    EXPECT_NE(page.find(row), page.npos) << "docs/building.md lacks the row " << row;
  }
}

}  // namespace
}  // namespace liecheck::house
