// Ball arithmetic: results contain the exact values, and their radii are small.

#include <gtest/gtest.h>
#include <oracles/ball_error.hpp>
#include <oracles/closed_forms.hpp>
#include <random>

#include "../sample.hpp"

namespace liecheck::oracles {
namespace {

/// |midpoint - exact| / radius; 0 if the midpoint is exact.
template <BallNumber B, class T>
double share(const B& b, const T& value) {
  const double d = static_cast<double>(T(abs(exact<T>(b) - value)));
  return d == 0 ? 0 : b.r > 0 ? d / b.r : std::numeric_limits<double>::infinity();
}

template <class B>
class BallTest : public testing::Test {
 protected:
  double number(double decades) {
    const double x = std::pow(10.0, std::uniform_real_distribution<double>(-decades, decades)(random_));
    return random_() % 2 ? x : -x;
  }
  std::mt19937_64 random_{5};
};

template <class B>
class AnyBall : public BallTest<B> {};
using AnyBallNumbers = testing::Types<DoubleBall, DoubleDoubleBall, RealBall>;
TYPED_TEST_SUITE(AnyBall, AnyBallNumbers);
using BallNumbers = testing::Types<DoubleBall, DoubleDoubleBall>;
TYPED_TEST_SUITE(BallTest, BallNumbers);

TYPED_TEST(AnyBall, OperationsContainTheExactResult) {
  for (int i = 0; i < sample(2000, 20000); ++i) {
    const double a = this->number(120), b = this->number(120), c = this->number(3);
    const Real100 A(a), B(b), C(c);
    const TypeParam third = TypeParam(c) / TypeParam(3);
    EXPECT_LE(share(third, Real100(C / 3)), 1);
    EXPECT_LE(share(TypeParam(a) * third + TypeParam(b), Real100(A * C / 3 + B)), 1);
    EXPECT_LE(share(TypeParam(a) * TypeParam(b), Real100(A * B)), 1);
    EXPECT_LE(share(third * third - third, Real100(C * C / 9 - C / 3)), 1);
    EXPECT_LE(share(sqrt(TypeParam(std::fabs(a)) * TypeParam(std::fabs(c))), sqrt(Real100(abs(A * C)))), 1);
    EXPECT_LE(share(atan2(TypeParam(c), TypeParam(b)), Real100(atan2(C, B))), 1);
    EXPECT_LE(share(atan2(third, TypeParam(b) * third), Real100(atan2(C / 3, Real100(B * C / 3)))), 1);
  }
}

TEST(RealBall, ItsHeadIsItsMidpointRoundedToDouble) {
  for (int exponent = -1100; exponent <= 1100; ++exponent)
    for (const Real& m : {Real(0), Real(1), Real(Real(-7) / 3), Real(2 - ldexp(Real(1), -160))}) {
      const Real x = ldexp(m, exponent);
      const double head = Rounding<Real>::head(x), exact = static_cast<double>(x);
      if (std::isinf(exact))
        EXPECT_EQ(head, exact);
      else
        EXPECT_LE(std::fabs(head - exact), 0x1p-52 * std::fabs(exact)) << exponent;
    }
}

TYPED_TEST(AnyBall, SineAndCosineContainTheExactResultWithinSixteenRoundings) {
  for (int i = 0; i < sample(2000, 20000); ++i) {
    const double x = i % 2 ? this->number(4) : this->number(20) * 1e-18;
    TypeParam s, c;
    sin_cos(TypeParam(x), s, c);
    EXPECT_LE(share(s, Real100(sin(Real100(x)))), 1) << x;
    EXPECT_LE(share(c, Real100(cos(Real100(x)))), 1) << x;
    EXPECT_LE(s.r, 16 * TypeParam::Round::add * std::fmax(1.0, std::fabs(x)));
  }
}

TYPED_TEST(BallTest, StumpffSeriesContainTheClosedForm) {
  for (int i = 0; i < sample(500, 5000); ++i) {
    const double x = std::uniform_real_distribution<double>(1e-6, 1)(this->random_);
    const Real X(x), t = sqrt(X);
    const Real c4 = (Real(1) / 2 - (1 - cos(t)) / X) / X, c5 = (Real(1) / 6 - (1 - sin(t) / t) / X) / X;
    EXPECT_LE(share(stumpff_series(4, TypeParam(x)), c4), 1);
    EXPECT_LE(share(stumpff_series(5, TypeParam(x)), c5), 1);
  }
}

TYPED_TEST(BallTest, ClosedFormsContainThoseAtAHundredDigits) {
  const auto contains = [](const auto& ball, const auto& exact, const char* what) {
    for (std::size_t i = 0; i < ball.x.size(); ++i)
      EXPECT_LE(share(ball.x[i], Real(exact.x[i])), 1) << what << i << " " << ball.x[i].head();
  };
  for (int i = 0; i < sample(300, 3000); ++i) {
    Vec6<TypeParam> xi;
    const double scale = this->number(i % 3 == 0 ? 40 : 1);
    for (int k = 0; k < 6; ++k) xi[k] = TypeParam(this->number(1) * (k < 3 ? 1 : scale));
    const auto exact_xi = cast<Real100>(xi);
    if (norm(exact_xi) > 1e6) continue;
    try {
      const auto pose = closed_exp(xi);
      const auto truth = closed_exp(exact_xi);
      contains(pose.Q, truth.Q, "Q");
      contains(pose.p, truth.p, "p");
      const auto J = closed_left_jacobian(xi);
      const auto true_J = closed_left_jacobian(exact_xi);
      contains(J.J, true_J.J, "J");
      contains(J.C, true_J.C, "C");
      const auto log = closed_log(pose.Q, pose.p);
      EXPECT_LT(log[0].r, 1e12 * TypeParam::Round::add * (1 + log[0].size()));
    } catch (const Undecided&) {
    }
  }
}

TYPED_TEST(BallTest, APolarFactorContainsTheOneAtAHundredDigits) {
  for (int i = 0; i < sample(200, 2000); ++i) {
    Vec3<TypeParam> phi;
    for (int k = 0; k < 3; ++k) phi[k] = TypeParam(this->number(i % 2 ? 0.4 : 8) * (i % 2 ? 1 : 1e-8));
    const Mat3<TypeParam> R = rotation_matrix(closed_exp(stack(zero_vector<3, TypeParam>(), phi)).Q);
    Mat3<TypeParam> stored;
    for (std::size_t k = 0; k < 9; ++k)
      stored.x[k] = TypeParam(R.x[k].head() * (1 + 3e-16 * (this->random_() % 5)));
    try {
      const auto Q = nearest_quaternion(stored);
      const auto truth = nearest_quaternion(cast<Real100>(stored));
      ASSERT_TRUE(truth.resolved);
      const bool flipped = (Q[3].head() < 0) != (truth.Q[3] < 0);
      for (int k = 0; k < 4; ++k)
        EXPECT_LE(share(Q[k], flipped ? Real(-truth.Q[k]) : Real(truth.Q[k])), 1) << k;
    } catch (const Undecided&) {
    }
  }
}

TYPED_TEST(AnyBall, ComparisonsThatTheRadiusCannotDecideThrow) {
  const TypeParam third = TypeParam(1) / TypeParam(3);
  EXPECT_THROW((void)(third * TypeParam(3) == TypeParam(1)), Undecided);
  EXPECT_THROW((void)(third * TypeParam(3) < TypeParam(1)), Undecided);
  EXPECT_TRUE(third < TypeParam(0.34));
  EXPECT_TRUE(TypeParam(0.5) * TypeParam(2) == TypeParam(1));  // exact
  EXPECT_THROW(TypeParam(1) / (third - third), Undecided);
  EXPECT_THROW(settled(3, 1e-3), Undecided);
  EXPECT_EQ(settled(3, 1e-5), 3);
  EXPECT_GT(settled(0, 1e-9), 0);  // not known to be exactly zero
  EXPECT_EQ(settled(0, 0), 0);
  EXPECT_THROW(settled(std::nan(""), 0 * std::nan("")), Undecided);
}

/// A NaN or an infinite number is never taken for a smaller operand, or left out of a norm.
TYPED_TEST(AnyBall, NumbersThatOverflowThrow) {
  const TypeParam huge(0x1.8p1000), one(1);
  EXPECT_THROW((void)larger(TypeParam(huge * huge), one), Undecided);
  EXPECT_THROW((void)larger(one, TypeParam(huge * huge)), Undecided);
  EXPECT_THROW((void)length(Vec<2, TypeParam>{{huge * huge, one}}), Undecided);
  const double nan = std::nan("");
  EXPECT_THROW((void)larger(TypeParam(1, nan), one), Undecided);
  EXPECT_THROW((void)larger(one, TypeParam(1, nan)), Undecided);
  EXPECT_THROW((void)length(Vec<2, TypeParam>{{TypeParam(nan), one}}), Undecided);
  EXPECT_TRUE(std::isnan(length(Vec<2, TypeParam>{{TypeParam(1, nan), one}}).radius));
  EXPECT_THROW((void)sqrt(TypeParam(nan)), Undecided);
}

}  // namespace
}  // namespace liecheck::oracles
