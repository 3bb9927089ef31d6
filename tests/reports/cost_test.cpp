// The section of error against time: the price of a digit, and the recommended subjects.

#include <gtest/gtest.h>

#include <cmath>
#include <reports/cost_advice.hpp>
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

RegionPoint point(const char* subject, double ns, double error, const char* where = "theta 1e-12..1e-5") {
  return {{subject, "double", "log6", error, ns, 0x1p-52}, ns * 0.95, ns * 1.05, where};
}

TEST(CostReport, OfLibrariesNamesTheFastestWithTheMostDigitsAndWhatAFasterOneLoses) {
  EXPECT_EQ(cost_sentence({point("quick", 10, 4e-9), point("near", 17, 4e-9), point("exact", 18, 4e-16),
                           point("slow", 40, 3e-16)},
                          {}),
            "For 15 digits take <b>exact in double</b> (18 ns); quick (10 ns) loses 7 digits, at theta "
            "1e-12..1e-5.");
  EXPECT_EQ(cost_sentence({point("a", 10, 4e-16), point("b", 12, 4e-16)}, ""),
            "For 15 digits take <b>a in double</b> (10 ns).");
  EXPECT_TRUE(has(cost_sentence({point("a", 10, INFINITY), point("b", 12, 4e-16)}, ""), "without a result"));
  EXPECT_EQ(cost_sentence({}, ""), "");
}

TEST(CostReport, OfOneLibraryComparesItWithWhatItsFormulaCouldReachAndAdvertisesNothing) {
  const RegionPoint series = point("liecheck:fast", 20, 8e-16), tight = point("liecheck:tight", 900, 1e-16);
  EXPECT_EQ(cost_sentence({point("textbook", 9, 1e-8), point("mine", 10, 1e-8), series, tight}, "mine"),
            "double: 8.0 digits, 10 ns; a series (liecheck:fast) wins <b>7.1 digits for "
            "10 ns more</b>, at "
            "theta 1e-12..1e-5.");
  EXPECT_EQ(cost_sentence({point("mine", 10, 9e-16), series, tight}, "mine"), "double: 15.0 digits, 10 ns.");
  EXPECT_EQ(cost_sentence({series, point("mine", 40, 1e-8), tight}, "mine"),
            "double: 8.0 digits, 40 ns; a series (liecheck:fast) wins <b>7.1 digits for 20 ns less</b>, at "
            "theta 1e-12..1e-5.");
  EXPECT_EQ(cost_sentence({series, point("mine", 40, 9e-16), tight}, "mine"),
            "double: 15.0 digits, 40 ns; a series (liecheck:fast) has no fewer in 20 ns instead of 40 ns.");
}

TEST(CostReport, AdvisesNothingThatIsWrongAndRepairsNothingThatIsRight) {
  const auto points = [](double error) {
    return std::vector{point("textbook", 9, 2e-16), point("mine", 10, error), point("liecheck", 20, 3e-16)};
  };
  JudgedIn judged;
  EXPECT_TRUE(has(cost_sentence(points(1e-8), "mine", judged), "a compensated series (liecheck) wins"));
  judged.right = {"mine"};
  EXPECT_EQ(cost_sentence(points(1e-8), "mine", judged),
            "double: 8.0 digits, 10 ns, within budget; a compensated series (liecheck) keeps 15.5 for 10 ns "
            "more.");
  judged = {}, judged.right = {"textbook"};
  EXPECT_TRUE(has(cost_sentence(points(1e-8), "", judged), "take <b>textbook in double</b>"));
  judged = {}, judged.wrong = {"textbook", "mine"};
  EXPECT_TRUE(has(cost_sentence(points(1e-8), "", judged), "take <b>liecheck in double</b>"));
  judged.wrong.insert("liecheck");
  EXPECT_EQ(cost_sentence(points(1e-8), "", judged), "None that was timed is right.");
}

TEST(CostReport, OfADifferenceNamesTheProduct) {
  RegionPoint own = point("mine", 10, 1e-4), product = point("liecheck", 20, 3e-16);
  own.operation = product.operation = "difference";
  EXPECT_TRUE(has(cost_sentence({own, product}, "mine"), "a compensated product (liecheck) wins"));
}

RegionPoint many(const char* subject, double ns, double error) {
  RegionPoint p = point(subject, ns, error);
  p.batch = 256;
  return p;
}

TEST(CostReport, CallsWithManyInputsAreNamedWhereTheyTakeLessAndLoseNothing) {
  EXPECT_EQ(cost_sentence({many("batch", 3, 4e-16), many("rough", 1, 1e-8), point("exact", 18, 4e-16)}, ""),
            "For 15 digits take <b>exact in double</b> (18 ns; 256 at once: batch, 3 ns each).");
  EXPECT_EQ(cost_sentence({many("mine", 200, 9e-16), point("mine", 9000, 9e-16)}, "mine"),
            "double: 15.0 digits, 9 µs; 256 at once: 200 ns each.");
  EXPECT_EQ(cost_sentence({point("mine", 9, 9e-16), many("mine", 9, 9e-16)}, "mine"),
            "double: 15.0 digits, 9 ns.");

  Json all = cost();
  Json& row = all["rows"][0];
  const auto points_of = [&] {
    std::string text;
    for (const CostPoint& p : cost_points(all))
      if (row["subject"] == p.subject && row["scalar"] == p.scalar && row["operation"] == p.operation)
        text += p.name() + "; ";
    return text;
  };
  const std::string one = points_of();
  row["timed"] = "one, many", row["sets"].back()["inputs"] = 1280;
  EXPECT_EQ(points_of(), one + one.substr(0, one.size() - 2) + ", 1280 at once; ");
  row["sets"].back()["latency"] = nullptr;  // a batch has no latency
  EXPECT_EQ(points_of(), one.substr(0, one.size() - 2) + ", 1280 at once; ");
}

TEST(CostReport, ARegionTakesTheWorstErrorOfItsBandsAndTheMeanOfTheirTimes) {
  Json all = cost();
  all["bands"] = Json::parse(R"json([{"axis": "theta", "band": "tiny", "high": 1e-05, "low": 1e-12},
 {"axis": "theta", "band": "small", "high": 0.1, "low": 1e-05},
 {"axis": "pi_minus_theta", "band": "pi", "high": 0.1, "low": 1e-05}])json");
  Json sets = Json::array();
  for (const char* band : {"tiny", "small", "pi", "mixed"}) {
    Json set = all["rows"][0]["sets"][0];
    set["set"] = band;
    if (band == std::string("small")) set["blocks"][0]["max_eps"] = 1024, set["latency"]["ns"] = 30;
    sets.push_back(set);
  }
  all["rows"] = Json::array({all["rows"][0]});
  all["rows"][0]["sets"] = sets;
  EXPECT_EQ(timed_inputs(all), "on random inputs with angles from 10⁻¹² rad to near π");
  const auto regions = cost_regions(all);
  ASSERT_EQ(regions.size(), 2U);
  const auto near_zero = region_points(all, "exp6", regions[0]),
             near_pi = region_points(all, "exp6", regions[1]);
  ASSERT_EQ(near_zero.size(), 1U);
  EXPECT_EQ(near_zero[0].latency, 40);
  EXPECT_EQ(near_zero[0].error, 0x1p-42);
  EXPECT_EQ(near_zero[0].where, "small");
  EXPECT_EQ(near_pi.at(0).error, 0x1p-51);
  for (Json& set : all["rows"][0]["sets"])
    set["blocks"][0]["measured"] = 0;  // then nothing is known, and not: no error
  EXPECT_TRUE(region_points(all, "exp6", regions[0]).empty());
}

TEST(CostReport, TheSectionNamesMachineAndVariants) {
  const Merged merged{{Json{{"cost", cost()}}}, {}, {}};
  const std::string text = cost_section(Looks(merged));
  for (const char* part :
       {"c&lt;1&gt;", "governor g", "not counted (perf_event_open: none)", "+5.5 for +30 ns",
        "the rest for +", "Compilers and flags", "gcc-O2<br><code>1</code>", "1 ns, 0.901 eps",
        "short repetitions in 20 processes"})
    EXPECT_TRUE(has(text, part)) << part;
  const char* warning = "The times are unsteady";
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
