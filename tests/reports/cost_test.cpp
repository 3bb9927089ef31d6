// What the report says of error against time: the price of a digit and whom it advises to whom.

#include <gtest/gtest.h>

#include <cmath>
#include <reports/cost_points.hpp>
#include <reports/field.hpp>
#include <reports/html.hpp>

namespace {

using namespace liecheck::reports;

Json row(const std::string& subject, const std::string& scalar, const std::string& operation, Json error,
         double ns, Json dominated = nullptr) {
  const Json time = {{"median", ns}, {"low", ns}, {"high", ns}, {"repetitions", 25u}};
  const Json block = {{"block", "translation"}, {"measured", 640u},  {"max_eps", 2},
                      {"p99_eps", 1},           {"median_eps", 0.5}, {"not_finite", 0u},
                      {"wrong_branch", 0u},     {"unresolved", 0u},  {"refused", 0u}};
  Json set = {{"set", "mixed"},     {"inputs", 640u},          {"throughput_ns", time},
              {"latency_ns", time}, {"instructions", nullptr}, {"blocks", Json::array({block})}};
  return {{"subject", subject},
          {"version", "1"},
          {"scalar", scalar},
          {"operation", operation},
          {"eps", 0x1p-52},
          {"error", error},
          {"worst_block", "translation"},
          {"dominated_throughput", nullptr},
          {"dominated_latency", dominated},
          {"sets", Json::array({set})}};
}

Json cost() {
  Json rows = Json::array();
  for (const char* operation : {"exp6", "log6", "integrate", "difference"}) {
    rows.push_back(row("book", "double", operation, 1e-9, 50));
    rows.push_back(row("fast", "double", operation, 3e-15, 80));
    rows.push_back(row("default", "double", operation, 4e-16, 100));
    rows.push_back(row("library", "double", operation, 5e-16, 300, "default double"));
    rows.push_back(row("nearly", "double", operation, 3e-16, 101));
    rows.push_back(row("default", "quad", operation, 1e-32, 9000));
    rows.push_back(row("breaks", "quad", operation, "inf", 10));
    rows.push_back(row("call", "double", operation, nullptr, 2));
  }
  rows.push_back(row("liecheck@gcc-O2", "double", "exp6", 2e-16, 1));  // would be on every front
  rows.push_back(row("one", "double", "exp6", 0, 20000));
  return {{"version", "0.1.0"},
          {"verdict", "pass"},
          {"seed", 42u},
          {"repetitions", 25u},
          {"seconds", 30},
          {"elapsed", 33},
          {"clock", "processor time"},
          {"no_counter", "perf_event_open: none"},
          {"environment",
           {{"cpu", "c<1>"}, {"governor", "g"}, {"os", "o"}, {"compiler", "gcc"}, {"flags", "-O2"}}},
          {"rows", rows}};
}

TEST(CostReport, AStepOfTheFrontAtLeastHalvesTheError) {
  const auto points = cost_points(cost());
  std::string steps;
  for (const CostStep& s : cost_steps(points, "exp6")) steps += s.from->name() + " > " + s.to->name() + "; ";
  EXPECT_EQ(
      steps,
      "breaks in quad > book in double; book in double > fast in double; fast in double > default in double; "
      "default in double > default in quad; default in quad > one in double; ");
  EXPECT_EQ(digits_of(points[6]), 0);
  EXPECT_TRUE(std::isinf(digits_of(points.back())));
}

TEST(CostReport, AdviceFollowsFromTheFigures) {
  const auto all = cost_candidates(cost_points(cost()), {"exp6", "log6", "integrate", "difference"});
  EXPECT_EQ(all.size(), 7U);  // `one` lacks three of them
  EXPECT_EQ(fastest_within(all, 1e-14)->name(), "fast in double");
  EXPECT_EQ(fastest_within(all, 1e-22)->name(), "default in quad");
  EXPECT_EQ(fastest_within(all, 1e-40), nullptr);
  EXPECT_EQ(most_accurate(all, "double")->name(), "nearly in double");
  EXPECT_EQ(fastest_within(all, 1e-14)->latency, 320);
}

TEST(CostReport, TheSectionNamesMachineAndVariants) {
  const std::string text = cost_section({{Json{{"cost", cost()}}}, {}});
  for (const char* part :
       {"take <b>fast in double</b>", "take <b>default in quad</b>", "<b>nearly in double</b>", "c&lt;1&gt;",
        "governor g", "not counted (perf_event_open: none)", "+5.5 for +30 ns", "the rest for +",
        "Compilers and flags", "gcc-O2<br><code>1</code>", "1 ns, 0.901 eps"})
    EXPECT_NE(text.find(part), text.npos) << part;
  EXPECT_NE(cost_section({}).find("These records hold no times"), std::string::npos);
}

std::string refusal(const Json& record) {
  try {
    check_cost(Field("r.json", "cost", record));
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(CostReport, RefusesWhatIsNoTimeNamingTheField) {
  EXPECT_EQ(refusal(cost()), "");
  Json r = cost();
  r["rows"][0]["sets"][0]["latency_ns"]["median"] = 0;
  EXPECT_EQ(refusal(r), "r.json: field cost.rows[0].sets[0].latency_ns.median: expected a time > 0, found 0");
  r = cost();
  r["rows"][1]["sets"] = Json::array();
  EXPECT_EQ(refusal(r), "r.json: field cost.rows[1].sets: expected at least one entry, found []");
  r = cost();
  r["rows"][2]["error"] = -1;
  EXPECT_NE(refusal(r).find("cost.rows[2].error: expected a number >= 0"), std::string::npos);
  r = cost();
  r["environment"].erase("governor");
  EXPECT_NE(refusal(r).find("cost.environment.governor is missing"), std::string::npos);
}

}  // namespace
