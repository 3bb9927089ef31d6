#include <gtest/gtest.h>
#include <campaign/robots.hpp>
#include <fstream>
#include <history/bench.hpp>
#include <set>
#include <sstream>

namespace liecheck::properties {
namespace {

using history::H, history::V3, history::V4;

V3 right_log(const V4& Q) {
  return history::log_by_atan2(Q);
}
V3 wrong_log(const V4& Q) {
  return 2 * history::log_by_atan2(Q);
}

// Rows of these tests: a bug that is none, a repair that repairs nothing, and a control that a law sees.
std::vector<HistoricBug> planted() {
  const auto row = [](const char* name, Forms forms, HistoryKind kind) {
    return HistoricBug{name, "none", "this test", "all", "none", "Planted.", std::move(forms), kind};
  };
  return {row("test_never_found", forms(op::log3_quaternion, right_log, right_log), HistoryKind::bug),
          row("test_not_repaired", forms(op::log3_quaternion, wrong_log, wrong_log), HistoryKind::bug),
          row("test_control", forms(op::log3_quaternion, wrong_log, right_log), HistoryKind::control),
          row("test_found", forms(op::log3_quaternion, wrong_log, right_log), HistoryKind::bug),
          row("test_silent", forms(op::log3_quaternion, right_log, right_log), HistoryKind::control)};
}
const HistoryRows registered_rows(planted);

bool of_a_test(const HistoricBug& b) {
  return b.name.rfind("test_", 0) == 0;
}

HistoryBench bench_of(const std::string& name) {
  HistoryBench bench;
  bench.cases = 20;
  for (const HistoricBug* b : history_rows({name}))
    bench.rows.push_back(measure(*b, bench, built_in_robot()));
  bench.complete = true;
  return bench;
}

TEST(History, ABugThatNoLawFindsFailsTheBench) {
  const HistoryBench bench = bench_of("test_never_found");
  EXPECT_EQ(bench.rows[0].verdict(), "NOT FOUND");
  EXPECT_FALSE(bench.passed());
  EXPECT_GE(bench.rows[0].faulty.cases, 20u);
}

TEST(History, ARowWhoseTimeIsUpIsIncomplete) {
  HistoryBench bench;
  bench.cases = 1000000, bench.seconds = 0.01;
  bench.rows.push_back(measure(*history_rows({"test_found"})[0], bench, built_in_robot()));
  EXPECT_EQ(bench.rows[0].verdict(), "INCOMPLETE");
  EXPECT_FALSE(bench.measured());
}

TEST(History, AnAccusedRepairOrControlFailsTheBench) {
  for (const char* name : {"test_not_repaired", "test_control"}) {
    const HistoryBench bench = bench_of(name);
    EXPECT_EQ(bench.rows[0].verdict(), "ACCUSED") << name;
    EXPECT_FALSE(bench.passed()) << name;
  }
}

TEST(History, AFoundBugWithASilentRepairPasses) {
  const HistoryBench bench = bench_of("test_found");
  const FirstFailure& f = bench.rows[0].faulty;
  EXPECT_EQ(bench.rows[0].verdict(), "found");
  EXPECT_TRUE(bench.passed());
  EXPECT_EQ(f.by, "log_oracle: log3_quaternion, rotation vector");
  EXPECT_GT(f.digits_lost(), 5);
  EXPECT_LT(f.digits_lost(), 16);
  // The replay repeats the failure.
  const CaseId id = CaseId::parse(f.replay.substr(0, f.replay.find(' ')));
  const auto all = select({{"history:test_found"}, {"log_oracle"}, {"double"}}, built_in_robot());
  ASSERT_EQ(all.size(), 1u);
  const auto judged = all[0]->replay(id);
  EXPECT_TRUE(std::any_of(judged.begin(), judged.end(), [](const Judged& j) { return j.failed; }));
}

TEST(History, ASilentControlPasses) {
  EXPECT_EQ(bench_of("test_silent").rows[0].verdict(), "silent");
  EXPECT_THROW(history_rows({"no_such_row"}), std::invalid_argument);
}

TEST(History, EveryRowStatesItsSourceAndWhatWasWrong) {
  std::set<std::string> names;
  int bugs = 0, controls = 0;
  for (const HistoricBug& b : historic_bugs()) {
    EXPECT_TRUE(names.insert(b.name).second) << b.name;
    for (const std::string& text : {b.library, b.thread, b.region, b.symptom, b.wrong})
      EXPECT_FALSE(text.empty()) << b.name;
    EXPECT_EQ(b.wrong.back(), '.') << b.name;
    EXPECT_EQ(b.kind == HistoryKind::not_expressed, !b.forms.faulty) << b.name;
    if (of_a_test(b)) continue;
    bugs += b.kind == HistoryKind::bug, controls += b.kind == HistoryKind::control;
  }
  EXPECT_GE(bugs, 60);
  EXPECT_EQ(controls, 3);
}

TEST(History, TheTableOfTheFixtureIsThatOfTheProgram) {
  std::ifstream file(LIECHECK_FIXTURES "/history/README.md");
  std::stringstream text;
  text << file.rdbuf();
  std::string table, line;
  std::istringstream lines(history_table());
  while (std::getline(lines, line))
    if (line.rfind("| `test_", 0) != 0) table += line + "\n";
  EXPECT_NE(text.str().find(table), std::string::npos)
      << "write the output of `liecheck lab history --list` into fixtures/history/README.md";
}

TEST(History, AnUnnamedSelectionHasNoneOfTheRows) {
  for (const auto& s : select({}, built_in_robot()))
    EXPECT_NE(s->subject.rfind("history:", 0), 0u) << s->subject;
}

}  // namespace
}  // namespace liecheck::properties
