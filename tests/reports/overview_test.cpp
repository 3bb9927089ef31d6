// The words of the page: verdicts that weigh ordinary inputs, findings, the order of the table, sections without data.

#include <gtest/gtest.h>

#include <filesystem>
#include <reports/cost_points.hpp>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <reports/verdicts.hpp>
#include <support/files.hpp>
#include <support/read_json.hpp>

#include "sample_record.hpp"

namespace {

using namespace liecheck::reports;

Json row_at(const char* axis, const char* band, double low, double high, double max_eps,
            const char* operation = "exp6") {
  Json all = row("mine", band, max_eps);
  all["axis"] = axis, all["low"] = low, all["high"] = high, all["operation"] = operation;
  return all;
}

Json ordinary(double max_eps, const char* operation = "exp6") {
  return row_at("theta", "theta 1e-5..1e-4", 1e-5, 1e-4, max_eps, operation);
}
Json extreme(double max_eps, const char* operation = "exp6") {
  return row_at("theta", "theta^2 underflows", 2.2e-308, 1.5e-154, max_eps, operation);
}

/// A record of the library "mine" alone, or of two libraries.
Merged merged(std::vector<Json> rows, const Json& more = Json::object()) {
  Json all = record();
  all["subjects"][0]["name"] = "mine";
  all["subjects"].erase(1);
  all.update(more);
  all.erase("results");
  Merged whole;
  whole.records.push_back(all), whole.results = std::move(rows);
  return whole;
}

FirstScreen screen_of(const Merged& all) {
  return first_screen(Looks(all));
}

TEST(Verdicts, OrdinaryAnglesAreThoseThatPeopleMeet) {
  for (const auto& [axis, low, high] : {std::tuple("theta", 1e-8, 1e-7),
                                        {"theta", 0., 0.},
                                        {"pi_minus_theta", 1e-8, 1e-7},
                                        {"pi_minus_theta", 0., 1e-15}})
    EXPECT_TRUE(is_ordinary(row_at(axis, "b", low, high, 1))) << axis << low;
  for (const auto& [axis, low, high] :
       {std::tuple("theta", 1e-9, 1e-8), {"theta", 0., 1e-308}, {"pi_minus_theta", 1e-9, 1e-8}})
    EXPECT_FALSE(is_ordinary(row_at(axis, "b", low, high, 1))) << axis << low;
  EXPECT_TRUE(is_ordinary(row_at("none", "generic 1..pi-1", 1, 2.14, 1)));
  EXPECT_TRUE(is_ordinary(row_at("none", "all", 0, 0, 1)));
  EXPECT_FALSE(is_ordinary(row_at("none", "huge", 100, 0, 1)));
  EXPECT_FALSE(is_ordinary(row_at("none", "near 2pi k", 6.2, 100, 1)));
}

TEST(Verdicts, ALibraryThatFailsAtExtremeAnglesAloneIsAccurateForOrdinaryInputs) {
  const FirstScreen edge = screen_of(merged({extreme(1e15), ordinary(1)}));
  EXPECT_EQ(edge.title, "mine is accurate for ordinary inputs; it is wrong at angles below 10⁻¹⁵⁴ rad");
  EXPECT_EQ(edge.kind, "edge");
  EXPECT_TRUE(has(edge.questions[0].answer, "Not near 0: 1 operation, only below 10⁻⁸. Right near π"));
  const FirstScreen wrong = screen_of(merged({extreme(1e15, "log6"), ordinary(9)}));
  EXPECT_EQ(wrong.title, "mine is wrong in 1 of 2 operations");
  EXPECT_EQ(wrong.kind, "fail");
  EXPECT_TRUE(has(wrong.lines[0].words, "</b>, and at extreme angles in 1 more"));
}

// A library offers log3_matrix, and a law forms log_of_drifted_matrix from it: two operations of which it offers one.
TEST(Verdicts, CountTheFunctionsOfALibrary) {
  const auto title = [](double drifted, double own) {
    return screen_of(
               merged({ordinary(1), ordinary(own, "log3_matrix"), ordinary(drifted, "log_of_drifted_matrix")},
                      {{"operations", full_record()["operations"]}}))
        .title;
  };
  EXPECT_EQ(title(1e9, 1), "mine is wrong in 1 of 2 operations");
  EXPECT_EQ(title(1e9, 1e9), "mine is wrong in 1 of 2 operations");
}

TEST(Verdicts, AHardCaseOfAnOrdinaryAngleMakesALibraryWrong) {
  Json hard = hard_case("mine", "not finite");
  const auto title = [&](const char* band) {
    return screen_of(merged({extreme(1e15), ordinary(1)},
                            {{"hard_cases", Json::array({with(hard, "/cells/0/band", band)})}}))
        .title;
  };
  EXPECT_EQ(title("theta 1e-5..1e-4"), "mine is wrong on hard cases");
  EXPECT_TRUE(title("theta^2 underflows").starts_with("mine is accurate for ordinary inputs"));
}

TEST(Verdicts, SayWhereTheInputDeterminesNothing) {
  Merged all = merged({ordinary(1), extreme(1, "log6")});
  all.records[0]["verdict"] = "pass";
  EXPECT_TRUE(has(screen_of(all).lines[0].words, "in all 2 operations, at every angle."));
  EXPECT_TRUE(has(digits_table(Looks(all)), "<i class=p>15.7</i>"));
  all.results[1]["status"] = "ill-posed";
  EXPECT_TRUE(has(screen_of(all).lines[0].words, "wherever the input determines the result."));
  EXPECT_TRUE(has(digits_table(Looks(all)), "<i class=i>–</i>"));
  EXPECT_FALSE(has(digits_table(Looks(all)), "<i class=o>"));
}

TEST(Verdicts, SayThatFailuresAreElsewhere) {
  Json all = row_at("none", "all", 0, 0, 1e9, "compose");
  EXPECT_EQ(near_words(Looks(merged({ordinary(1), all}))),
            "Yes, every operation; the failures are elsewhere: compose");
  EXPECT_EQ(near_words(Looks(merged({ordinary(1)}))), "Yes, every operation");
}

TEST(FirstScreen, ShowsNearZeroAndNearPiTheBlockThatFailsThere) {
  const FirstScreen screen =
      screen_of(merged({ordinary(1e9, "log6"), ordinary(1),
                        row_at("pi_minus_theta", "pi-theta 1e-5..1e-4", 1e-5, 1e-4, 1, "log6"),
                        row_at("pi_minus_theta", "pi-theta 1e-5..1e-4", 1e-5, 1e-4, 1e9)}));
  ASSERT_EQ(screen.questions[0].pictures.size(), 2u);
  EXPECT_EQ(screen.questions[0].pictures[0].first, "near 0: log6 (translation)");
  EXPECT_EQ(screen.questions[0].pictures[1].first, "near π: exp6 (translation)");
}

Json finding(const std::string& text) {
  return {{"subject", "mine"}, {"operation", "exp6"}, {"text", text}};
}

TEST(Findings, SayWhichInputsHeadingAndMarksAreOf) {
  const Json both =
      Json::array({finding("1  exp6 (translation): 3.0 of 15.7 digits lost in double\n   where    all\n")});
  const char* note = "which the heading does not count: 14.0 of 15.7 digits lost there";
  EXPECT_TRUE(
      has(findings_section(Looks(merged({ordinary(1000), extreme(1e14)}, {{"findings", both}}))), note));
  EXPECT_FALSE(has(findings_section(Looks(merged({ordinary(1000), extreme(1)}, {{"findings", both}}))),
                   "the heading does not count"));
}

TEST(Findings, LinkTheirHardCasesAndSayHowManyFollow) {
  const Json all =
      Json::array({finding("1  exp6 (translation): bad\n"
                           "   hard     3 of the hard cases fail worst in these blocks: a, ...\n")});
  const auto text = [&](const Json& more) { return findings_section(Looks(merged({ordinary(9)}, more))); };
  const std::string alone = text({{"findings", all}});
  EXPECT_TRUE(has(alone, "<a href=\"#stability\">3 of the hard cases fail worst in these blocks: a, ...</a>"))
      << alone;
  EXPECT_TRUE(has(alone, "What is wrong: 1 finding<")) << alone;
  EXPECT_TRUE(has(text({{"findings", all}, {"further_findings", 4}}),
                  "What is wrong: 1 of 5 findings, first what costs most; "));
}

TEST(Findings, EndWithTheOperationsThatNoneOfThemNames) {
  const Json all =
      Json::array({finding("1  exp6 (translation): bad\n   so       log6 fails in the same way\n")});
  const std::string text = findings_section(Looks(merged(
      {ordinary(9), ordinary(9, "log6"), ordinary(9, "compose"), ordinary(1, "inverse"), extreme(9, "slerp")},
      {{"findings", all}})));
  EXPECT_TRUE(has(text,
                  "<b>mine</b> fails in 1 further operation: <a href=\"#op-compose\">compose</a>; at extreme "
                  "angles alone in 1 further operation: "))
      << text;
  EXPECT_TRUE(has(digits_table(Looks(merged({ordinary(9, "compose")}))), "<tr id=\"op-compose\""));
}

TEST(Findings, OfARefusalHaveNoChartsAndComeLast) {
  Json refused = ordinary(1);
  refused["status"] = "fail", refused["refused"] = 5, refused["max_eps"] = 0;
  const std::string
      refusal = "1  exp6 (translation): refused in double\n   where    everywhere: 5 of 5 cases\n",
      loss =
          "2  log6 (translation): 3.0 of 15.7 digits lost in double\n   where    only if x < 1: 5 "
          "of 9 cases\n";
  Json second = finding(loss);
  second["operation"] = "log6";
  const Merged all =
      merged({refused, ordinary(1000, "log6")}, {{"findings", Json::array({finding(refusal), second})}});
  const std::string text = findings_section(Looks(all));
  EXPECT_LT(text.find("3.0 of 15.7"), text.find("refused in double"));
  EXPECT_EQ(text.find("panels", text.find("refused in double")), text.npos);
  EXPECT_TRUE(has(screen_of(all).lines[0].words, "<span class=\"where\">, only if x &lt; 1</span>"));
  EXPECT_TRUE(has(digits_table(Looks(all)), "<i class=f>R</i>"));
}

TEST(Findings, SayOfWhichNumbersTheDigitsOfAnExampleAre) {
  const Json one =
      Json::array({finding("1  exp6 (translation): bad\n   example  exp6(0)\n            p[0] is 1, and 2 is "
                           "right: 3.0 of 15.7 digits lost\n")});
  EXPECT_TRUE(has(findings_section(Looks(merged({ordinary(9)}, {{"findings", one}}))),
                  "3.0 of 15.7 digits lost, of the whole result by its norm"));
}

TEST(DigitsTable, HasMarksForWhatHasNoDigitsAndAKeyOfThoseAlone) {
  Json sign = ordinary(1e15), tiny = ordinary(.5, "log6");
  sign["block"] = "sign", tiny["budget"] = .01, tiny["status"] = "fail";
  const std::string text = digits_table(Looks(merged({sign, tiny})));
  EXPECT_TRUE(has(text, "<i class=f>B</i>"));
  EXPECT_TRUE(has(text, "<i class=m>0.5 ε</i>"));
  const std::string note = digits_note(text);
  EXPECT_TRUE(has(note, "B: wrong branch"));
  EXPECT_TRUE(has(note, "ε: an error"));
  for (const char* absent : {"within</", "N: NaN", "R: refused", "class=p", "class=e", "ns: "})
    EXPECT_FALSE(has(note, absent)) << absent;
}

TEST(DigitsTable, HasTheOrderOfTheDocumentationAfterWhatFails) {
  const std::string text = digits_table(Looks(merged(
      {ordinary(1, "of_nobody"), ordinary(1, "log6"), ordinary(1, "exp6"), ordinary(9, "integrate")})));
  std::size_t last = 0;
  for (const char* name : {"op-integrate", "op-exp6\" class=\"rest\"", "op-log6", "op-of_nobody"}) {
    const std::size_t at = text.find(name);
    ASSERT_NE(at, text.npos) << name;
    EXPECT_GT(at, last) << name;
    last = at;
  }
}

TEST(DigitsTable, MarksOperationsThatWereNotTimed) {
  Json times = cost();
  times["rows"] = Json::array({cost_row("mine", "double", "exp6", 1e-9, 50)});
  const std::string text = digits_table(Looks(merged({ordinary(1), ordinary(1, "log6")}, {{"cost", times}})));
  EXPECT_TRUE(has(text, "<em>50</em>"));
  EXPECT_TRUE(has(text, "<em>–</em>"));
}

TEST(CostPicture, NamesEveryMarkOrHasALegend) {
  Json times = cost();
  times["rows"] = Json::array();
  for (int i = 0; i < 30; ++i)  // in one place: there is no room for all names
    times["rows"].push_back(cost_row("library_" + std::to_string(i), "double", "exp6", 1e-9, 50));
  const Merged all = merged({ordinary(1)}, {{"cost", times}});
  const Looks looks(all);
  const std::string picture = cost_picture(looks, cost_points(times), "exp6");
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(has(picture, ">library_" + std::to_string(i) + "</text>")) << i;
}

TEST(CostPicture, FloatIsSmallAndTheLegendSaysSo) {
  Json times = cost();
  times["rows"] = Json::array({cost_row("mine", "float", "exp6", 1e-6, 50)});
  const Merged all = merged({ordinary(1)}, {{"cost", times}});
  EXPECT_TRUE(has(cost_picture(Looks(all), cost_points(times), "exp6"), "small: float"));
  times["rows"][0]["scalar"] = "double";
  EXPECT_FALSE(has(cost_picture(Looks(all), cost_points(times), "exp6"), "small: float"));
}

/// The error of a set follows from its blocks, here as in the program that writes the record.
TEST(CostPoints, TheErrorOfAllInputsIsThatOfTheRecord) {
  const Json cost = liecheck::properties::read_json(LIECHECK_SOURCE_DIR "/fixtures/report/times.json");
  std::size_t rows = 0;
  for (const Json& r : cost["rows"]) {
    if (r["error"].is_null()) continue;
    ++rows;
    EXPECT_DOUBLE_EQ(error_of_set(r["sets"].back(), r["eps"]), figure(r["error"]))
        << r["subject"] << r["operation"];
  }
  EXPECT_GT(rows, 10u);
}

TEST(FirstScreen, OfOneLibraryPricesWhatFailsOnTheTimedInputs) {
  Json times = cost(), row = times["rows"][0];
  row["subject"] = "mine", row["scalar"] = "double", times["rows"] = Json::array();
  for (const auto& [operation, error] : {std::pair("compose", 1e-15), {"log6", 1e-6}}) {
    row["operation"] = operation, row["error"] = error;
    times["rows"].push_back(row);
  }
  Json findings = Json::array();
  for (const char* operation : {"compose", "log6"})
    findings.push_back({{"subject", "mine"}, {"operation", operation}, {"text", "1  x: y\n"}});
  const auto price = [&] {
    return screen_of(merged({ordinary(1)}, {{"cost", times}, {"findings", findings}})).questions.at(1).answer;
  };
  EXPECT_TRUE(price().starts_with("<b>log6</b>")) << price();
  times["rows"][1]["error"] = 1e-15;  // no failure is among the timed inputs: then of the first finding
  EXPECT_TRUE(price().starts_with("<b>compose</b>")) << price();
}

}  // namespace
