// The comparisons on which verdicts by ball arithmetic depend.

#include <gtest/gtest.h>
#include <campaign/judge.hpp>
#include <invariants/common.hpp>
#include <oracles/ball_oracles.hpp>
#include <oracles/closed_forms.hpp>
#include <random>
#include <subjects/typed.hpp>

namespace liecheck::properties {
namespace {

Judged measured(double error, double kappa) {
  Judged j;
  j.residual.error = error, j.residual.kappa = kappa;
  return j;
}

TEST(Agreement, ErrorsAndConditionNumbersMayDifferByTheirAccuracyAndNoMore) {
  const auto agreed = [](const Judged& fast, const Judged& slow) { return agree({fast}, {slow}); };
  const double e = oracles::error_accuracy;
  EXPECT_TRUE(agreed(measured(2, 30), measured(2 * (1 + 0.9 * e), 30.5)));
  EXPECT_FALSE(agreed(measured(2, 30), measured(2 * (1 + 1.1 * e), 30)));
  EXPECT_FALSE(agreed(measured(2, 15), measured(2, 30)));
  EXPECT_FALSE(agreed(measured(2, 31), measured(2, 30)));
  EXPECT_TRUE(agreed(measured(2, 0.4), measured(2, 0.9)));  // a kappa below 1 is taken as 1
  EXPECT_TRUE(agreed(measured(2, 0), measured(2, 30)));     // kappa = 0 means that it was not computed
  EXPECT_FALSE(agree({measured(1, 1)}, {}));
}

TEST(TheJudge, FindsALawWhoseLowerBoundOfKappaIsTooLarge) {
  const Budget excess{"", "", "any", Rule::excess, 8, ""};
  constexpr Output output = op::exp6[block::translation];
  const Limits limits{{output.definition, {&excess, &excess}}};
  const auto outcome = [&](double kappa, double least) {
    Judge judge(limits, oracles::scalar_of<double>, 0, true);
    const auto f = [kappa] { return kappa; };
    judge.record(output, 0, 1.0, Kappa(f, least));
    return judge.judged.at(0).residual.outcome;
  };
  EXPECT_EQ(outcome(100, 99), Outcome::measured);
  EXPECT_EQ(outcome(100, 110), Outcome::unresolved);
  EXPECT_EQ(outcome(0.5, 1), Outcome::measured);  // errors are divided by max(kappa, 1)
}

// A cliff compares excesses, which may be upper bounds only where they are small.
TEST(TheJudge, DividesALargeErrorByKappaHoweverLargeTheLimitIs) {
  const Budget wide{"", "", "any", Rule::excess, 1e7, ""};
  constexpr Output output = op::exp6[block::translation];
  const Limits limits{{output.definition, {&wide, &wide}}};
  const auto excess = [&](double error) {
    Judge judge(limits, oracles::scalar_of<double>, 0);
    const auto f = [] { return 1e4; };
    judge.record(output, 0, error, Kappa(f, 2));
    return judge.judged.at(0).excess;
  };
  EXPECT_EQ(excess(63), 31.5);  // an upper bound: kappa is at least 2
  EXPECT_EQ(excess(1000), 0.1);
}

// pi - 2e-17 and -pi - 2e-17 both round to the double that is nearest to pi.
TEST(TheJudge, AsksForTheSideOfPiOnlyWhereTheLimitTellsBothApart) {
  const auto outcome = [](double limit, double sign_of_axis, double w) {
    const Budget budget{"", "", "any", Rule::forward, limit, ""};
    TypedSubject<double> subject;
    if (sign_of_axis > 0)
      subject.operations[op::log3_quaternion] = [](const Vec<double, 4>&) {
        return Vec<double, 3>(M_PI, 0, 0);
      };
    else
      subject.operations[op::log3_quaternion] = [](const Vec<double, 4>&) {
        return Vec<double, 3>(-M_PI, 0, 0);
      };
    const Vec<double, 4> Q(1, 0, 0, w);
    const std::vector<double> x =
        Joined<double>{Q, Mat<double, 3>(Mat<double, 3>::Identity()), Vec<double, 3>(0, 0, 0)};
    for (const auto& law : make_properties(oracles::scalar_of<double>))
      if (law->name() == "log_oracle") {
        Limits limits;
        for (const Output& o : law->outputs()) limits.push_back({o.definition, {&budget, &budget}});
        Judge judge(limits, oracles::scalar_of<double>, 0);
        law->measure(erased(subject), x, judge);
        return judge.judged.at(0).residual.outcome;
      }
    return Outcome::unmeasured;
  };
  for (const double limit : {1.65, 64.0}) {
    EXPECT_EQ(outcome(limit, 1, 1e-17), Outcome::measured) << limit;
    EXPECT_EQ(outcome(limit, -1, -1e-17), Outcome::measured) << limit;
    EXPECT_EQ(outcome(limit, 1, -1e-14), Outcome::wrong_branch) << limit;
  }
  EXPECT_EQ(outcome(1.65, 1, -1e-17), Outcome::wrong_branch);
  EXPECT_EQ(outcome(64, 1, -1e-17), Outcome::measured);
  EXPECT_EQ(outcome(64, -1, 1e-16), Outcome::measured);
}

TEST(TallyRows, AreFoundAgainAfterCopyMoveAndErasure) {
  Rows a;
  a.of(1, 2).count = 5;
  Rows copy = a, moved = std::move(a);
  copy.of(1, 2).count = 6;
  EXPECT_EQ(moved.of(1, 2).count, 5u);
  a.of(1, 2).count = 7;  // NOLINT(bugprone-use-after-move): empty, and usable
  EXPECT_EQ(moved.at({1, 2}).count, 5u);
  copy.erase(copy.begin());
  EXPECT_EQ(copy.of(1, 2).count, 0u);
  moved = copy;
  moved.of(1, 2).count = 8;
  EXPECT_EQ(copy.at({1, 2}).count, 0u);
}

template <class S>
class BallBands : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BallBands, Scalars);

/// Small numbers of every size, with the smallest subnormal and normal numbers and their neighbours.
template <class S>
S small(std::mt19937_64& random) {
  using Limits = std::numeric_limits<S>;
  const S edges[] = {S(0), Limits::denorm_min(), Limits::min(), std::nextafter(Limits::min(), S(0)),
                     std::nextafter(Limits::min(), S(1))};
  const auto k = random() % 8;
  S x = k < 5 ? edges[k]
              : std::ldexp(S(1) + static_cast<S>(random() % 1024) / 1024,
                           Limits::min_exponent - Limits::digits + 1 +
                               static_cast<int>(random() % (2 * Limits::digits + 8)));
  return random() % 2 ? x : -x;
}

TYPED_TEST(BallBands, OfSubnormalAnglesAndOfPosesNearTheIdentityEqualThoseOfFiftyDigits) {
  using S = TypeParam;
  using oracles::DoubleDoubleBall;
  std::mt19937_64 random(11);
  std::size_t angles = 0, differences = 0, subnormal = 0;
  for (int i = 0; i < 3000; ++i) {
    Vec<S, 3> phi;
    for (int k = 0; k < 3; ++k) phi[k] = small<S>(random);
    const std::size_t slow = band_of_angle(oracles::scalar_of<S>, oracles::exact_vector<3, Real>(phi));
    subnormal += slow == Bands::of(oracles::scalar_of<S>).underflowing(true);
    try {
      EXPECT_EQ(band_of_angle(oracles::scalar_of<S>, oracles::exact_vector<3, DoubleDoubleBall>(phi)), slow)
          << phi.transpose();
      ++angles;
    } catch (const oracles::Undecided&) {
    }
    Vec<S, 7> q[2];
    for (auto& x : q) {
      for (int k = 0; k < 6; ++k) x[k] = small<S>(random);
      x[6] = random() % 4 ? S(1) : S(-1);
    }
    const auto band = [&]<class T>(T) {
      const auto x0 = oracles::exact_vector<7, T>(q[0]), x1 = oracles::exact_vector<7, T>(q[1]);
      return band_of_difference(oracles::scalar_of<S>, x0, x1, oracles::difference(x0, x1));
    };
    try {
      const std::size_t fast = band(DoubleDoubleBall(0));
      ++differences;
      EXPECT_EQ(fast, band(Real(0))) << q[0].transpose() << "; " << q[1].transpose();
    } catch (const oracles::Undecided&) {
    }
  }
  EXPECT_GT(subnormal, 200u);
  EXPECT_GT(angles, 2800u);  // the others are undecided: theta^2 is one ulp from the edge of a band
  EXPECT_GT(differences, 2700u);
}

}  // namespace
}  // namespace liecheck::properties
