// A subject's own limits and domain, read from a file: what they change, what is refused, what is recorded.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <campaign/coverage_report.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <set>
#include <store/compare.hpp>
#include <store/merge.hpp>
#include <store/store_path.hpp>
#include <store/stored_run.hpp>
#include <support/files.hpp>

#include "../campaigns.hpp"
#include "../own_subject.hpp"
#include "../refusal.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::properties {
namespace {

using V6 = Vec<double, 6>;

/// exp6 of liecheck, which refuses to turn by more than 3 rad.
const Registered<double> shy = registered("limits:shy", op::exp6, [](const V6& xi) {
  if (!(xi.tail<3>().stableNorm() <= 3)) throw std::domain_error("more than 3 rad");
  return own_subject().operations[op::exp6](xi);
});

std::shared_ptr<const SubjectLimits> limits(const std::string& lines,
                                            const std::string& subject = "liecheck") {
  return std::make_shared<const SubjectLimits>(
      parse_limits("own.limits", "version = 1\nsubject = " + subject + "\n" + lines));
}

std::vector<Budget> table_of(const std::shared_ptr<const SubjectLimits>& own) {
  return with_own_limits(budgets(own->subject), own->lines);
}

CampaignOptions options(const std::string& subject, std::shared_ptr<const SubjectLimits> own,
                        const std::string& property = "exp_oracle", std::uint64_t cases = 600) {
  CampaignOptions o = quiet({{subject}, {property}, {"double"}}, cases);
  if (own) o.selection.limits = {std::move(own)};
  return o;
}
CampaignResult run(const std::string& subject, std::shared_ptr<const SubjectLimits> own,
                   const std::string& property = "exp_oracle", std::uint64_t cases = 600) {
  return run_campaign(options(subject, std::move(own), property, cases), built_in_robot());
}

/// The sum of a count over the rows of a block of exp6 in a region.
std::uint64_t sum(const CampaignResult& r, BlockName block, Region region, std::uint64_t Row::*count) {
  std::uint64_t n = 0;
  const SeriesResult& s = r.series.at(0);
  for (const auto& [cell, row] : s.tally.rows) {
    const Output& o = s.series->outputs.at(static_cast<std::size_t>(cell.first));
    if (o.operation == "exp6" && o.block == block.text &&
        s.series->bands()[static_cast<std::size_t>(cell.second)].region == region)
      n += row.*count;
  }
  return n;
}
std::uint64_t failed_up_to_pi(const CampaignResult& r) {
  return sum(r, block::translation, Region::to_pi, &Row::failed);
}
std::uint64_t failed_beyond_pi(const CampaignResult& r) {
  return sum(r, block::translation, Region::beyond_pi, &Row::failed);
}

/// The message of the exception that f throws, or "".
std::string error(const auto& f) {
  return test::refusal<std::exception>(f);
}

TEST(Limits, TurnAFailureIntoAPassAndThePassOfAnotherIntoAFailure) {
  EXPECT_GT(failed_up_to_pi(run("textbook", nullptr)), 0u);
  const auto wide = limits("[limits]\nexp6, translation, to_pi, forward = 1e12, closed forms\n", "textbook");
  EXPECT_EQ(failed_up_to_pi(run("textbook", wide)), 0u);
  EXPECT_FALSE(run("liecheck", nullptr).failed);
  const CampaignResult narrow =
      run("liecheck", limits("[limits]\nexp6, translation, to_pi, forward = 1e-3\n"));
  EXPECT_TRUE(narrow.failed);
  EXPECT_GT(failed_up_to_pi(narrow), 0u);
  EXPECT_EQ(failed_beyond_pi(narrow), 0u);
}

TEST(Limits, ReplaceThoseOfEveryRule) {
  const CampaignResult narrow = run("liecheck", limits("[limits]\n*, translation, any, excess = 1e-9\n"));
  EXPECT_EQ(failed_up_to_pi(narrow), 0u);
  EXPECT_GT(failed_beyond_pi(narrow), 0u);
}

TEST(Limits, ThatNameMoreCountMore) {
  const auto table = table_of(limits(
      "[limits]\nexp6, translation, any, forward = 1\n*, *, to_pi, forward = 2\n*, *, any, forward = 3\n"
      "*, translation, any, forward = 4\nexp6, *, any, forward = 5\n"));
  const auto of = [&](const char* operation, const char* block, Region region = Region::to_pi) {
    return budget_in(table, operation, block, region).limit;
  };
  EXPECT_EQ(of("exp6", "translation"), 1);
  EXPECT_EQ(of("exp6", "rotation"), 5);
  EXPECT_EQ(of("integrate", "translation"), 4);
  EXPECT_EQ(of("log6", "linear"), 2);
  EXPECT_EQ(of("log6", "linear", Region::beyond_pi), 3);
}

TEST(Limits, ApplyToOneRegionOfALimitForBoth) {
  const auto table = table_of(limits("[limits]\nlog6, linear, beyond_pi, forward = 77, why\n"));
  const auto of = [&](Region region) { return budget_in(table, "log6", "linear", region).limit; };
  EXPECT_EQ(of(Region::beyond_pi), 77);
  EXPECT_EQ(of(Region::to_pi), budget_of("liecheck", "log6", "linear", Region::to_pi).limit);
  EXPECT_EQ(budget_in(table, "log6", "linear", Region::beyond_pi).reason, "own.limits: why");
}

TEST(Limits, OfOneSubjectDoNotConcernAnother) {
  const auto own = limits("[limits]\n*, *, any, forward = 1e12\n", "liecheck:fast");
  for (const auto& s :
       select({{"liecheck", "liecheck:fast"}, {"exp_oracle"}, {"double"}, {own}}, built_in_robot()))
    EXPECT_EQ(s->budget(6, Region::to_pi).limit == 1e12, s->subject == "liecheck:fast");
}

struct Wrong {
  const char *lines, *message;
};
class WrongLimits : public testing::TestWithParam<Wrong> {};

TEST_P(WrongLimits, AreRefusedWithFileLineAndValue) {
  const std::string said = error([] { limits(GetParam().lines); });
  EXPECT_NE(said.find(GetParam().message), std::string::npos) << said;
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, WrongLimits,
    testing::Values(
        Wrong{"[limits]\nexp7, translation, to_pi, forward = 1", "own.limits:4: unknown operation 'exp7'"},
        Wrong{"[limits]\nexp6, shift, to_pi, forward = 1",
              "own.limits:4: unknown block 'shift'; known: *, rotation"},
        Wrong{"[limits]\n*, shift, to_pi, forward = 1", "own.limits:4: unknown block 'shift'"},
        Wrong{"[limits]\nexp6, translation, near_pi, forward = 1",
              "own.limits:4: unknown region 'near_pi'; known: to_pi"},
        Wrong{"[limits]\nexp6, translation, to_pi, backward = 1",
              "own.limits:4: unknown rule 'backward'; known: forward"},
        Wrong{"[limits]\nexp6, translation, to_pi, excess = 1",
              "own.limits:4: 'exp6, translation, to_pi, excess' names no limit"},
        Wrong{"[limits]\nexp6, translation, forward = 1",
              "own.limits:4: 'exp6, translation, forward' is not of the form"},
        Wrong{"[limits]\n\n# twice\n*, *, any, forward = 1\n *,*,any , forward = 2",
              "own.limits:7: '*, *, any, forward' is already in line 6"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward = -1",
              "own.limits:4: limit '-1' is not a positive"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward = 0", "own.limits:4: limit '0' is not a positive"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward = inf",
              "own.limits:4: limit 'inf' is not a positive"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward = nan",
              "own.limits:4: limit 'nan' is not a positive"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward = 1e999",
              "own.limits:4: limit '1e999' is not a positive"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward = 1e-999",
              "own.limits:4: limit '1e-999' is not a positive"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward =", "own.limits:4: limit '' is not a positive"},
        Wrong{"[limits]\nexp6, translation, to_pi, forward = 12 eps",
              "own.limits:4: limit '12 eps' is not a positive"},
        Wrong{"[limits]\nexp6, translation",
              "own.limits:4: 'exp6, translation' is not of the form NAME = VALUE"},
        Wrong{"[domain]\nexp7, angle = 3", "own.limits:4: unknown operation 'exp7'"},
        Wrong{"[domain]\n*, angel = 3", "own.limits:4: unknown quantity 'angel'; known: angle, translation"},
        Wrong{"[domain]\nexp6, force = 3", "own.limits:4: 'exp6, force' names nothing: exp6 takes no force"},
        Wrong{"[domain]\nact_point, angle = 3", "own.limits:4: 'act_point, angle' names nothing"},
        Wrong{"[domain]\n*, angle = -3", "own.limits:4: bound '-3' is not a positive"},
        Wrong{"[domain]\n*, angle, all = 3",
              "own.limits:4: '*, angle, all' is not of the form OPERATION, QUANTITY"},
        Wrong{"[domain]\n*, angle = 3\n*, angle = 2", "own.limits:5: 'domain *, angle' is already in line 4"},
        Wrong{"[domain]\n*, angle >= 1", "own.limits:4: a lower bound needs a line 'version = 3' before it"},
        Wrong{"[domain]\n*, angle = 3, why",
              "own.limits:4: the reason of a bound needs a line 'version = 3'"},
        Wrong{"[limit]\n", "own.limits:3: unknown section '[limit]'; known: [limits], [domain], [expected]"},
        Wrong{"[expected]\n", "own.limits:3: [expected] needs a line 'version = 2' before it"},
        Wrong{"author = me\n", "own.limits:3: unknown name 'author'"},
        Wrong{"profile = ours\n", "own.limits:3: profile needs a line 'version = 2' before it"},
        Wrong{"subject = other\n", "own.limits:3: 'subject' is already in line 2"},
        Wrong{"\x01\n", "own.limits:3: a control character"}, Wrong{"\xff\n", "own.limits:3: not UTF-8"}));

TEST(Limits, AreRefusedWithoutVersionOrSubject) {
  const auto said = [](const std::string& text) { return error([&] { parse_limits("f", text); }); };
  EXPECT_EQ(said(""), "f: has no line 'version = 3'");
  EXPECT_EQ(said("version = 1\n"), "f: names no subject: it has no line 'subject = NAME'");
  EXPECT_EQ(said("version = 4\n"), "f:1: version '4': this program reads versions 1 to 3");
  EXPECT_EQ(said("version = 1\nprofile = ours\n"), "f:2: profile needs a line 'version = 2' before it");
  EXPECT_EQ(said("subject = x\n[limits]\n"),
            "f:2: before section [limits] there must be a line 'version = 3'");
}

TEST(Limits, OfAnUnknownOrUnselectedSubjectOrTwiceAreRefused) {
  const auto said = [](const std::string& subject, std::vector<std::shared_ptr<const SubjectLimits>> all) {
    return error([&] { select({{subject}, {}, {}, std::move(all)}, built_in_robot()); });
  };
  EXPECT_EQ(said("liecheck", {limits("", "mylib")}),
            "own.limits:2: unknown subject 'mylib'; 'liecheck list' shows them");
  EXPECT_EQ(said("liecheck", {limits("", "textbook")}),
            "own.limits:2: subject 'textbook' is not selected: these limits judge nothing");
  EXPECT_EQ(said("liecheck", {limits(""), limits("")}),
            "own.limits:2: subject 'liecheck' has another limits file, too");
}

TEST(Domains, ExcludeInputsThatAreThenNeitherCalledNorJudged) {
  const CampaignResult all = run("limits:shy", nullptr),
                       own = run("limits:shy", limits("[domain]\n*, angle = 3\n", "limits:shy"));
  EXPECT_TRUE(all.failed);
  EXPECT_FALSE(own.failed);
  EXPECT_EQ(sum(own, block::translation, Region::beyond_pi, &Row::outside_domain),
            sum(own, block::translation, Region::beyond_pi, &Row::count));
  const std::uint64_t outside = sum(own, block::translation, Region::to_pi, &Row::outside_domain) +
                                sum(own, block::translation, Region::beyond_pi, &Row::outside_domain);
  EXPECT_GT(outside, 100u);
  EXPECT_EQ(own.series.at(0).tally.coverage.cases_outside(), outside);
  EXPECT_EQ(own.series.at(0).tally.coverage.cases(&MeasuredOutputs::outside, 6), outside);
  EXPECT_EQ(own.inputs_digest, all.inputs_digest);
}

TEST(Domains, MayBeginAboveZeroWhichTheyHave) {
  const auto own = std::make_shared<const SubjectLimits>(
      parse_limits("own.limits",
                   "version = 3\nsubject = liecheck\n[domain]\n*, angle >= 1e-3, tiny ones fail\n*, angle = "
                   "3\nexp6, angle >= 1e-5\n"));
  ASSERT_EQ(own->domain.size(), 3u);
  EXPECT_TRUE(own->domain[0].lower);
  EXPECT_EQ(own->domain[0].reason, "tiny ones fail");
  const CampaignResult r = run("liecheck", own);
  std::set<std::string> measured;
  const SeriesResult& s = r.series.at(0);
  for (const auto& [cell, row] : s.tally.rows)
    if (s.series->outputs.at(static_cast<std::size_t>(cell.first)).operation == "exp6" && row.judged() > 0)
      measured.insert(s.series->bands()[static_cast<std::size_t>(cell.second)].name);
  EXPECT_TRUE(measured.contains("0"));
  EXPECT_FALSE(measured.contains("subnormal"));
  EXPECT_FALSE(measured.contains("theta 1e-6..1e-5"));
  EXPECT_TRUE(measured.contains("theta 1e-5..1e-4"));
  EXPECT_FALSE(measured.contains("near 2pi k"));
  for (const char* again : {"*, angle >= 1\n*, angle >= 2", "*, angle = 1\n*, angle = 2"})
    EXPECT_NE(error([&] {
                parse_limits("f", fmt::format("version = 3\nsubject = x\n[domain]\n{}\n", again));
              }).find("is already in line 4"),
              std::string::npos);
}

TEST(Domains, AreNamedByTheCoverageReportWhichDoesNotMissTheirClasses) {
  const CampaignResult r =
      run("limits:shy", limits("[domain]\n*, angle = 3\n", "limits:shy"), "exp_oracle", 3000);
  EXPECT_TRUE(r.measured);
  const auto all = coverage_of(*r.series[0].series, r.series[0].tally);
  const std::string line = coverage_line(all, r.series[0].tally);
  EXPECT_NE(line.find(" of 3000 cases and "), std::string::npos) << line;
  EXPECT_NE(line.find("outside the subject's domain"), std::string::npos) << line;
}

TEST(Domains, ThatExcludeEveryInputLeaveTheCampaignIncomplete) {
  const CampaignResult r =
      run("limits:shy", limits("[domain]\n*, translation = 1e-320\n*, angle = 1e-320\n", "limits:shy"),
          "small_angle_branches");
  EXPECT_FALSE(r.failed);
  EXPECT_FALSE(r.measured);
  EXPECT_TRUE(r.undecided());
}

TEST(Domains, OfOneOperationLeaveTheOthersMeasured) {
  const CampaignResult r = run("liecheck", limits("[domain]\nexp6, translation = 1e-300\n"));
  std::uint64_t others = 0;
  for (const auto& [cell, row] : r.series.at(0).tally.rows) {
    if (r.series[0].series->outputs.at(static_cast<std::size_t>(cell.first)).operation == "exp6") continue;
    EXPECT_EQ(row.outside_domain, 0u);
    others += row.count;
  }
  EXPECT_EQ(others, 4u * 600);
  EXPECT_GT(sum(r, block::rotation, Region::to_pi, &Row::outside_domain), 100u);
}

TEST(Domains, LimitTheAngleOfALogarithmOrOfADifference) {
  for (const char* property : {"log_oracle", "integrate_difference", "d_integrate"}) {
    const CampaignResult r = run("liecheck", limits("[domain]\n*, angle = 1\n"), property, 200);
    const Series& s = *r.series.at(0).series;
    std::uint64_t outside = 0;
    for (const auto& [cell, row] : r.series[0].tally.rows) {
      const auto operation = s.outputs.at(static_cast<std::size_t>(cell.first)).operation;
      if (operation.find("_of_") != operation.npos) continue;  // needs two operations, each with its angle
      const Band& band = s.bands()[static_cast<std::size_t>(cell.second)];
      const bool beyond_one = band.region == Region::beyond_pi || band.axis == Axis::pi_minus_theta;
      if (beyond_one) {
        EXPECT_EQ(row.outside_domain, row.count) << property << " " << band.name;
      }
      if (band.axis == Axis::theta && band.high <= 1) {
        EXPECT_EQ(row.outside_domain, 0u) << property;
      }
      outside += row.outside_domain;
    }
    EXPECT_GT(outside, 50u) << property;
    EXPECT_FALSE(r.failed) << property;
  }
}

TEST(Domains, OfTreesAndRobotsExcludeWholeCases) {
  for (const auto& [property, bound] : {std::pair("lagrange", "joint position = 1"),
                                        std::pair("robot_configuration", "joint position = 200")}) {
    const auto own = limits(fmt::format("[domain]\n*, {}\n", bound));
    const CampaignResult r = run("liecheck", own, property, 60);
    std::uint64_t outside = 0, judged = 0;
    for (const auto& [cell, row] : r.series.at(0).tally.rows)
      outside += row.outside_domain, judged += row.inside();
    EXPECT_GT(outside, 0u) << property;
    EXPECT_GT(judged, 0u) << property;
  }
}

TEST(LimitsRecords, NameTheFileAndItsHash) {
  const auto own = limits("[limits]\n*, *, any, forward = 50, mine\n[domain]\n*, angle = 3\n");
  const auto record = record_of(StoredRun{run("liecheck", own, "exp_oracle", 100), {}, {}});
  EXPECT_EQ(record["subjects"][0]["limits"], "own.limits");
  EXPECT_EQ(record["subjects"][0]["limits_hash"], hash_of(*own));
  bool outside = false;
  for (const auto& row : record["results"]) {
    EXPECT_TRUE(row["rule"] != "forward" || row["budget"] == 50);
    if (row["outside_domain"] != row["count"]) continue;
    outside = true;
    EXPECT_EQ(row["status"], "empty");
    EXPECT_TRUE(row["worst"].is_null());
  }
  EXPECT_TRUE(outside);
}

class LimitsInStores : public testing::Test {
 protected:
  const std::filesystem::path folder = own_folder();

  std::string store(const std::string& name, std::shared_ptr<const SubjectLimits> own, unsigned shard = 1,
                    bool resume = false) const {
    CampaignOptions o = options("liecheck", std::move(own), "exp_oracle", 60);
    o.shard = shard, o.shards = 2;
    const std::string file = (folder / name).string();
    Store to(file, Store::Open::create);
    run_stored(o, built_in_robot(), to, resume);
    return file;
  }
};

TEST_F(LimitsInStores, AreKeptWithTheirTextAndJudgeTheLoadedCampaign) {
  const auto own = limits("[limits]\nexp6, translation, to_pi, forward = 1e-3\n[domain]\n*, angle = 3\n");
  const StoredCampaign c = load_campaign(store("a", own));
  ASSERT_EQ(c.spec.limits.size(), 1u);
  EXPECT_EQ(c.spec.limits[0]->text, own->text);
  EXPECT_EQ(c.spec.limits[0]->file, "own.limits");
  const StoredRun r = result_of(c, "a");
  EXPECT_EQ(r.result.series.at(0).series->budget(6, Region::to_pi).limit, 1e-3);
  EXPECT_GT(sum(r.result, block::translation, Region::beyond_pi, &Row::outside_domain), 0u);
}

TEST_F(LimitsInStores, ThatDifferAreNeitherMergedNorComparedNorResumed) {
  const auto own = limits("[limits]\n*, *, any, forward = 50\n"),
             other = limits("[limits]\n*, *, any, forward = 51\n");
  const std::string a = store("a", own), b = store("b", other, 2), c = store("c", nullptr, 2);
  const std::string words = fmt::format("limits of liecheck: own.limits ({}) against ", hash_of(*own));
  for (const std::string& with : {b, c}) {
    EXPECT_NE(error([&] { merge({a, with}, false); }).find(words), std::string::npos);
    EXPECT_NE(error([&] { compared(load_campaign(a), load_campaign(with)); }).find(words), std::string::npos);
  }
  EXPECT_NE(error([&] { store("a", nullptr, 1, true); }).find(words + "none"), std::string::npos);
  EXPECT_EQ(error([&] { merge({a, store("d", own, 2)}, false); }), "");
}

TEST(Limits, OfAHundredMegabytesAreRefusedBeforeTheyAreRead) {
  const std::string file = liecheck::scratch() + "large.limits";
  std::ofstream(file) << "version = 1\n";
  std::filesystem::resize_file(file, 100'000'000);
  EXPECT_EQ(error([&] { read_limits(file); }), file + ": cannot be read: longer than 4194304 bytes");
}

TEST_F(LimitsInStores, TheProgramJudgesReplaysAndReportsByTheSameFile) {
  const std::string file = (folder / "it's own.limits").string();
  write_whole(file,
              "version = 1\nsubject = liecheck\n[limits]\nexp6, translation, to_pi, forward = 1e-3, mine\n");
  const auto code = [&](const std::string& arguments) {
    return shell("cd '" + folder.string() + "'; '" LIECHECK_PROGRAM "' " + arguments + " >out 2>err").code;
  };
  const std::string flag = " --limits \"it's own.limits\"";
  const std::string campaign =
      "campaign --property exp_oracle --scalar double --cases 50 -j 1 --no-hard-cases";
  EXPECT_EQ(code(campaign), 0);
  EXPECT_EQ(code(campaign + flag + " --store s"), 1);
  const std::string out = read_whole(folder / "out");
  const auto at = out.find("  replay   ");
  ASSERT_NE(at, std::string::npos) << out;
  const std::string replay = out.substr(at + 11, out.find('\n', at) - at - 11);
  EXPECT_NE(replay.find(" --limits 'it'\\''s own.limits'"), std::string::npos) << replay;
  EXPECT_EQ(code(replay.substr(std::string("liecheck ").size())), 1);
  EXPECT_EQ(code(replay.substr(std::string("liecheck ").size(), replay.find(" --limits") - 9)), 0);
  EXPECT_EQ(
      code("hunt --subject liecheck --op exp6 --block translation --property exp_oracle --evaluations 200" +
           flag),
      1);
  EXPECT_EQ(code("hard-cases --property exp_oracle --scalar double" + flag), 1);
  EXPECT_EQ(code("hard-cases --property exp_oracle --scalar double"), 0);
  EXPECT_EQ(code(campaign + " --limits none.limits"), 2);
  EXPECT_NE(read_whole(folder / "err").find("none.limits: "), std::string::npos);
  EXPECT_EQ(code("report s --out r"), 0);
  EXPECT_EQ(code("report s" + flag), 2);
}

}  // namespace
}  // namespace liecheck::properties
