#pragma once
// Ball arithmetic (midpoint-radius interval arithmetic): a ball is a number that lies within r of m. Every
// operation adds its rounding error to r, so that the radius of a result is a proved bound of its error. If
// the radius is too large to decide a comparison, Undecided is thrown. The caller then uses the oracle at 50
// and 100 digits (Ziv 1991).
//
// The midpoint is a double, which decides most cases in float, a double-double, or a Real of 168 bits. Radii
// are computed in rounding to nearest. Each step increases them by a relative 2^-50, which exceeds its at most
// four roundings. If a product is so small that its rounding error may underflow, 2^-1060 is added to the radius.

#include <bit>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>
#include <oracles/double_double.hpp>
#include <oracles/real.hpp>
#include <oracles/undecided.hpp>
#include <tuple>

namespace liecheck::oracles {

/// How a midpoint type rounds. head(m) is a double within 2^-52 |m| of m. The constants bound the relative
/// errors of the operations, of the sine and cosine of a small angle, and of stumpff_series. The error of a sum is
/// relative to |a| + |b|.
template <class M>
struct Rounding;
template <>
struct Rounding<double> {
  static constexpr int bits = 53;
  static constexpr double add = 0x1p-53, multiply = 0x1p-53, divide = 0x1p-53, root = 0x1p-53,
                          small_sine = 0x1p-52, stumpff = 0x1p-51;
  static double head(double m) { return m; }
  static double tail(double) { return 0; }
  static double make(double x) { return x; }
  static double scaled(double m, double factor) { return m * factor; }
  /// True if both numbers have at most 26 significant bits, so that a b is exact.
  static bool exact_product(double a, double b) {
    const auto low = [](double x) { return std::bit_cast<std::uint64_t>(x) & ((1u << 27) - 1); };
    return (low(a) | low(b)) == 0;
  }
  /// The rounded sum of two exact numbers. `radius` is set to a bound of its error.
  static double exact_sum(double a, double b, double& radius) {
    const DoubleDouble s = dd::two_sum(a, b);
    radius = std::fabs(s.low);
    return s.high;
  }
};
template <>
struct Rounding<DoubleDouble> {
  static constexpr int bits = 106;
  static constexpr double add = 0x1p-103, multiply = 0x1p-103, divide = 0x1p-101, root = 0x1p-104,
                          small_sine = 0x1p-102, stumpff = 0x1p-101;
  static double head(const DoubleDouble& m) { return m.high; }
  static double tail(const DoubleDouble& m) { return m.low; }
  static DoubleDouble make(double x) { return {x, 0}; }
  static DoubleDouble scaled(const DoubleDouble& m, double factor) {
    return {m.high * factor, m.low * factor};
  }
  static bool exact_product(const DoubleDouble& a, const DoubleDouble& b) { return a.low == 0 && b.low == 0; }
  static DoubleDouble exact_sum(const DoubleDouble& a, const DoubleDouble& b, double& radius) {
    const DoubleDouble m = accurate_sum(a, b);
    const bool exact = (a.low == 0 && b.low == 0) || (a.high == -b.high && a.low == -b.low);
    radius = exact ? 0 : add * std::fabs(m.high) * (1 + 0x1p-50);
    return m;
  }
};
/// Every operation on a Real has an error of at most 2^-168 of its result, sums too.
template <>
struct Rounding<Real> {
  static constexpr int bits = 168;
  static constexpr double add = 0x1p-167, multiply = 0x1p-167, divide = 0x1p-167, root = 0x1p-167;
  /// From the first 64 of its bits, which are in one word.
  static double head(const Real& m) {
    const auto* x = m.backend().data();
    const long exponent = mpfr_custom_get_exp(x);
    if (!mpfr_regular_p(x) || exponent < -900 || exponent > 1000) return mpfr_get_d(x, MPFR_RNDN);
    const auto first = static_cast<const mp_limb_t*>(mpfr_custom_get_significand(x))[(bits - 1) / 64];
    const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent - 64) << 52);
    const double size = static_cast<double>(first) * scale;
    return mpfr_signbit(x) ? -size : size;
  }
  static double tail(const Real& m) { return head(m - head(m)); }
  static Real make(double x) { return x; }
  static Real scaled(const Real& m, double factor) { return m * factor; }
  static bool exact_product(const Real& a, const Real& b) {
    return mpfr_min_prec(a.backend().data()) + mpfr_min_prec(b.backend().data()) <= bits;
  }
  static Real exact_sum(const Real& a, const Real& b, double& radius) {
    Real m;
    const bool exact = mpfr_add(m.backend().data(), a.backend().data(), b.backend().data(), MPFR_RNDN) == 0;
    radius = exact ? 0 : add * std::fabs(head(m));
    return m;
  }
};

template <class M>
struct Ball {
  using Round = Rounding<M>;
  M m{};
  double r = 0;

  Ball() = default;
  Ball(double x) : m(Round::make(x)) {}  // NOLINT: exact, like int to double
  Ball(int x) : m(Round::make(x)) {}     // NOLINT
  Ball(const M& mid, double radius) requires(!std::same_as<M, double>) : m(mid), r(radius) {}
  Ball(double mid, double radius) : m(Round::make(mid)), r(radius) {}

  double head() const { return Round::head(m); }
  double size() const { return std::fabs(Round::head(m)); }
  bool exactly_zero() const { return Round::head(m) == 0 && r == 0; }

  Ball& operator+=(const Ball& b) { return *this = *this + b; }
  Ball& operator-=(const Ball& b) { return *this = *this - b; }
  Ball& operator*=(const Ball& b) { return *this = *this * b; }
  Ball& operator/=(const Ball& b) { return *this = *this / b; }

  friend Ball operator-(const Ball& a) { return {-a.m, a.r}; }
  [[gnu::always_inline]] friend inline Ball operator+(const Ball& a, const Ball& b) {
    if (a.r == 0 && b.r == 0) return exact_sum(a, b);
    const M m = a.m + b.m;
    return {m, up(a.r + b.r + Round::add * (a.size() + b.size()))};
  }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
  [[gnu::always_inline]] friend inline Ball operator*(const Ball& a, const Ball& b) {
    const M m = a.m * b.m;
    const double size = std::fabs(Round::head(m));
    if (!(size >= 0x1p-900)) return small_product(a, b, m);
    if (a.r == 0 && b.r == 0 && Round::exact_product(a.m, b.m)) return {m, 0};
    return {m, up(a.size() * b.r + b.size() * a.r + a.r * b.r + Round::multiply * size)};
  }
  friend Ball operator/(const Ball& a, const Ball& b) {
    const double least = b.size() - b.r;
    if (!(least > 0)) throw Undecided();
    if (a.exactly_zero()) return a;
    const M m = a.m / b.m;
    const double size = std::fabs(Round::head(m));
    double r = up((a.r + size * b.r) / least + Round::divide * size) * (1 + 0x1p-50);
    if (size < 0x1p-900 || a.size() < 0x1p-900) r += 0x1p-1060 + 0x1p-1060 / least;
    return {m, r};
  }

  /// The sign of a - b. Throws Undecided if the radii are too large to determine it.
  friend std::weak_ordering operator<=>(const Ball& a, const Ball& b) {
    const double high = a.head() - b.head(), low = Round::tail(a.m) - Round::tail(b.m), d = high + low;
    const double slack = a.r + b.r;
    if (slack == 0 && high == 0 && low == 0) return std::weak_ordering::equivalent;
    const double rounding = 0x1p-51 * (std::fabs(high) + std::fabs(low));
    if (!(std::fabs(d) > up(slack + rounding))) throw Undecided();
    return d > 0 ? std::weak_ordering::greater : std::weak_ordering::less;
  }
  friend bool operator==(const Ball& a, const Ball& b) { return (a <=> b) == 0; }

  friend Ball abs(const Ball& a) { return a.head() < 0 ? -a : a; }  // | |m| - |x| | <= |m - x| <= r
  friend bool isfinite(const Ball& a) { return std::isfinite(a.head()); }

  /// Precondition: the exact value x' is >= 0, as a sum of squares is. The root of the midpoint x has an
  /// error of at most sqrt |x - x'|. If x is far from zero, the smaller bound |x - x'| / sqrt(x) is used.
  friend Ball sqrt(const Ball& a) {
    if (a.exactly_zero()) return a;
    if (!(a.head() >= -a.r)) throw Undecided();
    using std::sqrt;
    const M m = a.head() > 0 ? M(sqrt(a.m)) : Round::make(0);
    const double size = Round::head(m);
    const double moved = a.head() > 4 * a.r ? a.r / size : std::sqrt(a.r + std::fabs(std::fmin(a.head(), 0)));
    double r = up(moved * (1 + 0x1p-50) + Round::root * size);
    if (a.size() < 0x1p-900) r += 0x1p-520;
    return {m, r};
  }
  /// 2^e a, exact unless it underflows.
  friend Ball power_scaled(const Ball& a, int e) {
    if (e < -1000 || e > 1000) return power_scaled(power_scaled(a, e / 2), e - e / 2);
    const auto factor = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + e) << 52);
    const M m = Round::scaled(a.m, factor);
    const double underflow = std::fabs(Round::head(m)) < 0x1p-960 ? 0x1p-1073 : 0;
    return {m, a.r * factor * (1 + 0x1p-50) + (a.exactly_zero() || e > 0 ? 0 : underflow)};
  }
  friend Ball doubled(const Ball& a) { return {Round::scaled(a.m, 2), 2 * a.r}; }

  /// a + b of two balls of radius 0. In double-double the error is relative to the sum even if it cancels,
  /// and the sum is exact for two doubles and for x and -x.
  static Ball exact_sum(const Ball& a, const Ball& b) {
    Ball sum;
    sum.m = Round::exact_sum(a.m, b.m, sum.r);
    return sum;
  }
  /// A product that may underflow; throws Undecided for one that overflowed (2^995 in double-double), which is NaN.
  static Ball small_product(const Ball& a, const Ball& b, const M& m) {
    if (std::isnan(Round::head(m))) throw Undecided();
    if (a.exactly_zero() || b.exactly_zero()) return Ball(0);
    return {m, up(a.size() * b.r + b.size() * a.r + a.r * b.r) + Round::multiply * std::fabs(Round::head(m)) +
                   0x1p-1060};
  }
  static double up(double x) { return x * (1 + 0x1p-50); }
};

using DoubleBall = Ball<double>;
using DoubleDoubleBall = Ball<DoubleDouble>;
using RealBall = Ball<Real>;

/// The ball types that check results, in the order in which they are tried. Midpoints need at least twice the digits of
/// the scalar, and have the exponent range of double: results in float are tried with both, those in double with the
/// second only.
using BallTiers = std::tuple<DoubleBall, DoubleDoubleBall>;

/// x with r added to its radius.
template <class M>
Ball<M> widened(Ball<M> x, double r) {
  x.r = Ball<M>::up(x.r + r);
  return x;
}

/// sin x and cos x; throws Undecided for |x| >= 2^40.
template <class M>
void sin_cos(const Ball<M>& x, Ball<M>& sine, Ball<M>& cosine);

/// The angle of (x, y) in (-pi, pi]; throws Undecided at the origin.
template <class M>
Ball<M> atan2(const Ball<M>& y, const Ball<M>& x);
template <>
void sin_cos(const RealBall& x, RealBall& sine, RealBall& cosine);
template <>
RealBall atan2(const RealBall& y, const RealBall& x);

/// c_k(x) = sum_j (-x)^j / (2j + k)! for k = 4, 5 or 6 and 0 <= x <= 1. Not for a RealBall.
template <class M>
Ball<M> stumpff_series(int k, const Ball<M>& x);

}  // namespace liecheck::oracles
