// Whose limits judge a subject: profiles, failures that a limits file expects, and a first file.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <campaign/cliffs.hpp>
#include <campaign/expected.hpp>
#include <cmath>
#include <failures/promises.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
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

/// exp6 of liecheck with a translation that is too long by so many eps.
template <int eps>
TypedSubject<double> longer(const std::string& name) {
  TypedSubject<double> s;
  s.name = name;
  s.operations[op::exp6] = [](const V6& xi) {
    Pose<double> T = own_subject().operations[op::exp6](xi);
    T.p *= 1 + eps * 0x1p-52;
    return T;
  };
  return s;
}
const Registered<double> by_thirty(longer<30>("promises:thirty")),
    by_a_million(longer<1000000>("promises:million"));
/// Euler angles of liecheck, with an error of a millionth near gimbal lock and where the middle angle is 0.
const Registered<double> at_gimbal_lock =
    registered("promises:gimbal", op::euler_from_matrix, [](const double& order, const Mat<double, 3, 3>& R) {
      auto angles = own_subject().operations[op::euler_from_matrix](order, R);
      const double lock = std::fabs(std::sin(2 * angles[1]));
      if (lock > 1e-9 && lock < 1e-6) angles[0] += 1e-6;
      return angles;
    });
const bool outside = [] {
  Subject s = erased(longer<30>("promises:outside"));
  s.adapter = "a command";
  register_subject(std::move(s));
  return true;
}();

std::shared_ptr<const SubjectLimits> limits(const std::string& subject, const std::string& lines) {
  return std::make_shared<const SubjectLimits>(
      parse_limits("own.limits", "version = 2\nsubject = " + subject + "\n" + lines));
}

CampaignOptions options(const std::string& subject, std::optional<Profile> profile,
                        std::shared_ptr<const SubjectLimits> own = nullptr, std::uint64_t cases = 300) {
  CampaignOptions o = quiet({{subject}, {"exp_oracle"}, {"double"}}, cases, 2);
  if (own) o.selection.limits = {std::move(own)};
  if (profile) o.selection.profiles[""] = *profile;
  return o;
}
CampaignResult run(const std::string& subject, std::optional<Profile> profile,
                   std::shared_ptr<const SubjectLimits> own = nullptr, std::uint64_t cases = 300) {
  return run_campaign(options(subject, profile, std::move(own), cases), built_in_robot());
}

/// The message of the exception that f throws, or "".
std::string error(const auto& f) {
  return test::refusal<std::exception>(f);
}

TEST(Profiles, KeepTheRuleOfEachLineAndNoLimitOfItsOwn) {
  for (const double eps : {0x1p-23, 0x1p-52}) {
    const auto &ours = budgets("liecheck:fast", Profile::ours, eps),
               &careful = budgets("liecheck:fast", Profile::careful, eps),
               &half = budgets("liecheck:fast", Profile::half, eps);
    EXPECT_EQ(&ours, &budgets("liecheck:fast"));
    for (const Region region : {Region::to_pi, Region::beyond_pi})
      for (const Budget& b : ours) {
        if (b.region == "beyond_pi" && region == Region::to_pi) continue;
        if (b.region == "to_pi" && region == Region::beyond_pi) continue;
        const Budget &c = budget_in(careful, b.operation, b.block, region),
                     &h = budget_in(half, b.operation, b.block, region);
        EXPECT_EQ(c.rule, b.rule);
        EXPECT_EQ(h.rule, b.rule);
        EXPECT_EQ(c.limit, 64);
        EXPECT_DOUBLE_EQ(h.limit * eps, std::sqrt(eps));
      }
  }
}

TEST(Profiles, JudgeTheSameErrorDifferently) {
  EXPECT_TRUE(run("promises:thirty", Profile::ours).failed);
  EXPECT_FALSE(run("promises:thirty", Profile::careful).failed);
  EXPECT_TRUE(run("promises:million", Profile::careful).failed);
  EXPECT_FALSE(run("promises:million", Profile::half).failed);
}

TEST(Profiles, AreThoseOfTheUserThenOfTheFileThenOfTheKindOfSubject) {
  const auto of = [](const std::string& subject, std::optional<Profile> profile, const std::string& lines) {
    const auto all = select(options(subject, profile, limits(subject, lines)).selection, built_in_robot());
    return all.at(0)->profile;
  };
  for (const std::string subject : {"promises:thirty", "promises:outside"}) {
    EXPECT_EQ(of(subject, std::nullopt, ""),
              subject == "promises:outside" ? Profile::careful : Profile::ours);
    EXPECT_EQ(of(subject, std::nullopt, "profile = half\n"), Profile::half);
    EXPECT_EQ(of(subject, Profile::ours, "profile = half\n"), Profile::ours);
  }
}

TEST(Profiles, JudgeWhatALimitsFileDoesNotName) {
  const auto own =
      limits("promises:thirty", "profile = careful\n[limits]\nexp6, translation, to_pi, forward = 7\n");
  const auto all = select(options("promises:thirty", std::nullopt, own).selection, built_in_robot());
  EXPECT_EQ(all.at(0)->budget(6, Region::to_pi).limit, 7);
  EXPECT_EQ(all.at(0)->budget(6, Region::beyond_pi).limit, 64);
}

TEST(Profiles, AreInTheFlagsOfAReplayUnlessTheyAreUsual) {
  const auto flags = [](const std::string& subject, std::optional<Profile> profile) {
    return subject_flags(*select(options(subject, profile).selection, built_in_robot()).at(0));
  };
  EXPECT_EQ(flags("promises:thirty", Profile::ours), "");
  EXPECT_EQ(flags("promises:thirty", Profile::careful), " --profile careful");
  EXPECT_EQ(flags("promises:outside", std::nullopt), " --adapter 'a command'");
  EXPECT_EQ(flags("promises:outside", Profile::ours), " --adapter 'a command' --profile ours");
}

class Promises : public testing::Test {
 protected:
  const std::filesystem::path folder = own_folder();

  std::string store(const std::string& name, std::optional<Profile> profile, unsigned shard = 1,
                    bool resume = false) const {
    CampaignOptions o = options("promises:thirty", profile);
    o.shard = shard, o.shards = 2;
    const std::string file = (folder / name).string();
    Store to(file, Store::Open::create);
    run_stored(o, built_in_robot(), to, resume);
    return file;
  }
  /// The worst error that a hunt printed [eps].
  static double found(const std::string& text) {
    const auto at = text.find("  worst     ");
    return at == text.npos ? 0 : std::stod(text.substr(at + 12));
  }
  /// Runs the program in the folder and returns its exit code.
  int code(const std::string& arguments) const {
    return shell("cd '" + folder.string() + "'; '" LIECHECK_PROGRAM "' " + arguments + " >out 2>err").code;
  }
  std::string out() const { return read_whole(folder / "out"); }
};

TEST_F(Promises, ByDifferentProfilesAreNeitherMergedNorComparedNorResumed) {
  const std::string a = store("a", Profile::careful), b = store("b", std::nullopt, 2);
  EXPECT_NE(error([&] { merge({a, b}, false); }).find("profile careful"), std::string::npos);
  EXPECT_NE(error([&] { store("a", std::nullopt, 1, true); }).find("profile careful"), std::string::npos);
  EXPECT_NE(error([&] {
              compared(load_campaign(a), load_campaign(b));
            }).find("profile of promises:thirty: careful against ours"),
            std::string::npos);
  EXPECT_EQ(error([&] { merge({b, store("c", Profile::ours)}, false); }), "");
  const StoredRun loaded = result_of(load_campaign(a), "a");
  EXPECT_FALSE(loaded.result.failed);
  EXPECT_EQ(loaded.result.series.at(0).series->profile, Profile::careful);
  EXPECT_EQ(record_of(loaded)["subjects"][0]["profile"], "careful");
}

TEST_F(Promises, AreTheSameForEachCommandOfTheProgram) {
  const std::string campaign =
      "campaign --subject correct:quaternions --property exp_oracle --scalar double "
      "--cases 300 -j 1 --no-hard-cases";
  EXPECT_EQ(code(campaign), 1);
  const std::string text = out();
  const auto at = text.find("  replay   liecheck ");
  ASSERT_NE(at, std::string::npos) << text;
  const std::string replay = text.substr(at + 20, text.find('\n', at) - at - 20);
  EXPECT_EQ(code(replay), 1);
  EXPECT_EQ(code(replay + " --profile careful"), 0);
  EXPECT_EQ(code(campaign + " --verbose --profile careful"), 0);
  EXPECT_NE(out().find("profile of correct:quaternions: careful\n"), std::string::npos) << out();
  EXPECT_EQ(code(campaign + " --profile gentle"), 2);
  const std::string hunt =
      "hunt --subject correct:quaternions --op exp6 --block 'orthogonality defect' "
      "--property exp_oracle --evaluations 2000";
  EXPECT_EQ(code(hunt), 1);
  EXPECT_EQ(code(hunt + " --profile careful"), 0);
  const std::string hard = "hard-cases --subject correct:quaternions --property pose_group --scalar double";
  EXPECT_EQ(code(hard), 1);
  EXPECT_EQ(code(hard + " --profile careful"), 0);
}

const char* const translation_expected =
    "[expected]\nexp6, translation, any = too long, by thirty eps, https://issues/1\n";

TEST(Profiles, FindNoCliffInASubjectThatIsInaccurateEverywhere) {
  for (const auto& [series, tally] : run("promises:million", Profile::half, nullptr, 8000).series)
    EXPECT_EQ(cliffs_of(*series, tally).size(), 0u) << series->subject;
}

TEST(ExpectedFailures, AreNoneOfTheVerdictAndAreSaid) {
  EXPECT_TRUE(run("promises:thirty", Profile::ours).failed);
  const CampaignResult r =
      run("promises:thirty", Profile::ours, limits("promises:thirty", translation_expected));
  EXPECT_FALSE(r.failed);
  const auto all = expectations_of(r);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_FALSE(all[0].passed());
  EXPECT_EQ(text_of(all[0]),
            fmt::format("expected failure: promises:thirty, exp6 translation at any: {} of {} cases: "
                        "too long, by thirty eps (https://issues/1)",
                        all[0].failed, all[0].measured));
  const auto record = record_of(StoredRun{
      run("promises:thirty", Profile::ours, limits("promises:thirty", translation_expected)), {}, {}});
  EXPECT_EQ(record["verdict"], r.measured ? "pass" : "incomplete");
  EXPECT_EQ(record["expected"][0]["failed"], all[0].failed);
  EXPECT_TRUE(
      std::ranges::any_of(record["results"], [](const auto& row) { return row["status"] == "expected"; }));
}

TEST(ExpectedFailures, ElsewhereAreFailures) {
  for (const char* region : {"theta 1e-9..1e-3", "to_pi", "beyond_pi", "pi-theta 0..1", "pi"}) {
    const auto own =
        limits("promises:thirty", fmt::format("[expected]\nexp6, translation, {} = w, l\n", region));
    EXPECT_TRUE(run("promises:thirty", Profile::ours, own).failed) << region;
  }
  const auto other = limits("promises:thirty", "[expected]\nexp6, rotation, any = w, l\n");
  EXPECT_TRUE(run("promises:thirty", Profile::ours, other).failed);
}

TEST(ExpectedFailures, ThatPassSaySoIfTheirRegionWasMeasured) {
  const auto of = [](std::uint64_t cases) {
    return expectations_of(run("liecheck", Profile::ours, limits("liecheck", translation_expected), cases))
        .at(0);
  };
  EXPECT_TRUE(of(100).passed());
  EXPECT_TRUE(text_of(of(100)).starts_with(
      "expected failure that passed: liecheck, exp6 translation at any: 0 of 100 "));
  EXPECT_FALSE(of(99).passed());
}

TEST(Profiles, AndAllElseOfTheDocumentedExampleAreRead) {
  const std::string page = read_whole(LIECHECK_FIXTURES "/../docs/limits.md");
  const auto from = page.find("```\n# mylib.limits") + 4;
  const SubjectLimits all = parse_limits("mylib.limits", page.substr(from, page.find("```", from) - from));
  EXPECT_EQ(all.profile, Profile::careful);
  EXPECT_EQ(all.lines.size(), 3u);
  EXPECT_EQ(all.domain.size(), 3u);
  ASSERT_EQ(all.expected.size(), 1u);
  EXPECT_EQ(all.expected[0].link, "https://example.org/mylib/issues/12");
}

TEST(ExpectedFailures, AreRefusedIfTheyAreTooWideOrNameNothing) {
  const auto said = [](const std::string& line) {
    return error([&] { limits("liecheck", "[expected]\n" + line); });
  };
  EXPECT_EQ(said("exp6, translation, any = why, link"), "");
  EXPECT_NE(
      said("*, translation, any = why, link").find("own.limits:4: '*, translation, any' expects too much"),
      std::string::npos);
  EXPECT_NE(said("exp6, shift, any = why, link")
                .find("own.limits:4: no law measures the block 'shift' of 'exp6'; those of it: rotation, "),
            std::string::npos);
  for (const char* region : {"theta 1e-3..1e-9", "theta 2..3", "everywhere", "theta 1e-3", "theta"})
    EXPECT_NE(said(fmt::format("exp6, translation, {} = why, link", region))
                  .find(fmt::format("own.limits:4: no band of inputs is '{}'", region)),
              std::string::npos);
  for (const char* value : {"why", "why, two words", ", link", "why,"})
    EXPECT_NE(said(fmt::format("exp6, translation, any = {}", value)).find("is not of the form REASON, LINK"),
              std::string::npos);
  EXPECT_NE(said("exp6, translation, any = a, b\nexp6, translation, any = a, b").find("is already in line 4"),
            std::string::npos);
}

TEST_F(Promises, OfFailuresAreTheSameForEachCommandOfTheProgram) {
  write_whole((folder / "own.limits").string(),
              "version = 2\nsubject = textbook\n[expected]\nexp6, translation, theta 1e-8..1 = cancels, l\n");
  const std::string replay = "replay raw.exp_oracle.textbook.double.none.1,0,0,0,0,1e-5";
  EXPECT_EQ(code(replay), 1);
  EXPECT_EQ(code(replay + " --limits own.limits"), 0);
  EXPECT_NE(out().find("expected failure"), std::string::npos) << out();
  const std::string hunt =
      "hunt --subject textbook --op exp6 --block translation --property exp_oracle "
      "--evaluations 2000";
  EXPECT_EQ(code(hunt), 1);
  const double everywhere = found(out());
  code(hunt + " --limits own.limits");
  EXPECT_LT(found(out()), everywhere / 1e4) << out();  // it searches the other angles
}

TEST_F(Promises, AreWrittenByTheProgramAndKept) {
  const std::string promise = "promise correct:quaternions --cases 100 --seed 3 --out p.limits";
  EXPECT_EQ(code(promise), 0) << out();
  const std::string text = read_whole(folder / "p.limits");
  const SubjectLimits all = parse_limits("p.limits", text);
  EXPECT_EQ(all.profile, Profile::careful);
  EXPECT_NE(text.find(", 4 times the largest error found\n"), std::string::npos) << text;
  const auto of = [&](Region region) {
    const auto table = with_own_limits(budgets("", Profile::careful, 0x1p-52), all.lines);
    return budget_in(table, "exp6", "orthogonality defect", region).limit;
  };
  EXPECT_GT(of(Region::to_pi), 4 * 8);  // liecheck promises 8
  EXPECT_LT(of(Region::to_pi), 4 * 20);
  EXPECT_EQ(code(promise), 2);
  EXPECT_NE(read_whole(folder / "err").find("'p.limits' exists"), std::string::npos);
  EXPECT_EQ(read_whole(folder / "p.limits"), text);
  EXPECT_EQ(
      code(
          "campaign --subject correct:quaternions --property exp_oracle --cases 100 --seed 3 --no-hard-cases "
          "--limits p.limits"),
      0)
      << out();
}

TEST_F(Promises, CoverNoCliffOfInputsWithoutAnAngle) {
  CampaignOptions o = options("promises:gimbal", Profile::careful, nullptr, 2000);
  o.selection.properties = {"euler_angles"};
  const CampaignResult r = run_campaign(o, built_in_robot());
  const std::string expected = liecheck::properties::Promises(r).promised().expected;
  EXPECT_NE(expected.find("euler_from_matrix, rotation, all = up to "), std::string::npos) << expected;
}

TEST_F(Promises, AreWrittenWhenTheyAreInterrupted) {
  const std::string promise = "cd " + folder.string() +
                              " && timeout -s INT 2 " LIECHECK_PROGRAM
                              " promise textbook --cases 100000 --out i.limits";
  liecheck::shell(promise);
  const std::string text = read_whole(folder / "i.limits");
  EXPECT_NE(text.find("(seed 42), interrupted: campaigns may break what stands here.\n"), text.npos) << text;
  EXPECT_FALSE(parse_limits("i.limits", text).lines.empty());
}

TEST_F(Promises, AreKeptWithOtherSeedsSinceWhatNoLimitCanPromiseIsExpected) {
  write_whole((folder / "d.limits").string(),
              "version = 3\nsubject = textbook\n[domain]\n*, angle = 3.5, as documented\n");
  EXPECT_EQ(code("promise textbook --scalar double --cases 300 --limits d.limits --out p.limits"), 1);
  EXPECT_NE(out().find("not promised: *, angle above 3.5: as documented\n"), std::string::npos) << out();
  const std::string text = read_whole(folder / "p.limits");
  const SubjectLimits all = parse_limits("p.limits", text);
  EXPECT_NE(text.find("\n*, angle = 3.5, as documented\n"), text.npos) << text;
  const auto expects = [&](const char* operation, const char* block, const char* band) {
    const auto& bands = Bands::of(oracles::scalar_of<double>).all();
    const auto at = std::ranges::find(bands, band, &Band::name);
    return std::ranges::any_of(all.expected, [&](const ExpectedFailure& e) {
      return e.operation == operation && e.block == block && e.inputs.has(*at);
    });
  };
  EXPECT_TRUE(expects("exp6", "translation", "theta 1e-8..1e-7")) << text;
  EXPECT_FALSE(expects("exp6", "translation", "generic 1..pi-1")) << text;
  EXPECT_FALSE(expects("exp6", "translation", "theta 1e-13..1e-12")) << text;
  EXPECT_TRUE(expects("log3_matrix", "rotation vector", "pi")) << text;
  EXPECT_FALSE(expects("log3_matrix", "rotation vector", "generic 1..pi-1")) << text;
  EXPECT_NE(text.find("\nrelative_angle, angle >= 1e-100, smaller angles fail\n"), text.npos) << text;
  for (const Budget& b : all.lines)  // which would hide faults at all other angles
    EXPECT_LT(b.limit, 1e5) << b.operation << " " << b.block;
  for (const ExpectedFailure& e : all.expected) EXPECT_FALSE(e.reason.empty());
  for (const int seed : {42, 1, 2, 3, 5})
    EXPECT_EQ(code(fmt::format("campaign --subject textbook --scalar double --cases 300 --seed {} --limits "
                               "p.limits",
                               seed)),
              0)
        << out();
  EXPECT_NE(out().find(" more that are as expected: --all lists them\n"), std::string::npos) << out();
  EXPECT_EQ(code("promise liecheck --limits d.limits --out q.limits"), 2);
}

}  // namespace
}  // namespace liecheck::properties
