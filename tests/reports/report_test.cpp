// The report: which records it refuses, how it merges records, and that its three files agree.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <reports/report.hpp>
#include <stdexcept>
#include <string>
#include <support/files.hpp>

#include "../refusal.hpp"
#include "../scratch.hpp"
#include "sample_record.hpp"

namespace {

namespace fs = std::filesystem;
using namespace liecheck::reports;

class Report : public testing::Test {
 protected:
  const fs::path dir = liecheck::own_folder();

  fs::path store(const std::string& name, const std::string& text) const {
    std::ofstream(dir / name, std::ios::binary) << text;
    return dir / name;
  }
  static std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// The error line for a record with this text. It must name the file, and no output may be written.
  std::string refusal(const std::string& text) const {
    const fs::path file = store("record.json", text);
    const std::string line =
        liecheck::test::refusal<std::runtime_error>([&] { write_report({file}, dir / "out"); });
    EXPECT_FALSE(has(line, "\n"));
    EXPECT_TRUE(has(line, file.string()));
    EXPECT_FALSE(fs::exists(dir / "out"));
    return line;
  }
  std::string page_of(const Json& r) const { return read(report(r).html); }
  void expect_refused(const Json& r, const std::string& words) const {
    EXPECT_TRUE(has(refusal(dumped(r)), words));
  }
  ReportFiles report(const Json& r) const {
    return write_report({store("record.json", dumped(r))}, dir / "deep" / "out");
  }
};

TEST_F(Report, RefusesATruncatedRecord) {
  const std::string text = dumped(record());
  EXPECT_TRUE(has(refusal(text.substr(0, text.size() / 2)), "not JSON: line 1, column "));
  EXPECT_TRUE(has(refusal(""), "end of the file"));
}

TEST_F(Report, NamesLineAndColumnOfInvalidJson) {
  EXPECT_TRUE(has(refusal("{\n  \"version\": !\n}"), "not JSON: line 2, column 14: unexpected \"0x21\""));
}

TEST_F(Report, AcceptsBandsWithoutACase) {
  Json r = record();
  r["results"][0].update({{"count", 0}, {"status", "empty"}, {"worst", nullptr}});
  const auto files = report(r);
  EXPECT_TRUE(has(read(files.csv), ",empty,,,\r\n"));
  EXPECT_TRUE(has(read(files.html), "<b>liecheck</b> in double"));
}

TEST_F(Report, RanksAWrongBranchAboveAnyError) {
  EXPECT_TRUE(has(page_of(with(record(), "/results/1/wrong_branch", 1)), "<b>wrong branch</b>"));
}

TEST_F(Report, NamesTheCliffsThatNobodyExpects) {
  EXPECT_TRUE(has(page_of(full_record()), "<b>textbook</b>: exp6 translation at theta 1e-8..1e-7 in double"));
  EXPECT_FALSE(has(page_of(with(full_record(), "/cliffs/0/expected", true)),
                   "exp6 translation at theta 1e-8..1e-7 in double"));
}

TEST_F(Report, CallsASubjectWithAnUnresolvedBandIncomplete) {
  Json r = record();
  r["results"].push_back(row("liecheck", "0", 0));
  r["results"][2]["status"] = "unresolved";
  EXPECT_TRUE(has(page_of(r), "<dt>incomplete</dt><dd><b>liecheck</b> in double</dd>"));
}

TEST_F(Report, PassesNothingThatWasNotMeasured) {
  const auto verdict_with = [&](auto change) {
    Json r = record();
    r["results"].erase(1);  // the row of textbook, which fails
    r["subjects"].erase(1);
    r["verdict"] = "pass";
    change(r);
    fs::remove_all(dir / "deep");
    const std::string page = page_of(r);
    return has(page, "<title>liecheck accuracy report: pass</title>")         ? "pass"
           : has(page, "<title>liecheck accuracy report: incomplete</title>") ? "incomplete"
                                                                              : "fail";
  };
  EXPECT_STREQ(verdict_with([](Json&) {}), "pass");
  for (const char* status : {"unresolved", "unmeasured", "ill-posed"})
    EXPECT_STREQ(verdict_with([&](Json& r) { r["results"][0]["status"] = status; }), "incomplete") << status;
  EXPECT_STREQ(
      verdict_with([](Json& r) { r["hard_cases"] = Json::array({hard_case("liecheck", "unresolved")}); }),
      "incomplete");
  EXPECT_STREQ(verdict_with([](Json& r) {
                 r["not_measured"] = parsed(R"json([{"property": "exp_oracle", "scalar": "double",
 "subject": "liecheck", "what": "exp6, jump: measured in 0 of 20000 cases"}])json");
               }),
               "incomplete");
}

TEST_F(Report, RefusesRecordsThatContradictThemselves) {
  const std::string verdict = "verdict: expected fail, as ", status = "results[0].status: expected ";
  const Json pass = without(without(with(record(), "/verdict", "pass"), "/results/1"), "/subjects/1");
  EXPECT_EQ(refusal_of(pass), "");
  expect_refused(with(record(), "/verdict", "pass"), verdict + "results[1] failed, found \"pass\"");
  expect_refused(with(pass, "/hard_cases", Json::array({hard_case("liecheck", "inaccurate")})),
                 verdict + "hard_cases[0] failed");
  expect_refused(with(pass, "/cliffs", full_record()["cliffs"]), verdict + "cliffs[0] failed");
  expect_refused(with(pass, "/sweep", with(swept(), "/verdict", "fail")), verdict + "sweep failed");
  expect_refused(with(pass, "/results/0/failed", 3), status + "fail, as failed is 3, found \"pass\"");
  expect_refused(with(pass, "/results/0/not_finite", 1), status + "fail, as not_finite is 1");
  expect_refused(with(pass, "/results/0/max_eps", 4.5), status + "fail, as max_eps is 4.5 and the budget 4");
  expect_refused(with(pass, "/results/0/max_eps", "nan"), status + "fail, as max_eps is \"nan\"");
  const Json excess = with(pass, "/results/0/rule", "excess");
  EXPECT_EQ(refusal_of(with(excess, "/results/0/max_eps", 9)), "");
  expect_refused(with(excess, "/results/0/max_excess", 9), status + "fail, as max_excess is 9");
  expect_refused(with(full_record(), "/results/1/failed", 0), "results[1].status: expected another than");
  expect_refused(with(record(), "/subjects/1/name", "liecheck"),
                 "subjects[1]: expected each subject and scalar once");
}

TEST_F(Report, DropsMembersThatItDoesNotKnow) {
  Json r = with(with(record(), "/later", {1, 2}), "/results/0/later", 1);
  const Json whole = parsed(read(report(with(r, "/subjects/0/later", Json::object())).json));
  EXPECT_EQ(whole, parsed(read(report(record()).json)));
}

TEST_F(Report, RefusesAMissingRecord) {
  EXPECT_THROW(write_report({dir / "nowhere.json"}, dir / "out"), std::runtime_error);
  EXPECT_THROW(write_report({}, dir / "out"), std::runtime_error);
}

TEST_F(Report, NamesTheFieldAndTheValueThatItRefuses) {
  EXPECT_TRUE(has(refusal("[1, 2]"), "(top level): expected an object, found [1,2]"));
  EXPECT_TRUE(has(refusal("{}"), "field version is missing"));
  EXPECT_TRUE(has(refusal(R"({"version": "1", "reference_ns": 1, "rows": []})"),
                  "is a record of times, which `liecheck cost` wrote, where that of a campaign is due"));
  expect_refused(without(record(), "/results/1/budget"), "field results[1].budget is missing");
  expect_refused(with(record(), "/results/1/status", "fine"),
                 "results[1].status: expected one of pass, fail");
  expect_refused(with(record(), "/results/0/max_eps", -1),
                 "results[0].max_eps: expected a number >= 0, \"inf\" or \"nan\", found -1");
}

TEST_F(Report, RefusesNumbersThatNoCampaignWrites) {
  const auto said = [&](const char* name, const Json& value) {
    return refusal(dumped(with(record(), std::string("/results/0/") + name, value)));
  };
  for (const char* name : {"budget", "low", "high", "count", "failed", "refused", "ill_posed"})
    EXPECT_TRUE(has(said(name, -1), fmt::format("results[0].{}: expected a", name))) << name;
  EXPECT_TRUE(has(said("count", 0), "results[0].count: expected a count from 1, found 0"));
  EXPECT_TRUE(has(said("count", UINT64_MAX), "results[0].count: expected a count from 0 to"));
  EXPECT_TRUE(has(said("failed", "x"), "results[0].failed: expected a count"));
  EXPECT_TRUE(has(said("failed", 714), "results[0].failed: expected a count from 0 to 713, found 714"));
  EXPECT_TRUE(has(said("reason", 1), "results[0].reason: expected a string"));
  expect_refused(with(record(), "/results/0/worst/kappa", "big"), "results[0].worst.kappa");
  expect_refused(with(record(), "/total_cases", "x"), "field total_cases: expected a count");
  expect_refused(with(record(), "/generator_version", 0), "field generator_version: expected a count");
  expect_refused(with(record(), "/subjects/1/eps", -0.5), "subjects[1].eps");
}

TEST_F(Report, NamesThePlaceOfANumberBeyondDouble) {
  EXPECT_TRUE(has(refusal("{\n \"1e999\": 1e999}"), "line 2, column 11: a number beyond double: 1e999"));
}

TEST_F(Report, NeverOverwritesItsInput) {
  const fs::path file = store("report.json", dumped(record()));
  EXPECT_THROW(write_report({file}, dir), std::runtime_error);
  EXPECT_EQ(read(file), dumped(record()));
}

TEST_F(Report, RefusesTheSameRowTwice) {
  Json r = record();
  r["results"].push_back(r["results"][0]);
  expect_refused(r, "liecheck / double / exp_oracle / exp6 / translation / theta 1e-5..1e-4");
}

TEST_F(Report, MergesRecords) {
  Json second = record();
  second["seed"] = 43;
  second["verdict"] = "fail";
  second["results"] = Json::array({row("liecheck", "0", 0)});
  const auto files =
      write_report({store("a.json", dumped(record())), store("b.json", dumped(second))}, dir / "out");
  const Json numbers = parsed(read(files.json));
  EXPECT_EQ(numbers["records"].size(), 2u);
  EXPECT_FALSE(numbers["records"][0].contains("results"));
  EXPECT_EQ(numbers["results"].size(), 3u);
  EXPECT_EQ(numbers["results"][2], second["results"][0]);
  EXPECT_TRUE(has(read(files.html), "accuracy report: fail"));
}

TEST_F(Report, OfARecordWithManyNamesIsWrittenInSeconds) {
  Json r = record(), names = Json::array();
  for (int i = 0; i < 100000; ++i) names.push_back(fmt::format("{}", i));
  r["subjects"][0]["not_offered"] = r["absent"] = names;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(has(page_of(r), ", 99999</td>"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(15));
}

/// What packed() treats apart: absent and equal values, rows with other fields, lists in lists.
TEST(Packed, IsWhatTheScriptRestores) {
  const Json both =
      parsed(liecheck::properties::read_whole(LIECHECK_SOURCE_DIR "/tests/reports/packed.json"));
  EXPECT_EQ(dumped(packed(both["plain"])), dumped(both["packed"]));
}

TEST(Packed, RefusesKeysThatTheScriptWouldMistake) {  // tests/browser restores what is packed
  for (const char* text : {"{\"*keys\": 1}", "[{\"*at\": 1}, {\"*at\": 2}]"})
    EXPECT_THROW(packed(parsed(text)), std::invalid_argument);
}

TEST_F(Report, WritesThreeFilesAndNoOther) {
  const auto files = report(record());
  EXPECT_EQ(std::distance(fs::directory_iterator(files.html.parent_path()), {}), 3);
  EXPECT_EQ(files.csv.filename(), "report.csv");
}

TEST_F(Report, QuotesCsvFieldsAndWritesEveryDigit) {
  Json r = record();
  r["results"][0]["block"] = "a, \"b\"";
  r["results"][0]["max_eps"] = 0.1;
  r["results"][1]["max_eps"] = "inf";
  const std::string csv = read(report(r).csv);
  EXPECT_TRUE(has(csv, "exp6,\"a, \"\"b\"\"\",theta 1e-5..1e-4"));
  EXPECT_TRUE(has(csv, ",0.10000000000000001,"));
  EXPECT_TRUE(has(csv, ",713,inf,"));
  EXPECT_TRUE(has(csv, "none.7,1.25,0x1p-3 -0x0p+0\r\n"));
  EXPECT_TRUE(csv.starts_with("subject,scalar,"));
}

TEST_F(Report, ShowsASweepAsAnUpperBoundRoundedUp) {
  const std::string empty = page_of(record());
  for (const char* section : {"sweep", "bounds", "scenes"})
    EXPECT_FALSE(has(empty, fmt::format("id=\"{}\"", section))) << section;
  EXPECT_TRUE(has(empty, "coefficients at every float</td><td>not in these records"));
  Json r = record();
  r["sweep"] = swept();
  const auto files = report(r);
  const std::string page = read(files.html);
  for (const char* text : {"<th scope=\"row\">d2</th>", "<td>1092479462</td>", "<b>21.2387</b>", "a &lt; b",
                           "<code>0x1.38968ap+3</code>", "status fail\">fail", "true upper bound [eps]"})
    EXPECT_TRUE(has(page, text)) << text;
  EXPECT_EQ(parsed(read(files.json))["records"][0]["sweep"], r["sweep"]);
  r["sweep"].update({{"bound", "lower"}, {"stride", 7}});
  r["sweep"]["coefficients"][0].update({{"bound_eps", nullptr}, {"status", "sampled"}});
  const std::string sampled = page_of(r);
  EXPECT_TRUE(has(sampled, "Every 7th float: the largest error found, a lower bound"));
  EXPECT_FALSE(has(sampled, "true upper bound [eps]"));
}

TEST_F(Report, NamesTheFieldOfASweepThatItRefuses) {
  Json r = with(record(), "/sweep", swept());
  expect_refused(with(r, "/sweep/coefficients/0/bound_eps", nullptr),
                 "sweep.coefficients[0].bound_eps: expected a number");
  r["sweep"]["coefficients"][0].update({{"bound_eps", 1}, {"constant", 1092479463}});
  expect_refused(r, "coefficients[0].constant: expected a count from 0 to 1092479462");
}

TEST_F(Report, ShowsTheMeasurementsOfOtherCommands) {
  Json good = with(record(), "/verdict", "pass");
  good["results"] = Json::array({row("liecheck", "theta 1e-5..1e-4", 1)});
  good["subjects"].erase(1);
  const fs::path campaign = store("campaign.json", dumped(good));
  const std::string without = read(write_report({campaign}, dir / "out").html);
  EXPECT_TRUE(has(without, "accuracy report: pass"));
  std::vector<fs::path> all{campaign};
  for (const char* kind : measurement_kinds) {
    EXPECT_FALSE(has(without, fmt::format("id=\"{}\"", kind)));
    all.push_back(store(std::string(kind) + ".json", dumped(measurement(kind))));
  }
  const auto files = write_report(all, dir / "out");
  const std::string page = read(files.html);
  for (const char* text :
       {"id=\"environments\"", "id=\"horizons\"", "id=\"rounding\"", "accuracy report: fail",
        // environments: a row, a matrix, what is absent and what is not built
        "<th scope=\"row\">&lt;mine&gt;</th><td>wasm</td><td><span class=\"status "
        "fail\">fail</span></td><td>130</td>"
        "<td>98 %</td><td>93 %</td><td>2</td><td>Inf</td><td>1.0</td>",
        "<th scope=\"row\">exp6 double</th><td><b class=\"status fail\">2 worse</b></td>",
        "<th scope=\"row\">log6 float</th><td>=</td>", "<th scope=\"row\">exp6 double</th><td>1.1</td>",
        "&lt;mine&gt;: 99 of 130 checks pass", "<td>50.0 %</td><td><code>f</code></td>",
        "<section id=\"environments\" aria-labelledby=\"environments-title\">\n<details open>",
        "riscv64: not installed: qemu-riscv64 is not there",
        "&lt;mine&gt; in aarch64: not measured: error: no",
        "<td>1e+06</td><td>1.2</td><td>200</td><td>0.2</td><td>0.51 (0.46 … 0.56)</td>",
        "fail</span>: norm beyond 4 eps</td><td>64</td><td>NaN</td><td>Inf</td><td>Inf</td><td>—</td>",
        "random rounding deceives in 1 of 2 parts", "<td>7.1</td><td>15.7</td><td>—</td>"})
    EXPECT_TRUE(has(page, text)) << text;
  const Json json = parsed(read(files.json));
  for (const char* kind : measurement_kinds) EXPECT_EQ(json[kind], Json::array({measurement(kind)}));
}

TEST_F(Report, RefusesMeasurementsWithoutACampaignOrWithAWrongField) {
  const Json horizons = measurement("horizons"), environments = measurement("environments");
  expect_refused(horizons, "no record of a campaign");
  expect_refused(with(horizons, "/rows/0/points/1/n", -1), "field rows[0].points[1].n: expected a count");
  expect_refused(with(horizons, "/verdict", "pass"), "field verdict: expected fail, as a row failed");
  expect_refused(with(measurement("rounding"), "/rounding", 2), "field rounding: expected 1, found 2");
  expect_refused(with(environments, "/seed", -1), "field seed: expected a seed");
  expect_refused(with(environments, "/rows/1/sum/same_calls", 101),
                 "rows[1].sum.same_calls: expected a count from 0 to 100, found 101");
  expect_refused(with(environments, "/rows/2", environments["rows"][0]),
                 "row environments / liecheck / up is already in");
  EXPECT_TRUE(has(refusal(std::string(200000, '[')), "nested more deeply than 100 levels"));
}

TEST_F(Report, EscapesDataInThePage) {
  Json r = record();
  r["subjects"][0]["not_offered"] = {"</script><script>alert(1)</script>", "{{machine}}"};
  const std::string page = page_of(r);
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_TRUE(has(page, "&lt;/script&gt;"));
  EXPECT_TRUE(has(page, ", {{machine}}</td>"));
}

TEST_F(Report, EscapesControlCharactersAndMarksThatTurnALine) {
  Json r = record();
  r["version"] = "1\x1b[2J\u202e2\u2066";
  r["results"][0]["block"] = "b\x1b\u202e";
  const ReportFiles files = report(r);
  for (const fs::path& file : {files.html, files.csv, files.json})
    for (const char* raw : {"\x1b", "\\u001b", "\u202e", "\u2066"})
      EXPECT_FALSE(has(read(file), raw)) << file;
  EXPECT_TRUE(has(read(files.csv), "b\\x1b\\xe2\\x80\\xae"));
}

TEST_F(Report, AnswersComeFirst) {
  const std::string page = page_of(full_record());
  std::size_t last = 0;
  for (const char* part :
       {"id=\"sentences\"", "id=\"cover\"", "id=\"price\"", "id=\"hard\"", "id=\"findings\"",
        "id=\"controls\"", "id=\"digits-table\"", "id=\"stability-matrix\"", "id=\"figures\""}) {
    EXPECT_GT(page.find(part), last) << part;
    last = page.find(part);
  }
}

TEST(PageNumbers, KeepTheWorstInputOfEachRegionAndRoundFigures) {
  Json r = record();
  r["results"] =
      Json::array({row("liecheck", "theta 1e-5..1e-4", 1.23456789), row("liecheck", "theta 1e-4..1e-3", 7)});
  const Merged merged{{r}, {}, {}};
  const Looks looks(merged);
  const Json page = page_numbers({{"records", Json::array()}, {"results", r["results"]}}, looks);
  EXPECT_EQ(page["results"][0]["max_eps"], 1.235);
  EXPECT_TRUE(page["results"][0]["worst"]["input"].empty());
  EXPECT_EQ(page["results"][1]["worst"]["input"], r["results"][1]["worst"]["input"]);
  EXPECT_EQ(page["results"][1]["region"], "small");
  for (Json& row : r["results"]) row["status"] = "pass";
  r["results"][0]["not_finite"] = 1;
  const Json broken = page_numbers({{"records", Json::array()}, {"results", r["results"]}}, looks);
  EXPECT_TRUE(broken["results"][0]["worst"]["shown"]);
  EXPECT_FALSE(broken["results"][1]["worst"]["shown"]);
}

TEST_F(Report, NeedsNoNetwork) {
  const std::string page = page_of(record());
  for (const char* way : {"src=\"http", "href=\"http", "@import", "url("})
    EXPECT_FALSE(has(page, way)) << way;
  EXPECT_TRUE(has(page, "default-src 'none'"));
  EXPECT_TRUE(has(page, "Chart.js v"));
}

TEST_F(Report, WarnsIfThePositiveControlPassed) {
  Json r = record();
  EXPECT_FALSE(has(page_of(r), "CONTROL PASSED"));
  r["results"][1] = row("textbook", "theta 1e-5..1e-4", 1);
  EXPECT_TRUE(has(page_of(r), "CONTROL PASSED"));
}

TEST_F(Report, ShowsNanOrInfAsAnOutcome) {
  Json r = record();
  r["results"][1]["max_eps"] = "nan";
  r["results"][1]["not_finite"] = 2;
  EXPECT_TRUE(has(page_of(r), "<b>NaN or Inf</b>"));
}

TEST_F(Report, ShowsTheHardCasesOfEveryRecord) {
  Json first = record(), second = record();
  first["hard_cases"] = Json::array({hard_case("liecheck", "stable")});
  second["hard_cases"] = Json::array({hard_case("textbook", "not finite")});
  second["results"] = Json::array();
  const auto files =
      write_report({store("a.json", dumped(first)), store("b.json", dumped(second))}, dir / "out");
  const std::string page = read(files.html);
  EXPECT_TRUE(has(page, "id=\"stability-matrix\""));
  EXPECT_TRUE(has(page, "1 of 2 hard cases fail"));
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

/// Two laws look at the case "zero", and both fail; a third case is stable. tests/browser compares what scripts write.
TEST_F(Report, EveryPlaceHasTheSameHardCases) {
  Json r = record();
  const Json zero = hard_case("textbook", "not finite");
  r["hard_cases"] = {zero, with(zero, "/property", "log_oracle"),
                     with(hard_case("textbook", "stable"), "/name", "other")};
  const std::string page = page_of(r);
  EXPECT_EQ(count(page, "1 of 2 hard cases fail"), 3u);  // the verdict on textbook, the answer, the campaign
  EXPECT_TRUE(has(page, "textbook in double</th><td>2</td><td>1</td>"));  // cases, stable
  EXPECT_TRUE(has(page, "<td>1</td><td>0</td><td>1</td></tr>"));          // not finite, bad call, failed
  EXPECT_TRUE(has(page, "<title>textbook, zero: 1 of 2 fail</title>"));   // the map
}

TEST_F(Report, ShowsItsPicturesWithoutAScript) {
  Json r = full_record();
  r["cost"] = cost();
  r["hard_cases"] = Json::array({hard_case("textbook", "not finite")});
  std::string page = page_of(r);
  page.erase(page.find("<script"));
  EXPECT_GE(count(page, "<svg class=\"picture\""), 3u);
  EXPECT_TRUE(has(page, "<title>textbook, theta 1e-5..1e-4: 3.4 of 15.7 digits lost, over budget</title>"));
  EXPECT_TRUE(has(page, "<title>fast in double: 14.5 correct digits, 80 ns</title>"));
  EXPECT_TRUE(has(page, "class=\"front\""));
  EXPECT_TRUE(has(page, "<i class=f>12.3</i>"));  // the table of digits
}

TEST(Findings, HaveTheLinesOfTheTerminal) {
  const FindingText f = parts_of(
      "3  exp6 (translation): bad\n   where    theta < 1\n   example  exp6(1)\n            p[0] is 2\n  as "
      "mine's own program:\n\nprint(1)\n  print(2)\n\n   replay   liecheck replay x\n");
  EXPECT_EQ(f.title, "exp6 (translation): bad");
  using Lines = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(f.lines, (Lines{{"where", "theta < 1"},
                            {"example", "exp6(1)\np[0] is 2"},
                            {"program", "print(1)\n  print(2)"},
                            {"replay", "liecheck replay x"}}));
}

TEST_F(Report, NamesTheFieldOfAHardCaseThatItRefuses) {
  const auto with_cases = [](const Json& cases) { return with(record(), "/hard_cases", cases); };
  const Json stable = hard_case("liecheck", "stable");
  expect_refused(with_cases(Json::array({hard_case("liecheck", "splendid")})),
                 "hard_cases[0].cells[0].verdict: expected one of stable, refused");
  expect_refused(with_cases(Json::array({stable, stable})),
                 "hard_cases: zero / exp_oracle / liecheck / double is already in");
  expect_refused(with_cases(Json::array({with(stable, "/input", Json::object())})),
                 "hard_cases[0].input.double is missing");
}

TEST_F(Report, StatesThatThereAreNoResults) {
  EXPECT_TRUE(
      has(page_of(with(record(), "/results", Json::array())), "incomplete\">The records hold no results."));
}

}  // namespace
