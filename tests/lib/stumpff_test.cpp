// Compares the small-angle coefficients with their closed forms in theta at 150 digits, which need no series. At
// theta = 1e-15 the worst closed form loses 75 digits by cancellation. tests/proofs proves the bounds of c0 to c5.

#include <gtest/gtest.h>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <liecheck/scalar/stumpff.hpp>
#include <random>
#include <vector>

#include "scalar_test.hpp"

namespace liecheck {
namespace {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<150>, boost::multiprecision::et_off>;

/// The closed forms at x = theta^2 > 0.
struct ClosedForms {
  Real c0, c1, c2, c3, c4, c5, d, d2;
  explicit ClosedForms(const Real& x) {
    const Real t = sqrt(x);
    c0 = cos(t);
    c1 = sin(t) / t;
    c2 = (1 - c0) / x;
    c3 = (1 - c1) / x;
    c4 = (Real(1) / 2 - c2) / x;
    c5 = (Real(1) / 6 - c3) / x;
    const Real half = t / 2;
    const Real alpha = half * cos(half) / sin(half);
    d = (1 - alpha) / x;
    // alpha = h cot h: d alpha / dx = (cot h - h / sin^2 h) / (4 t)
    const Real slope = (cos(half) / sin(half) - half / (sin(half) * sin(half))) / (4 * t);
    d2 = 2 * (-slope - d) / x;
  }
};

/// Values of theta^2 in [0, 9.8] (pi^2 = 9.87): chosen ones, log-uniform ones from 1e-30, uniform ones.
template <class S>
std::vector<S> squaredAngles() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-30, std::log10(9.8));
  std::vector<S> all{std::numeric_limits<S>::denorm_min(), S(1e-30), S(1), S(2.25), S(4), S(9)};
  for (int i = 0; i < 1500; ++i) all.push_back(S(std::pow(10.0, exponent(random))));
  for (int i = 0; i < 1500; ++i) all.push_back(S(9.8 * std::uniform_real_distribution<double>(0, 1)(random)));
  std::erase_if(all, [](S x) { return !within_pi(x); });
  return all;
}
SCALAR_SUITE(StumpffOf, float, double);

/// Expects that |ours - exact| / |exact| is at most `bound` eps over the sample. `ours` and `truth` are members or
/// functions.
template <class C, class S, class Ours, class Truth>
void expectWithin(double bound, Ours ours, Truth truth) {
  double most = 0;
  for (const S x : squaredAngles<S>()) {
    if (x < S(1e-30)) continue;  // too few digits are left; LimitsAtZeroAreExactToHalfAnUlp tests these
    const Real exact = std::invoke(truth, ClosedForms(Real(x)));
    const Real error = abs(Real(std::invoke(ours, C(x))) - exact) / abs(exact);
    const double in_eps = double(error) / double(eps<S>());
    EXPECT_TRUE(std::isfinite(in_eps)) << x;
    most = (std::max)(most, in_eps);
  }
  EXPECT_LE(most, bound);
}

SCALAR_TEST(StumpffOf, SlopesOfC2AndC3KeepTheirRelativeBounds) {
  expectWithin<HalfAngle<S>, S>(2.6, &HalfAngle<S>::second_slope,
                                [](const ClosedForms& f) { return Real(f.c3 - 2 * f.c4); });
  expectWithin<HalfAngle<S>, S>(2.4, &HalfAngle<S>::third_slope,
                                [](const ClosedForms& f) { return Real(f.c4 - 3 * f.c5); });
}

SCALAR_TEST(StumpffOf, InverseCoefficientAndItsSlopeKeepTheirBounds) {
  expectWithin<InverseCoefficient<S>, S>(2.6, &InverseCoefficient<S>::d, &ClosedForms::d);
  expectWithin<InverseCoefficient<S>, S>(5, &InverseCoefficient<S>::d2, &ClosedForms::d2);
}

SCALAR_TEST(StumpffOf, HalfAnglesKeepTheirBounds) {
  // HalfAngle(x) has the coefficients at x/4: c0 = cos(theta/2), sine_over_angle() = sin(theta/2) / theta.
  // The references are computed from theta/2 at 150 digits.
  double sine = 0, cosine = 0;
  for (const S x : squaredAngles<S>()) {
    if (x < S(1e-30)) continue;
    const Real t = sqrt(Real(x));
    const Real s = sin(t / 2) / t, c = cos(t / 2);
    sine = (std::max)(sine, double(abs(Real(HalfAngle<S>(x).sine_over_angle()) - s) / s));
    cosine = (std::max)(cosine, double(abs(Real(HalfAngle<S>(x).c0) - c)));
  }
  EXPECT_LE(sine / double(eps<S>()), 0.6);
  EXPECT_LE(cosine / double(eps<S>()), 0.6);
}

SCALAR_TEST(StumpffOf, LimitsAtZeroAreExactToHalfAnUlp) {
  for (const S x : {S(0), std::numeric_limits<S>::denorm_min()}) {
    const HalfAngle<S> c(x);
    EXPECT_EQ(c.c0, S(1));
    EXPECT_EQ(c.c1, S(1));
    EXPECT_EQ(c.c2, S(1) / S(2));
    EXPECT_EQ(c.c3, S(1) / S(6));
    EXPECT_EQ(c.c4, S(1) / S(24));
    EXPECT_EQ(c.c5, S(1) / S(120));
    EXPECT_NEAR(double(c.second_slope() * S(12)), 1, 2 * double(eps<S>()));
    EXPECT_NEAR(double(c.third_slope() * S(60)), 1, 2 * double(eps<S>()));
    EXPECT_NEAR(double(InverseCoefficient<S>(x).d * S(12)), 1, 2 * double(eps<S>()));
    EXPECT_NEAR(double(InverseCoefficient<S>(x).d2 * S(360)), 1, 4 * double(eps<S>()));
    EXPECT_EQ(c.sine_over_angle(), S(1) / S(2));
  }
}

SCALAR_TEST(StumpffOf, WithinPiEndsAtPi) {
  EXPECT_TRUE(within_pi(S(9.8696)));
  EXPECT_FALSE(within_pi(S(9.8697)));
  EXPECT_FALSE(within_pi(std::numeric_limits<S>::infinity()));
  EXPECT_FALSE(within_pi(std::numeric_limits<S>::quiet_NaN()));
}

SCALAR_TEST(StumpffOf, LogarithmCoefficientsAreRightAtZeroAndPi) {
  const LogarithmCoefficients<S> zero(S(0), S(1)), at_pi(S(1), S(0));
  EXPECT_EQ(zero.angle_over_sine, S(2));
  EXPECT_EQ(zero.alpha, S(1));
  EXPECT_EQ(zero.along, S(0));
  EXPECT_NEAR(double(at_pi.angle_over_sine / pi<S>()), 1, 1.5 * double(eps<S>()));
  EXPECT_EQ(at_pi.alpha, S(0));
  EXPECT_EQ(at_pi.along, S(1));
}

SCALAR_TEST(StumpffOf, LogarithmCoefficientsKeepTheirBoundsForAllAngles) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-18, 0);
  double ratio = 0, alpha = 0;
  for (int i = 0; i < 1500; ++i) {
    const S sine = S(std::pow(10.0, exponent(random)));
    const S cosine =
        S(i % 2 == 0 ? std::sqrt(1 - double(sine) * double(sine)) : std::pow(10.0, exponent(random)));
    const S squared = sine * sine;
    const LogarithmCoefficients<S> ours(squared, cosine);
    const Real s = sqrt(Real(squared)), h = atan2(s, Real(cosine));
    ratio = (std::max)(ratio, double(abs(Real(ours.angle_over_sine) * s / (2 * h) - 1)));
    alpha = (std::max)(alpha, double(abs(Real(ours.alpha) * s / (h * Real(cosine)) - 1)));
  }
  EXPECT_LE(ratio / double(eps<S>()), 2.5);
  EXPECT_LE(alpha / double(eps<S>()), 3.5);
}

SCALAR_TEST(StumpffOf, LogarithmCoefficientsOfNearRotationsKeepTheirBounds) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> exponent(-18, -8 * std::log10(2.0)), side(-1, 1);
  double ratio = 0, along = 0;
  for (int i = 0; i < 1500; ++i) {
    const S squared = i == 0 ? S(1) / S(256) : S(std::pow(10.0, exponent(random)));
    const S excess = S(side(random)) * std::sqrt(eps<S>() / S(8));
    const auto ours = LogarithmCoefficients<S>::near(squared, excess);
    const Real s = sqrt(Real(squared)), c = sqrt(1 + Real(excess) - s * s), h = atan2(s, c);
    ratio = (std::max)(ratio, double(abs(Real(ours.angle_over_sine) * s / (2 * h) - 1)));
    along = (std::max)(along, double(abs(Real(ours.along) / ((1 - h * c / s) / (s * s)) - 1)));
  }
  EXPECT_LE(ratio / double(eps<S>()), 0.75);
  EXPECT_LE(along / double(eps<S>()), 2);
}

}  // namespace
}  // namespace liecheck
