// What `compare` calls worse, better and neither, its exit codes, and the comment that it writes.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <store/comment.hpp>
#include <store/store.hpp>
#include <support/files.hpp>
#include <support/markdown.hpp>

#include "../campaigns.hpp"
#include "../own_subject.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"
#include "../stored.hpp"

namespace liecheck::properties {
namespace {

#define EXPECT_SAYS(what, words) EXPECT_NE((what).find(words), std::string::npos) << (what)

using V6 = Vec<double, 6>;
using Operations = TypedOperations<double>;

double turn(const V6& xi) {
  return xi.tail<3>().stableNorm();
}

/// exp6 with a translation that is too long by so many eps.
template <double (*eps)(const V6&, const Pose<double>&)>
Pose<double> exp6(const V6& xi) {
  Pose<double> T = own_subject().operations[op::exp6](xi);
  if (const double n = eps(xi, T); n != 0) T.p *= 1 + n * 0x1p-52;
  return T;
}
template <int eps>
double everywhere(const V6&, const Pose<double>&) {
  return eps;
}
double in_half_the_cases(const V6&, const Pose<double>& T) {
  return std::bit_cast<std::uint64_t>(T.p.x()) & 1 ? 1 : 0;
}
double nan_at_pi(const V6& xi, const Pose<double>&) {
  return std::abs(turn(xi) - M_PI) < 0.1 ? NAN : 0;
}
double always_nan(const V6&, const Pose<double>&) {
  return NAN;
}
double in_a_band(const V6& xi, const Pose<double>&) {
  return turn(xi) > 1e-8 && turn(xi) < 1e-7 ? 1e5 : 0;
}
Pose<double> own_exp6(const V6& xi) {
  return own_subject().operations[op::exp6](xi);
}

const auto as_it_is = registered("compare:as_it_is", op::exp6, own_exp6),
           by_four = registered("compare:by_four", op::exp6, exp6<everywhere<4>>),
           by_forty = registered("compare:by_forty", op::exp6, exp6<everywhere<40>>),
           by_a_hundred = registered("compare:by_a_hundred", op::exp6, exp6<everywhere<100>>),
           by_102 = registered("compare:by_102", op::exp6, exp6<everywhere<102>>),
           flags = registered("compare:flags", op::exp6, exp6<in_half_the_cases>),
           nan = registered("compare:nan", op::exp6, exp6<nan_at_pi>),
           only_nan = registered("compare:only_nan", op::exp6, exp6<always_nan>),
           cliff = registered("compare:cliff", op::exp6, exp6<in_a_band>),
           with_log = registered("compare:with_log",
                                 [](Operations&o) {
                                   o[op::exp6] = own_exp6;
                                   o[op::log6] = own_subject().operations[op::log6];
                                 }),
           other_branch = registered("compare:other_branch", [](Operations&o) {
             o[op::exp6] = own_exp6;
             o[op::log6] = [](const Pose<double>& T) {
               V6 xi = own_subject().operations[op::log6](T);
               if (const double theta = turn(xi); theta > 3) xi.tail<3>() *= 1 - 2 * M_PI / theta;
               return xi;
             };
           });

/// One campaign: which library, and how it was run.
struct Ran {
  const char* library;
  std::uint64_t seed = 42, cases = 600;
  const char* name = "mylib";  ///< the subject in the store
};
StoredCampaign campaign(const Ran& ran, Profile profile, const std::string& lines = "") {
  CampaignOptions o = quiet({{ran.library}, {"exp_oracle", "log_oracle"}, {"double"}}, ran.cases, 2);
  o.seed = ran.seed, o.selection.profiles[""] = profile;
  if (!lines.empty())
    o.selection.limits = {std::make_shared<const SubjectLimits>(
        parse_limits("own.limits", fmt::format("version = 2\nsubject = {}\n{}", ran.library, lines)))};
  StoredCampaign c = stored_from(run_campaign(o, built_in_robot()));
  for (StoredSeries& s : c.series) s.subject = ran.name, s.subject_version = "1";
  for (auto& own : c.spec.limits) {
    SubjectLimits renamed = *own;
    renamed.subject = ran.name;
    own = std::make_shared<const SubjectLimits>(renamed);
  }
  return c;
}

struct ChangeOfALibrary {
  const char* name;
  Ran before, after;
  int code, strict;          ///< exit codes
  const char* comment = "";  ///< what it says
  Profile profile = Profile::careful;
};

class ChangesOfALibrary : public testing::TestWithParam<ChangeOfALibrary> {};

TEST_P(ChangesOfALibrary, HaveTheExitCodeThatItsMaintainerExpects) {
  const auto& [name, before, after, code, strict, words, profile] = GetParam();
  const std::string dir = own_folder(), program = "cd " + dir + "; '" LIECHECK_PROGRAM "' compare a b ";
  for (const auto& [file, ran] : {std::pair("a", before), std::pair("b", after)})
    Store(dir + file, Store::Open::create).write(campaign(ran, profile), false, {});
  const Answer said = shell(program + "--markdown m.md --json r.json --picture p.svg");
  EXPECT_EQ(said.code, code) << said.text;
  EXPECT_EQ(shell(program + "--strict").code, strict);
  const std::string comment = read_whole(dir + "m.md");
  EXPECT_SAYS(comment, words);
  EXPECT_LE(comment.size(), 60000u);
  const auto record = nlohmann::json::parse(read_whole(dir + "r.json"));
  EXPECT_EQ(record["verdict"], code == 1 ? "fail" : code == 0 ? "pass" : "incomplete");
  EXPECT_EQ(record["worse"].empty(), code != 1);
  for (const char* list : {"worse", "better", "other"})  // the same words in each medium
    if (!record[list].empty()) {
      const auto what = record[list][0]["what"].get<std::string>();
      EXPECT_SAYS(comment, markdown(what));
      if (list == std::string("worse")) {
        EXPECT_SAYS(said.text, what);
      }
    }
}

const Ran base{"compare:as_it_is"};
INSTANTIATE_TEST_SUITE_P(
    Each, ChangesOfALibrary,
    testing::Values(
        ChangeOfALibrary{"Nothing", base, base, 0, 0, "### liecheck: nothing is worse\n"},
        ChangeOfALibrary{"AFix", {"compare:by_a_hundred"}, base, 0, 0, "What got better"},
        ChangeOfALibrary{
            "OneConstant", base, {"compare:by_forty"}, 1, 1, " and 43 more | exp_oracle | largest error "},
        ChangeOfALibrary{"AGrowthFarFromTheLimit", base, {"compare:by_four"}, 0, 1, "differ by less"},
        ChangeOfALibrary{"AFailureALittleWorse", {"compare:by_a_hundred"}, {"compare:by_102"}, 0, 0},
        ChangeOfALibrary{"OtherFlags", base, {"compare:flags"}, 0, 1, "differ by less"},
        ChangeOfALibrary{"AnotherSeed", {"textbook", 42}, {"textbook", 7}, 0, 0, "nothing is worse\n"},
        ChangeOfALibrary{"AnotherSeedAndOneConstant", base, {"compare:by_forty", 7}, 1, 1, "error"},
        ChangeOfALibrary{"MoreCases", {"textbook"}, {"textbook", 42, 2000}, 0, 0, "nothing is worse\n"},
        ChangeOfALibrary{"AnotherName",
                         base,
                         {"compare:as_it_is", 42, 600, "mylib2"},
                         3,
                         3,
                         "have no cell with a verdict in common"},
        ChangeOfALibrary{"OneMoreOperation",
                         base,
                         {"compare:with_log"},
                         0,
                         0,
                         "is worse, measured for the first time: log6"},
        ChangeOfALibrary{
            "OneMoreOperationThatFails", base, {"compare:other_branch"}, 1, 1, "failed: not measured → "},
        ChangeOfALibrary{
            "OneOperationLess", {"compare:with_log"}, base, 0, 1, "is worse, no longer measured: log6"},
        ChangeOfALibrary{"NaNAtPi", base, {"compare:nan"}, 1, 1, "NaN or Inf: 0 of "},
        ChangeOfALibrary{"NoMoreNaNAtPi", {"compare:nan"}, {"compare:by_forty"}, 1, 1, "largest error "},
        ChangeOfALibrary{
            "OnlyNaNBefore", {"compare:only_nan"}, {"compare:by_forty"}, 0, 0, "What got better"},
        ChangeOfALibrary{
            "AnotherBranch", {"compare:with_log"}, {"compare:other_branch"}, 1, 1, "wrong branch: 0 of "},
        ChangeOfALibrary{"ACliff",
                         {"compare:as_it_is", 42, 10000},
                         {"compare:cliff", 42, 10000},
                         1,
                         1,
                         "cliff: none → ",
                         Profile::half}),
    [](const auto& info) { return info.param.name; });

TEST(Comparisons, CountNoFailureThatTheLimitsFileExpects) {
  const std::string expected = "[expected]\nexp6, translation, any = known, https://issues/1\n";
  for (const std::string& lines : {expected, std::string("[limits]\nexp6, rotation, any, forward = 64\n")}) {
    StoredCampaign a = campaign(base, Profile::careful, lines), b = a;
    for (auto& [cell, row] : b.series.at(0).tally.rows)
      if (b.series[0].labels.at(cell).block == "translation") row.failed += 3, row.not_finite += 3;
    EXPECT_EQ(compared(a, b).worse.empty(), lines == expected);
    EXPECT_FALSE(compared(a, b).other.empty() && lines == expected);
  }
}

/// The differences of a row from one with an error of 100 eps.
Comparison changed(const StoredCampaign& a, const std::function<void(Row&)>& change, bool strict = false) {
  StoredCampaign b = a;
  change(b.series.at(0).tally.rows.begin()->second);
  return compared(a, b, strict);
}

TEST(Comparisons, CallWorseWhatUsesUpAQuarterOfTheLimitAndStrictlyWhatIsNoRounding) {
  StoredCampaign a = campaign(base, Profile::careful);
  Row& row = a.series.at(0).tally.rows.begin()->second;
  const auto worse = [&](double from, double to, bool strict = false) {
    row.max_error = from, row.max_excess = 0;
    return changed(
               a, [&](Row& r) { r.max_error = to; }, strict)
        .worse.size();
  };
  EXPECT_EQ(worse(1, 16.9), 0u);  // the limit is 64
  EXPECT_EQ(worse(1, 17.1), 1u);
  EXPECT_EQ(worse(20, 39.9), 0u);
  EXPECT_EQ(worse(20, 40.1), 1u);
  EXPECT_EQ(worse(1e14, 1.9e14), 0u);
  EXPECT_EQ(worse(1e13, 1e14), 1u);
  EXPECT_EQ(worse(1e15, 1e16), 0u);  // no digit is right in either
  EXPECT_EQ(worse(100, 109, true), 0u);
  EXPECT_EQ(worse(100, 111, true), 1u);
  EXPECT_EQ(worse(0.2, 0.69, true), 0u);
  EXPECT_EQ(worse(0.2, 0.71, true), 1u);
}

TEST(Comparisons, DoNotJudgeAnExcessOfWhichOnlyABoundIsKnown) {
  StoredCampaign a = campaign(base, Profile::careful);
  Row& first = a.series.at(0).tally.rows.begin()->second;
  first.max_excess = 4.6;
  // Below half the limit, kappa is not computed.
  const Comparison below = changed(
      a, [](Row& r) { r.max_excess = 31.4; }, true);
  EXPECT_TRUE(below.worse.empty() && below.better.empty());
  EXPECT_EQ(changed(
                a, [](Row& r) { r.max_excess = 33; }, true)
                .worse.size(),
            1u);
}

TEST(Comparisons, DoNotCallErrorsBetterThatAreNaNNow) {
  const StoredCampaign a = campaign(base, Profile::careful);
  const Comparison all = changed(a, [](Row& r) {
    r.not_finite = r.failed = r.count, r.errors = Histogram(), r.max_error = r.max_excess = 0;
  });
  EXPECT_EQ(all.worse.size(), 1u);
  EXPECT_TRUE(all.better.empty());
}

TEST(Comparisons, FindWhatTheProbeAndTheHardCasesFind) {
  StoredCampaign a = campaign(base, Profile::careful), b = a;
  b.spec.beside.probed = {{"mylib", "exp6", "the order is another", false},
                          {"mylib", "log6", "no one knows", false}};
  a.spec.beside.corpus = b.spec.beside.corpus = "1";
  b.spec.beside.failed = {{"mylib", "double", "angle_1e15", "exp6", "rotation", "bad call"}};
  const std::string dir = own_folder();
  for (const auto& [file, c] : {std::pair("a", a), std::pair("b", b)})
    Store(dir + file, Store::Open::create).write(c, false, {});
  const Answer said = shell("cd " + dir + "; '" LIECHECK_PROGRAM "' compare a b");
  EXPECT_EQ(said.code, 1) << said.text;
  EXPECT_TRUE(said.text.starts_with(
      "mylib: exp6: judged: yes → no: the order is another\n"
      "mylib double: exp6, rotation, hard case angle_1e15: verdict: passed → bad call\n"))
      << said.text;
  EXPECT_SAYS(said.text, "\nincomplete: not judged in b: no one knows; 2 cells are worse");
  const Answer back = shell("cd " + dir + "; '" LIECHECK_PROGRAM "' compare b a");
  EXPECT_EQ(back.code, 0) << back.text;
  EXPECT_SAYS(back.text, "nothing is worse, 2 cells are better");
  b.spec.beside.corpus = "2";  // other hard cases
  EXPECT_EQ(compared(a, b).worse.size(), 1u);
}

TEST(Comparisons, CallAFailureNewBesideAnotherOnlyIfItsErrorGrew) {
  StoredCampaign a = campaign(base, Profile::careful);
  auto& rows = a.series.at(0).tally.rows;
  const auto first = rows.begin(), second = std::next(first);
  ASSERT_EQ(a.series[0].labels.at(first->first).block, a.series[0].labels.at(second->first).block);
  first->second.max_error = 63.9, first->second.max_excess = 0;
  const auto slightly = [](Row& r) { r.failed = 1, r.max_error = 64.1; };
  EXPECT_EQ(changed(a, slightly).worse.size(), 1u);
  second->second.failed = 5;
  EXPECT_EQ(changed(a, slightly).worse.size(), 0u);
  EXPECT_EQ(changed(a, slightly).other.size(), 1u);
  EXPECT_EQ(changed(a, [](Row& r) { r.failed = 1, r.max_error = 80; }).worse.size(), 1u);
}

TEST(Comparisons, OfStoresFindEachDifferenceStrictly) {
  const StoredCampaign a = campaign(base, Profile::careful);
  const auto one_is_worse = [&](const std::function<void(Row&)>& change) {
    const Comparison all = changed(a, change, true), less = changed(a, change);
    return all.worse.size() == 1 && all.better.empty() && less.worse.empty() && less.other.size() == 1;
  };
  EXPECT_TRUE(one_is_worse([](Row& r) { r.count -= 1; }));
  EXPECT_TRUE(one_is_worse([](Row& r) { r.unresolved += 1; }));
  EXPECT_TRUE(one_is_worse([](Row& r) { r.ill_posed += 1; }));
  EXPECT_TRUE(one_is_worse([](Row& r) { r.unmeasured += 1; }));
  StoredCampaign b = a;
  b.series.at(0).tally.rows.erase(b.series.at(0).tally.rows.begin());
  EXPECT_EQ(compared(a, b, true).worse.size(), 1u);
  EXPECT_TRUE(compared(b, a, true).worse.empty());
}

TEST(Comparisons, ReadBeforeAndThenAfterWhateverGotBetter) {
  StoredCampaign a = campaign(base, Profile::careful), b = a;
  Row &first = b.series.at(0).tally.rows.begin()->second,
      &second = std::prev(a.series.at(0).tally.rows.end())->second;
  first.failed += 1, second.failed += 2;
  const Comparison all = compared(a, b);
  ASSERT_EQ(all.worse.size(), 1u);
  ASSERT_EQ(all.better.size(), 1u);
  EXPECT_EQ(all.worse[0].what, fmt::format("failed: 0 of {0} → 1 of {0}", first.count));
  EXPECT_EQ(all.better[0].what, fmt::format("failed: 2 of {0} → 0 of {0}", second.count));
  const std::string comment = in_markdown(all, {cells_in_both(a, b), "p.svg", nullptr});
  EXPECT_SAYS(comment,
              "### liecheck: 1 cell is worse, 1 cell is better\n\n![what got worse and better](<p.svg>)\n");
  EXPECT_SAYS(comment, "| worse | operation, block, band | law | before → after |\n");
  EXPECT_SAYS(comment, "| better | operation, block, band | law | before → after |\n");
  EXPECT_SAYS(comment, "```sh\nliecheck replay g4.42.");
  const std::string nothing = in_markdown(compared(a, a), {1});
  EXPECT_SAYS(nothing, "### liecheck: nothing is worse\n");
  EXPECT_EQ(nothing.find('|'), nothing.npos) << nothing;
}

TEST(Comparisons, OfManyCellsAreAShortCommentThatBeginsWithTheWorst) {
  Comparison all;
  const std::string long_text(300, 'x');
  for (auto* list : {&all.worse, &all.better, &all.other})
    for (int i = 0; i < 1000; ++i)
      list->push_back(
          {{"mylib", "double", "exp_oracle", "exp6", fmt::format("block {}", i), "all"}, long_text, ""});
  const std::string comment = in_markdown(all, {3000, "", nullptr});
  EXPECT_LE(comment.size(), 60000u);
  EXPECT_GT(comment.size(), 50000u);
  EXPECT_SAYS(comment,
              "### liecheck: 1000 cells are worse, 1000 cells are better, 1000 cells differ by less");
  std::size_t at = 0;
  for (const char* part :
       {"block 0,", "block 50,", " more | | | |", "What got better", "block 0,", " more | | | |",
        "What differs by less", "block 0,", " more | | | |", "</details>", "Compared in 3000 cells"}) {
    at = comment.find(part, at);
    ASSERT_NE(at, comment.npos) << part << "\n" << comment;
  }
}

TEST(Comparisons, DoNotMistakeOtherInputsForOtherCode) {
  std::vector<StoredCampaign> seeds;
  for (const std::uint64_t seed : {42, 7, 11})
    for (const char* library : {"liecheck", "textbook"})
      seeds.push_back(campaign({library, seed, 1000, library}, Profile::ours));
  for (const StoredCampaign& a : seeds)
    for (const StoredCampaign& b : seeds) {
      if (a.series.at(0).subject != b.series.at(0).subject) continue;
      for (const Change& c : compared(a, b, true).worse) ADD_FAILURE() << c.text();
    }
}

TEST(Comparisons, OfOtherInputsFindAnErrorThatGrewFourfoldInOneBlock) {
  const StoredCampaign a = campaign({"liecheck", 42, 300}, Profile::ours);
  StoredCampaign b = campaign({"liecheck", 7, 300}, Profile::ours);
  StoredSeries& s = b.series.at(0);
  const std::string block = s.labels.at(s.tally.rows.begin()->first).block;
  for (auto& [cell, row] : s.tally.rows) {
    if (cell.first != s.tally.rows.begin()->first.first) continue;
    Histogram grown;
    for (const auto& [bin, count] : row.errors.bins())
      grown.add_bin(bin < -9000 ? bin : bin + 2 * 32, count);  // not an exact zero
    row.errors = grown;
    row.max_error *= 4;
  }
  for (const bool strict : {true, false}) {
    const auto worse = compared(a, b, strict).worse;
    EXPECT_FALSE(worse.empty()) << strict;
    for (const Change& c : worse) EXPECT_EQ(c.name[4], block);
  }
  EXPECT_TRUE(compared(b, a, true).worse.empty());
}

TEST(Comparisons, OfOtherInputsFindErrorsAboveTheLargestOfBefore) {
  const StoredCampaign a = campaign({"liecheck", 42}, Profile::ours),
                       other = campaign({"liecheck", 7}, Profile::ours);
  const auto with = [&](std::uint64_t large) {
    StoredCampaign b = other;
    b.series.at(0).tally.rows.begin()->second.errors.add_bin(32 * 40, large);
    return compared(a, b).worse;
  };
  EXPECT_TRUE(with(5).empty());
  EXPECT_EQ(with(60).size(), 1u);
}

}  // namespace
}  // namespace liecheck::properties
