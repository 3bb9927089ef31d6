// The section of error against time: the price of a digit, and the recommended subjects.

#include <gtest/gtest.h>

#include <cmath>
#include <reports/cost_points.hpp>
#include <reports/html.hpp>
#include <reports/picture.hpp>

#include "sample_record.hpp"

namespace {

using namespace liecheck::reports;

TEST(CostReport, EachStepAtLeastHalvesTheError) {
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
  EXPECT_EQ(all.size(), 7U);  // subject `one` lacks three of the operations
  EXPECT_EQ(fastest_within(all, 1e-14)->name(), "fast in double");
  EXPECT_EQ(fastest_within(all, 1e-22)->name(), "default in quad");
  EXPECT_EQ(fastest_within(all, 1e-40), nullptr);
  EXPECT_EQ(most_accurate(all, "double")->name(), "nearly in double");
  EXPECT_EQ(fastest_within(all, 1e-14)->latency, 320);
}

TEST(CostReport, TheSectionNamesMachineAndVariants) {
  const Merged merged{{Json{{"cost", cost()}}}, {}, {}};
  const std::string text = cost_section(Looks(merged));
  for (const char* part :
       {"take <b>fast in double</b>", "take <b>default in quad</b>", "<b>nearly in double</b>", "c&lt;1&gt;",
        "governor g", "not counted (perf_event_open: none)", "+5.5 for +30 ns", "the rest for +",
        "Compilers and flags", "gcc-O2<br><code>1</code>", "1 ns, 0.901 eps", "the median of 20 processes"})
    EXPECT_TRUE(has(text, part)) << part;
  const char* warning = "The machine changed speed during this run";
  EXPECT_FALSE(has(text, warning));
  const Merged unsteady{{Json{{"cost", with(cost(), "/steady", false)}}}, {}, {}}, none;
  EXPECT_TRUE(has(cost_section(Looks(unsteady)), warning));
  EXPECT_TRUE(has(cost_section(Looks(none)), "These records hold no times"));
}

TEST(CostReport, NamesTheFieldThatItRefuses) {
  const auto refusal = [](const Json& changed) { return refusal_of(with(record(), "/cost", changed)); };
  EXPECT_EQ(refusal(cost()), "");
  EXPECT_EQ(refusal(with(cost(), "/rows/0/sets/0/latency/ratio", 0)),
            "r.json: field cost.rows[0].sets[0].latency.ratio: expected a number > 0, found 0");
  EXPECT_EQ(refusal(with(cost(), "/rows/1/sets", Json::array())),
            "r.json: field cost.rows[1].sets: expected at least one entry, found []");
  EXPECT_TRUE(has(refusal(with(cost(), "/rows/2/error", -1)), "cost.rows[2].error: expected a number >= 0"));
  EXPECT_TRUE(has(refusal(without(cost(), "/environment/governor")), "cost.environment.governor is missing"));
}

}  // namespace
