// Ball arithmetic: what it returns contains the exact value, and the radius stays small.

#include <gtest/gtest.h>
#include <oracles/closed.hpp>
#include <oracles/fast_error.hpp>
#include <random>

namespace liecheck::oracles {
namespace {

Real mid(const FastDouble& b) {
  return exact<Real>(b);
}
/// |mid - exact| as a share of the radius; 0 where both are 0.
double share(const FastDouble& b, const Real& value) {
  const double d = static_cast<double>(Real(abs(mid(b) - value)));
  return d == 0 ? 0 : b.r > 0 ? d / b.r : std::numeric_limits<double>::infinity();
}

class BallTest : public testing::Test {
 protected:
  double number(double decades) {
    const double x = std::pow(10.0, std::uniform_real_distribution<double>(-decades, decades)(random_));
    return random_() % 2 ? x : -x;
  }
  std::mt19937_64 random_{5};
};

TEST_F(BallTest, OperationsContainTheExactResult) {
  for (int i = 0; i < 20000; ++i) {
    const double a = number(120), b = number(120), c = number(3);
    const Real A(a), B(b), C(c);
    const FastDouble third = FastDouble(c) / FastDouble(3);
    EXPECT_LE(share(third, C / 3), 1);
    EXPECT_LE(share(FastDouble(a) * third + FastDouble(b), A * C / 3 + B), 1);
    EXPECT_LE(share(FastDouble(a) * FastDouble(b), A * B), 1);
    EXPECT_LE(share(third * third - third, C * C / 9 - C / 3), 1);
    EXPECT_LE(share(sqrt(FastDouble(std::fabs(a)) * FastDouble(std::fabs(c))), sqrt(Real(abs(A * C)))), 1);
    EXPECT_LE(share(atan2(FastDouble(c), FastDouble(b)), atan2(C, B)), 1);
  }
}

TEST_F(BallTest, SineAndCosineContainTheExactResultWithinTwoToTheMinusHundred) {
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 ? number(4) : number(20) * 1e-18;
    FastDouble s, c;
    sin_cos(FastDouble(x), s, c);
    EXPECT_LE(share(s, sin(Real(x))), 1) << x;
    EXPECT_LE(share(c, cos(Real(x))), 1) << x;
    EXPECT_LE(s.r, 0x1p-100 * std::fmax(1.0, std::fabs(x)));
  }
}

TEST_F(BallTest, StumpffSeriesContainTheClosedForm) {
  for (int i = 0; i < 5000; ++i) {
    const double x = std::uniform_real_distribution<double>(1e-6, 1)(random_);
    const Real X(x), t = sqrt(X);
    const Real c4 = (Real(1) / 2 - (1 - cos(t)) / X) / X, c5 = (Real(1) / 6 - (1 - sin(t) / t) / X) / X;
    EXPECT_LE(share(stumpff_series(4, FastDouble(x)), c4), 1);
    EXPECT_LE(share(stumpff_series(5, FastDouble(x)), c5), 1);
  }
}

TEST_F(BallTest, ClosedFormsContainThoseAtHundredDigits) {
  const auto contains = [](const auto& ball, const auto& exact, const char* what) {
    for (std::size_t i = 0; i < ball.x.size(); ++i)
      EXPECT_LE(share(ball.x[i], Real(exact.x[i])), 1) << what << i << " " << ball.x[i].head();
  };
  for (int i = 0; i < 3000; ++i) {
    Vec6<FastDouble> xi;
    const double scale = number(i % 3 == 0 ? 40 : 1);
    for (int k = 0; k < 6; ++k) xi[k] = FastDouble(number(1) * (k < 3 ? 1 : scale));
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
      EXPECT_LT(log[0].r, 1e-20 * (1 + log[0].size()));
    } catch (const Undecided&) {
    }
  }
}

TEST_F(BallTest, APolarFactorContainsTheOneAtHundredDigits) {
  for (int i = 0; i < 2000; ++i) {
    Vec3<FastDouble> phi;
    for (int k = 0; k < 3; ++k) phi[k] = FastDouble(number(i % 2 ? 0.4 : 8) * (i % 2 ? 1 : 1e-8));
    const Mat3<FastDouble> R = rotation_matrix(closed_exp(stack(zero_vector<3, FastDouble>(), phi)).Q);
    Mat3<FastDouble> stored;
    for (std::size_t k = 0; k < 9; ++k)
      stored.x[k] = FastDouble(R.x[k].head() * (1 + 3e-16 * (random_() % 5)));
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

TEST_F(BallTest, ComparisonsThatTheRadiusLeavesOpenThrow) {
  const FastDouble third = FastDouble(1) / FastDouble(3);
  EXPECT_THROW((void)(third * FastDouble(3) == FastDouble(1)), Undecided);
  EXPECT_THROW((void)(third * FastDouble(3) < FastDouble(1)), Undecided);
  EXPECT_TRUE(third < FastDouble(0.34));
  EXPECT_TRUE(FastDouble(0.5) * FastDouble(2) == FastDouble(1));  // exact
  EXPECT_THROW(FastDouble(1) / (third - third), Undecided);
  EXPECT_THROW(settled(3, 1e-3), Undecided);
  EXPECT_EQ(settled(3, 1e-5), 3);
  EXPECT_GT(settled(0, 1e-9), 0);  // not known to be exactly zero
  EXPECT_EQ(settled(0, 0), 0);
  EXPECT_THROW(settled(std::nan(""), 0 * std::nan("")), Undecided);
}

}  // namespace
}  // namespace liecheck::oracles
