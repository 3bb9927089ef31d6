// Environments: calls in other rounding modes, comparison with the program's own build, and the refusal to judge in
// unusual arithmetic.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <campaign/robots.hpp>
#include <campaign/series.hpp>
#include <cstdlib>
#include <environments/measure.hpp>
#include <limits>
#include <set>

#include "../own_subject.hpp"
#include "../shell.hpp"

namespace liecheck::properties::environments {
namespace {

using O = TypedOperations<double>;

TEST(Arithmetic, IsNamedAsItIs) {
  EXPECT_EQ(unusual_arithmetic(), "");
  EXPECT_NO_THROW(require_usual_arithmetic());
  const auto in = [](const FloatMode& mode) {
    const FloatEnvironment usual;
    FloatEnvironment::set(mode);
    return unusual_arithmetic();
  };
  EXPECT_EQ(in({FE_UPWARD, false}), "rounds up");
  EXPECT_EQ(in({FE_DOWNWARD, false}), "rounds down");
  EXPECT_EQ(in({FE_TOWARDZERO, false}), "rounds to zero");
  if (FloatEnvironment::can_flush()) {
    EXPECT_EQ(in({FE_TONEAREST, true}), "takes subnormal numbers for zero");
    EXPECT_EQ(in({FE_UPWARD, true}), "rounds up and takes subnormal numbers for zero");
  }
  const FloatEnvironment usual;
  FloatEnvironment::set({FE_UPWARD, false});
  EXPECT_THROW(require_usual_arithmetic(), std::runtime_error);
}

TEST(Arithmetic, OfAProgramThatIsUnusualJudgesNothing) {
  const auto code = [](const std::string& how) {
    const std::string line = "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" LIECHECK_OTHER_ARITHMETIC
                             " LIECHECK_ARITHMETIC=" +
                             how +
                             " " LIECHECK_PROGRAM
                             " campaign --property exp_oracle --scalar double --cases 2 -j 1 --no-hard-cases";
    return shell(line).code;
  };
  EXPECT_EQ(code("none"), 0);
  EXPECT_EQ(code("up"), 2);
  EXPECT_EQ(code("zero"), 2);
  EXPECT_EQ(code("trap"), 2);
#ifdef __x86_64__
  EXPECT_EQ(code("x87"), 2);
  EXPECT_EQ(code("x87_53"), 0);  // a warning, since valgrind does the same
#endif
  if (FloatEnvironment::can_flush()) {
    EXPECT_EQ(code("flush"), 2);
  }
}

/// exp3_quaternion of liecheck, which then rounds up in every second call.
const Registered<double> changes =
    registered("environment:changes", op::exp3_quaternion, [](const O::V3& phi) -> O::V4 {
      std::fesetround(FE_UPWARD);
      return own_subject().operations[op::exp3_quaternion](phi);
    });

TEST(Arithmetic, ThatACallChangesIsSetBackAndFailsWhetherTheCallIsCheckedOrNot) {
  const auto series = select({{"environment:changes"}, {"exp_oracle"}, {"double"}}, built_in_robot());
  for (std::uint64_t index = 0; index < 8; ++index) {
    Tally tally;
    series.front()->run(42, index, tally);
    std::uint64_t changed = 0;
    for (const auto& [cell, row] : tally.rows) changed += row.environment_changed;
    EXPECT_GT(changed, 0u) << index;
    EXPECT_EQ(unusual_arithmetic(), "") << index;
    std::feclearexcept(FE_ALL_EXCEPT), std::fesetround(FE_TONEAREST);
  }
}

Measured one(std::vector<Case> cases) {
  Measured m;
  m.laws.push_back({"law", "double", {"exp6"}, {"translation"}, std::move(cases)});
  return m;
}
Figures figures(const Verdict& before, const Verdict& now, Promise promise, bool small = false) {
  Case was, is;
  was.verdicts = {before}, is.verdicts = {now}, is.small = small;
  return compared(one({was}), one({is}), promise).at({"exp6", "double"});
}

TEST(Environments, AreWorseWhereTheErrorExceedsWhatIsExpected) {
  const Verdict good{0, Outcome::measured, false, false, 1, 8};
  const auto of = [&](double error) { return Verdict{0, Outcome::measured, error > 8, false, error, 8}; };
  EXPECT_EQ(figures(good, of(7), Promise::same).worse, 0u);
  EXPECT_EQ(figures(good, of(9), Promise::same).worse, 1u);
  EXPECT_EQ(figures(good, of(31), Promise::fourfold).worse, 0u);
  EXPECT_EQ(figures(good, of(33), Promise::fourfold).worse, 1u);
  EXPECT_EQ(figures(of(100), of(100), Promise::same).worse, 0u);  // not worse than it was
  EXPECT_DOUBLE_EQ(figures(good, of(800), Promise::same).of_limit, 100);
  EXPECT_NEAR(figures(good, of(800), Promise::same).digits_lost, 2.903, 1e-3);
  EXPECT_EQ(figures(good, of(9), Promise::flushed).worse, 1u);
  EXPECT_EQ(figures(good, of(9), Promise::flushed, true).worse, 0u);
  EXPECT_EQ(figures(good, of(9), Promise::flushed, true).small, 1u);
  EXPECT_EQ(figures(good, of(9), Promise::same, true).worse, 1u);
}

TEST(Environments, AreWorseWhereAResultIsNoLongerRight) {
  const Verdict good{0, Outcome::measured, false, false, 1, 8};
  const Verdict refused{0, Outcome::refused, false, false, 0, 8};  // of what is no rotation
  for (const Outcome o : {Outcome::not_finite, Outcome::wrong_branch, Outcome::refused, Outcome::crashed}) {
    const Verdict bad{0, o, true, false, 0, 8};
    const Figures f = figures(good, bad, Promise::fourfold);
    EXPECT_EQ(f.worse, 1u);
    EXPECT_EQ(f.same_verdicts, 0u);
    EXPECT_EQ(f.not_finite + f.wrong_branch + f.refused, o == Outcome::crashed ? 0u : 1u);
    EXPECT_EQ(figures(bad, bad, Promise::same).worse, 0u);
  }
  EXPECT_EQ(figures(good, {0, Outcome::unresolved, false, false, 0, 8}, Promise::same).worse, 1u);
  const Verdict open{0, Outcome::unresolved, false, false, 0, 8};
  EXPECT_EQ(figures(open, open, Promise::same).worse, 0u) << "it had no verdict there";
  EXPECT_EQ(figures(refused, refused, Promise::same).worse, 0u);
  EXPECT_EQ(figures(refused, refused, Promise::same).same_verdicts, 1u);
}

TEST(Environments, CountCallsWithOtherBits) {
  Case was, is;
  was.calls = {{1, 10}, {2, 20}, {3, 30}}, was.call_operations = {0, 0, 0};
  is.calls = {{1, 10}, {2, 21}, {4, 40}}, is.call_operations = {0, 0, 0};
  const Figures f = compared(one({was}), one({is}), Promise::same).at({"exp6", "double"});
  EXPECT_EQ(f.calls, 2u);  // the argument 4 has no counterpart
  EXPECT_EQ(f.same_calls, 1u);
}

MeasureOptions few() {
  MeasureOptions o;
  o.cases = 40, o.hard_cases = false, o.properties = {"exp_oracle"}, o.scalars = {"double"};
  return o;
}

TEST(Environments, CallsInAnotherRoundingModeHaveOtherBitsAndTheSameVerdicts) {
  const auto before = measure("liecheck", Profile::ours, {}, few());
  const auto sum = [&](const FloatMode& mode) {
    Figures all;
    for (const auto& [key, f] :
         compared(*before, *measure("liecheck", Profile::ours, mode, few()), Promise::fourfold))
      all.add(f);
    return all;
  };
  const Figures same = sum({}), up = sum({FE_UPWARD, false});
  EXPECT_GT(same.calls, 100u);
  EXPECT_EQ(same.same_calls, same.calls);
  EXPECT_EQ(same.same_verdicts, same.cases);
  EXPECT_EQ(same.worse, 0u);
  EXPECT_LT(up.same_calls, up.calls);
  EXPECT_EQ(up.worse, 0u) << up.worst;
  EXPECT_EQ(unusual_arithmetic(), "");
}

TEST(Environments, EveryOneHasANameAndSaysWhatItNeeds) {
  std::set<std::string> names;
  for (const Environment& e : all()) {
    EXPECT_TRUE(names.insert(e.name).second) << e.name;
    EXPECT_EQ(e.mode.has_value(), e.compiler.empty()) << e.name;
    for (const Environment::Need& n : e.needs) EXPECT_FALSE(n.what.empty() || n.get.empty()) << e.name;
  }
  Environment e;
  e.needs = {{Environment::Need::program, "no-such-compiler", "apt-get install it"}};
  EXPECT_EQ(missing(e), "no-such-compiler is not there; to get it: apt-get install it");
}

}  // namespace
}  // namespace liecheck::properties::environments
