// Cliffs: bands of the angle whose error is far above the error elsewhere. No limit excuses one.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/cliffs.hpp>
#include <campaign/expected.hpp>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <store/stored_run.hpp>

#include "../campaigns.hpp"

namespace liecheck::properties {
namespace {

CampaignOptions options(const std::string& subject, std::uint64_t cases, const std::string& lines = "") {
  CampaignOptions o = quiet({{subject}, {"exp_oracle"}, {"double"}}, cases, 2);
  if (!lines.empty())
    o.selection.limits = {std::make_shared<const SubjectLimits>(
        parse_limits("own.limits", "version = 2\nsubject = " + subject + "\n" + lines))};
  o.selection.profiles[""] = Profile::half;
  return o;
}
CampaignResult run(const std::string& subject, std::uint64_t cases, const std::string& lines = "") {
  return run_campaign(options(subject, cases, lines), built_in_robot());
}
/// Limits that everything passes.
const std::string wide = "[limits]\n*, *, any, forward = 1e15\n*, *, any, excess = 1e15\n";

std::vector<std::string> cliffs_in(const CampaignResult& r) {
  std::vector<std::string> all;
  for (const auto& [series, tally] : r.series)
    for (const Cliff& c : cliffs_of(*series, tally)) all.push_back(text_of(*series, c));
  return all;
}

TEST(Cliffs, OfTheTextbookAreNamedWhateverItPromises) {
  for (const std::string& lines : {std::string(), wide}) {
    const StoredRun r{run("textbook", 20000, lines), {}, {}};
    EXPECT_TRUE(r.result.failed);
    const auto all = cliffs_in(r.result);
    EXPECT_TRUE(std::ranges::any_of(all, [](const std::string& c) {
      return c.starts_with("exp6 translation at theta 1e-8..1e-7: ") &&
             c.find(" times its error at moderate angles (") != c.npos;
    })) << fmt::format("{}", fmt::join(all, "\n"));
    EXPECT_EQ(record_of(r)["cliffs"].size(), all.size());
    EXPECT_EQ(record_of(r)["verdict"], "fail");
  }
}

struct Measured {
  const char* band;
  double error;
  int cases = 1000;
  double worst = error;  ///< of one of them
};
/// The cliffs of exp6, translation, if so many cases of each band have this error.
std::vector<std::string> cliffs_of_errors(const std::vector<Measured>& all) {
  const auto series = std::move(select(options("liecheck", 1).selection, built_in_robot()).at(0));
  Tally tally;
  for (const Measured& m : all) {
    std::size_t band = 0;
    while (series->bands()[band].name != m.band) ++band;
    Row& row = tally.rows.of(6, band);
    for (int i = 0; i < m.cases; ++i) row.errors.add(i > 0 ? m.error : m.worst);
    row.max_error = row.max_excess = m.worst;
  }
  std::vector<std::string> texts;
  for (const Cliff& c : cliffs_of(*series, tally)) texts.push_back(text_of(*series, c));
  return texts;
}

TEST(Cliffs, AreAHundredTimesTheErrorElsewhereWhichIsAtLeastOneEps) {
  const auto beside = [](double error, int cases) {
    return cliffs_of_errors({{"generic 1..pi-1", 1e-3}, {"theta 1e-8..1e-7", error, cases}}).size();
  };
  EXPECT_EQ(beside(101, 100), 1u);
  EXPECT_EQ(beside(101, 99), 0u);
  EXPECT_EQ(beside(99, 1000), 0u);
  EXPECT_EQ(cliffs_of_errors({{"generic 1..pi-1", 1}, {"theta 1e-8..1e-7", 1, 1000, 1e9}}).size(), 0u)
      << "one input";
}

TEST(Cliffs, MayRiseFromTheBandsOnBothSidesOnly) {
  const auto of = [](double below, double above) {
    return cliffs_of_errors(
        {{"theta 1e-9..1e-8", below}, {"theta 1e-8..1e-7", 1e4}, {"theta 1e-6..1e-5", above}});
  };
  EXPECT_EQ(of(1, 1e4).size(), 0u);
  EXPECT_EQ(of(1e4, 1).size(), 0u);
  ASSERT_EQ(of(1, 2).size(), 1u);
  EXPECT_NE(of(1, 2)[0].find(
                "exp6 translation at theta 1e-8..1e-7: 5e+03 times its error in the bands beside it ("),
            std::string::npos)
      << of(1, 2)[0];
}

/// Nor of one that is inaccurate everywhere: tests/properties/promises_test.cpp.
TEST(Cliffs, AreNotOfSubjectsThatAreCorrect) {
  for (const char* subject : {"liecheck", "liecheck:fast", "correct:books", "correct:rodrigues",
                              "correct:cayley", "correct:matrices"})
    EXPECT_EQ(cliffs_in(run(subject, 8000)), std::vector<std::string>()) << subject;
}

TEST(Cliffs, MayBeExpectedButNotThoseBesideThem) {
  const auto of = [](const char* region) {
    return run("textbook", 20000, wide + "[expected]\nexp6, translation, " + region + " = cancels, l\n");
  };
  const auto of_translation = [](const CampaignResult& r, bool expected) {
    std::size_t n = 0;
    for (const auto& [series, tally] : r.series)
      for (const Cliff& c : cliffs_of(*series, tally)) n += c.expected == expected && c.output == 6;
    return n;
  };
  const CampaignResult all = of("theta 1e-8..1"), one = of("theta 1e-8..1e-7");
  EXPECT_EQ(of_translation(all, true), 1u);
  EXPECT_EQ(of_translation(all, false), 0u);
  EXPECT_FALSE(expectations_of(all).at(0).passed());
  EXPECT_EQ(of_translation(one, true), 1u);
  EXPECT_EQ(of_translation(one, false), 1u);
}

}  // namespace
}  // namespace liecheck::properties
