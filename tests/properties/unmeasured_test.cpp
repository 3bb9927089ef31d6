// Nothing passes unmeasured: a law that returns early, a robot whose mass matrix is singular, a case that the
// oracle does not resolve.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <campaign/coverage_report.hpp>
#include <campaign/series.hpp>
#include <cmath>
#include <fstream>
#include <invariants/common.hpp>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <regex>
#include <store/compare.hpp>
#include <store/merge.hpp>
#include <store/store_path.hpp>
#include <store/stored_run.hpp>
#include <subjects/tree.hpp>

#include "../campaigns.hpp"
#include "../own_subject.hpp"
#include "../refusal.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::properties {
namespace {

// A subject whose forward dynamics returns 1e30.
const Registered<double> huge_acceleration =
    registered("unmeasured_huge_aba", [](TypedOperations<double>& operations) {
      operations.tree = [](const Tree<double>& tree) {
        auto o = own_subject().operations.tree(tree);
        o[op::tree_aba] = [](const auto&, const VecX<double>& v, const auto&, int,
                             const auto&) -> VecX<double> { return VecX<double>::Constant(v.size(), 1e30); };
        return o;
      };
    });

/// A chain of links, all with a mass and an inertia except the last.
std::string chain_with_a_massless_end(int links) {
  std::string text = "<robot name='chain'>";
  for (int i = 0; i < links; ++i) {
    const std::string n = std::to_string(i), before = std::to_string(i - 1);
    text += "<link name='l" + n + "'>";
    if (i + 1 < links)
      text +=
          "<inertial><origin xyz='0.1 0 0.2'/><mass value='1.5'/><inertia ixx='0.1' iyy='0.2' izz='0.15' "
          "ixy='0' ixz='0' iyz='0'/></inertial>";
    text += "</link>";
    if (i > 0)
      text += "<joint name='j" + n + "' type='revolute'><parent link='l" + before + "'/><child link='l" + n +
              "'/><origin xyz='0 0.1 0.3'/><axis xyz='0 1 0'/>"
              "<limit lower='-3' upper='3' effort='10' velocity='10'/></joint>";
  }
  return text + "</robot>";
}

CampaignResult run(const std::string& subject, const std::string& law, const Robot& robot,
                   std::uint64_t cases = 60) {
  return run_quietly({{subject}, {law}, {"double"}}, cases, 1, robot);
}

std::string verdict(const CampaignResult& r) {
  return verdict_of(!r.undecided(), !r.failed);
}

class SingularRobots : public testing::TestWithParam<int> {
 protected:
  Robot robot(bool fixed) const {
    return robot_of(chain_with_a_massless_end(GetParam()), "chain.urdf", fixed);
  }
};

TEST_P(SingularRobots, LeaveForwardDynamicsAndItsDerivativesIncomplete) {
  for (const bool fixed : {false, true})
    for (const char* law : {"forward_dynamics", "dynamics_derivatives"}) {
      const CampaignResult r = run("liecheck", law, robot(fixed));
      EXPECT_EQ(verdict(r), "incomplete") << law << (fixed ? ", fixed" : "");
      const auto& [series, tally] = r.series.at(0);
      EXPECT_FALSE(not_measured(*series, tally).empty());
    }
}

TEST_P(SingularRobots, AreMeasuredByEveryOtherLaw) {
  for (const char* law : {"lagrange", "power_balance", "frame_motion", "frame_jacobian", "tree_invariance"})
    EXPECT_EQ(verdict(run("liecheck", law, robot(true))), "pass") << law;
}

TEST_P(SingularRobots, ShowAnAccelerationOf1e30AsAFailure) {
  const bool nothing_has_a_mass = GetParam() == 2;  // if the root is fixed
  EXPECT_EQ(verdict(run("unmeasured_huge_aba", "forward_dynamics", robot(true))),
            nothing_has_a_mass ? "incomplete" : "fail");
  EXPECT_EQ(verdict(run("unmeasured_huge_aba", "forward_dynamics", robot(false))), "fail");
  EXPECT_EQ(verdict(run("unmeasured_huge_aba", "tree_momentum", robot(false))), "fail");
}

INSTANTIATE_TEST_SUITE_P(ALinkAndAChain, SingularRobots, testing::Values(2, 4));

/// As two public grippers are: their bodies move, and none has a mass.
TEST(ARobotWithoutAnyMass, HasNoCentreOfMassSoThatNoLawOfItFails) {
  const std::string text =
      "<robot name='gripper'><link name='base'/><link name='finger'/><joint name='j' type='prismatic'>"
      "<parent link='base'/><child link='finger'/><axis xyz='0 1 0'/>"
      "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>";
  for (const bool fixed : {false, true}) {
    std::vector<std::string> warnings;
    const Robot robot = robot_of(text, "gripper.urdf", fixed, &warnings);
    EXPECT_NE(fmt::format("{}", fmt::join(warnings, "\n")).find("no body that moves has a mass"),
              std::string::npos);
    for (const char* law : {"tree_momentum", "forward_dynamics", "tree_invariance"})
      EXPECT_FALSE(run("liecheck", law, robot).failed) << law << fixed;
  }
}

TEST(AnAccelerationOf1e30, FailsOnRandomTrees) {
  EXPECT_EQ(verdict(run("unmeasured_huge_aba", "forward_dynamics", built_in_robot())), "fail");
}

/// The law exp_oracle, which says nothing about exp6 beyond `limit` [rad], or that its oracle did not resolve it.
class ReturnsEarly final : public Property {
 public:
  ReturnsEarly(double limit, bool says_unresolved) : limit_(limit), says_unresolved_(says_unresolved) {
    for (auto& p : make_properties(oracles::scalar_of<double>))
      if (p->name() == "exp_oracle") law_ = std::move(p);
  }
  const Statement& statement() const override { return law_->statement(); }
  std::vector<double> generate(Source& source) const override { return law_->generate(source); }
  void measure(const Subject& subject, const std::vector<double>& x, Recorder& r) const override {
    Subject some = subject;
    const bool beyond = std::hypot(x[3], x[4], x[5]) > limit_;
    if (beyond) some.operations[op::exp6] = nullptr;
    law_->measure(some, x, r);
    if (!beyond || !says_unresolved_) return;
    for (const Output& o : statement().outputs)
      if (o.record == &op::exp6) r.outcome(o, 0, Outcome::unresolved);
  }

 private:
  std::unique_ptr<Property> law_;
  double limit_;
  bool says_unresolved_;
};

CampaignResult run_early(double limit, bool says_unresolved = false) {
  static const Subject own = erased(own_subject());
  CampaignResult r;
  r.options.cases = 200;
  r.series.push_back({std::make_unique<Series>(std::make_unique<ReturnsEarly>(limit, says_unresolved), own,
                                               built_in_robot()),
                      {}});
  auto& [series, tally] = r.series[0];
  for (std::uint64_t i = 0; i < r.options.cases; ++i) series->run(42, i, tally);
  tally.done.add(0, r.options.cases);
  r.summarize();
  return r;
}

TEST(ALawThatReturnsEarly, IsIncompleteAndSaysWhatItDidNotRecord) {
  const CampaignResult early = run_early(1), never = run_early(-1), right = run_early(INFINITY);
  EXPECT_EQ(verdict(right), "pass");
  EXPECT_EQ(verdict(early), "incomplete");
  EXPECT_EQ(verdict(never), "incomplete");
  const auto& [series, tally] = early.series[0];
  const auto lines = not_measured(*series, tally);
  ASSERT_EQ(lines.size(), 3u) << lines.size();  // the blocks of exp6
  for (const auto& line : lines) EXPECT_NE(line.find("exp6, "), line.npos) << line;
  EXPECT_NE(lines[0].find("not recorded in "), std::string::npos) << lines[0];
  const auto record = record_of(StoredRun{run_early(1), {}, {}});
  EXPECT_EQ(record["verdict"], "incomplete");
  EXPECT_EQ(record["not_measured"].size(), 3u);
}

TEST(AnUnresolvedCase, IsCountedAndLeavesTheSeriesIncomplete) {
  const CampaignResult r = run_early(1, true);
  EXPECT_EQ(verdict(r), "incomplete");
  std::uint64_t unresolved = 0, unmeasured = 0;
  for (const auto& [key, row] : r.series[0].tally.rows)
    unresolved += row.unresolved, unmeasured += row.unmeasured;
  EXPECT_GT(unresolved, 0u);
  EXPECT_EQ(unmeasured, 0u);
  EXPECT_EQ(record_of(StoredRun{run_early(1, true), {}, {}})["verdict"], "incomplete");
}

TEST(AnOutput, ThatWasIllPosedInMostCasesIsIncomplete) {
  CampaignResult r = run_early(INFINITY);
  auto& [series, tally] = r.series[0];
  for (const std::uint64_t measured : {0u, 40u, 60u}) {
    Tally t;
    const std::vector<double> x{0, 0, 0, 0, 0, 1};
    const std::uint32_t all = series->due;
    for (std::uint64_t i = 0; i < 1000; ++i, ++t.cases)
      t.coverage.add(series->fields, x, series->format(),
                     i < measured ? MeasuredOutputs{all, 0} : MeasuredOutputs{all & ~1u, 1});
    const auto lines = not_measured(*series, t);
    const std::string named = "exp3_quaternion, rotation: measured in " + std::to_string(measured);
    EXPECT_EQ(std::any_of(lines.begin(), lines.end(), [&](auto& l) { return l.starts_with(named); }),
              measured < 50)
        << measured;
  }
}

/// Keeps the outcomes of one case.
struct Outcomes final : Recorder {
  Outcomes() : Recorder(oracles::scalar_of<double>) {}
  void record(const Output&, std::size_t, double, Kappa) override { all.push_back(Outcome::measured); }
  void outcome(const Output&, std::size_t, Outcome o) override { all.push_back(o); }
  std::vector<Outcome> all;
};

TEST(ANotANumber, IsAFailureEvenIfTheCaseIsUnresolved) {
  const Output output = op::exp6[block::translation];
  for (const bool resolved : {true, false}) {
    Outcomes nan, number;
    judged_value(nan, {output}, 0, Vec<double, 3>(NAN, 0, 0), resolved, [] {});
    EXPECT_EQ(nan.all, std::vector<Outcome>{Outcome::not_finite});
    judged_value(number, {output}, 0, Vec<double, 3>(1, 0, 0), resolved, [] {});
    EXPECT_EQ(number.all, resolved ? std::vector<Outcome>() : std::vector<Outcome>{Outcome::unresolved});
  }
}

TEST(Coverage, CountsTheMeasurementsOfEachOutputByClass) {
  const std::vector<Field> fields = {{"phi", Kind::rotation_vector, 3, "rad"}};
  const std::vector<double> zero{0, 0, 0}, x{0, 0, 1.5};
  Coverage a, b;
  a.add(fields, zero, oracles::scalar_of<double>, {0b01, 0b10});
  a.add(fields, x, oracles::scalar_of<double>, {0b11, 0});
  b.add(fields, x, oracles::scalar_of<double>, {0b11, 0});
  a.merge(b);
  constexpr auto measured = &MeasuredOutputs::measured, ill_posed = &MeasuredOutputs::ill_posed;
  EXPECT_EQ(a.cases(), 3u);
  EXPECT_EQ(a.cases(measured, 0), 3u);
  EXPECT_EQ(a.cases(measured, 1), 2u);
  EXPECT_EQ(a.count(0, 0), 1u);               // class "zero"
  EXPECT_EQ(a.count(0, 0, measured, 1), 0u);  // in which output 1 is ill-posed
  EXPECT_EQ(a.count(0, 0, ill_posed, 1), 1u);
  EXPECT_EQ(a.count(0, 5, measured, 1), 2u);  // "generic"
  Coverage again;
  ASSERT_TRUE(again.parse(a.text()));
  EXPECT_EQ(again.text(), a.text());
  EXPECT_TRUE(again.parse(""));
  EXPECT_EQ(again.cases(), 0u);
  for (const char* bad : {"3", "3;1,2", "1,0:1;1", "1,0:1|", "1,0:1|1,0:1", "1,0:x"})
    EXPECT_FALSE(again.parse(bad)) << bad;
}

TEST(AStore, WithoutAVerdictIsNeitherMergedNorComparedAsComplete) {
  StoredCampaign c;
  c.series.resize(1);
  EXPECT_EQ(c.not_measured(), "nothing was measured");
  EXPECT_EQ(cells_in_both(c, c), 0u);
  Row& row = c.series[0].tally.rows.of(0, 0);
  c.series[0].labels[{0, 0}] = {"exp6", "translation", "all"};
  row.count = 5;
  EXPECT_EQ(c.not_measured(), "");
  EXPECT_EQ(cells_in_both(c, c), 1u);
  row.unresolved = 2, row.unmeasured = 1;
  EXPECT_EQ(c.not_measured(), "3 measurements have no verdict");
  row.ill_posed = 2;
  EXPECT_EQ(cells_in_both(c, c), 0u);
  EXPECT_EQ(c.not_measured(), "nothing was measured");
  row.unresolved = row.unmeasured = 0;
  Row& ill_posed = c.series[0].tally.rows.of(1, 3);
  ill_posed.count = ill_posed.ill_posed = 4;
  EXPECT_EQ(c.not_measured(), "outputs that no case measured: 1");
}

TEST(TheProgram, SaysThatARobotWasNotMeasuredAndReturns3) {
  const std::string folder = own_folder(), robot = folder + "chain.urdf", store = folder + "store";
  std::ofstream(robot) << chain_with_a_massless_end(3);
  Answer answer;
  const auto exit_of = [&](const std::string& arguments) {
    answer = shell(LIECHECK_PROGRAM " " + arguments);
    return answer.code;
  };
  const auto said = [&](const std::string& words) { return test::has(answer.text, words); };
  const std::string of_robot = " --robot " + robot + " --root fixed";
  EXPECT_EQ(
      exit_of("campaign --no-hard-cases --property forward_dynamics --scalar double --cases 20 --store " +
              store + of_robot),
      3);
  EXPECT_TRUE(said("NOT MEASURED  forward_dynamics of liecheck in double"));
  EXPECT_TRUE(said("tree_aba, acceleration: measured in 0 of 20 cases"));
  EXPECT_TRUE(said("verdict incomplete"));
  const std::string hash = robot_of(chain_with_a_massless_end(3), "chain.urdf", true).hash;
  EXPECT_EQ(exit_of("replay g4.42.forward_dynamics.liecheck.double." + hash + ".0" + of_robot), 3);
  EXPECT_TRUE(said("nothing was measured"));
  EXPECT_EQ(exit_of("hunt --subject liecheck --op tree_aba --property forward_dynamics --evaluations 20" +
                    of_robot),
            3);
  EXPECT_EQ(exit_of("compare " + store + " " + store), 3);
  EXPECT_EQ(exit_of("merge " + store + "2 " + store), 3);
  EXPECT_TRUE(said("nothing was measured"));
}

/// The campaign without the cases of the first class of its second field.
StoredCampaign without_a_class(StoredCampaign c) {
  Coverage& coverage = c.series.at(0).tally.coverage;
  const std::regex first_of_second_field("(:[0-9]+;[0-9,]*;)[0-9]+");
  EXPECT_TRUE(coverage.parse(std::regex_replace(coverage.text(), first_of_second_field, "$010")));
  return c;
}

TEST(TheProgram, Returns3IfTheMergedShardsNeverReachedAClass) {
  const std::string folder = own_folder();
  for (unsigned shard : {1u, 2u}) {
    CampaignOptions options = quiet({{"liecheck"}, {"exp_oracle"}, {"double"}}, 4000);
    options.shard = shard, options.shards = 2;
    const std::string all = folder + "all" + std::to_string(shard),
                      some = folder + "some" + std::to_string(shard);
    {
      Store store(all, Store::Open::create);
      run_stored(options, built_in_robot(), store, false);
    }
    Store(some, Store::Open::create).write(without_a_class(load_campaign(all)), false, {});
  }
  const auto merged = [&](const std::string& parts) {
    return shell("cd '" + folder + "'; '" LIECHECK_PROGRAM "' merge of_" + parts + " " + parts + "1 " +
                 parts + "2");
  };
  EXPECT_EQ(merged("all").code, 0);
  const Answer some = merged("some");
  EXPECT_EQ(some.code, 3);
  EXPECT_TRUE(test::has(some.text, "incomplete: exp_oracle of liecheck in double: phi: "));
}

}  // namespace
}  // namespace liecheck::properties
