#pragma once
// Intervals of doubles that contain the exact result of each operation. Every end is moved outwards by at least one
// unit in its last place, so that they hold in round-to-nearest, the only rounding mode in which this program judges.

#include <algorithm>
#include <cmath>
#include <limits>

namespace liecheck::properties {

/// [low, high].
struct Interval {
  double low = 0, high = 0;

  Interval() = default;
  constexpr Interval(double x) : low(x), high(x) {}
  constexpr Interval(double l, double h) : low(l), high(h) {}
  /// [-x, x].
  static Interval around_zero(double x) { return {-x, x}; }

  bool is(double x) const { return low == x && high == x; }
  bool is_point() const { return low == high; }
  /// max |x| and min |x| over the interval.
  double largest() const { return std::max(std::fabs(low), std::fabs(high)); }
  double least() const { return low > 0 ? low : high < 0 ? -high : 0; }
  /// A point inside, and the largest distance from it.
  double middle() const { return low == high ? low : low / 2 + high / 2; }
  double radius() const {
    const double m = middle();
    return up(std::max(high - m, m - low));
  }

  friend Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
  friend Interval operator+(const Interval& a, const Interval& b) {
    if (b.is(0)) return a;
    if (a.is(0)) return b;
    return {down(a.low + b.low), up(a.high + b.high)};
  }
  friend Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    if (a.is(0) || b.is(0)) return 0.;
    if (a.is(1)) return b;
    if (b.is(1)) return a;
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return {down(std::min({p, q, r, s})), up(std::max({p, q, r, s}))};
  }
  /// Precondition: 0 is not in b.
  friend Interval operator/(const Interval& a, const Interval& b) {
    const double p = a.low / b.low, q = a.low / b.high, r = a.high / b.low, s = a.high / b.high;
    return {down(std::min({p, q, r, s})), up(std::max({p, q, r, s}))};
  }
  friend Interval square(const Interval& a) {
    const double l = a.least(), h = a.largest();
    return {std::max(0., down(l * l)), up(h * h)};
  }
  /// Precondition: a >= 0.
  friend Interval sqrt(const Interval& a) {
    return {std::max(0., down(std::sqrt(a.low))), up(std::sqrt(a.high))};
  }
  friend Interval intersection(const Interval& a, const Interval& b) {
    return {std::max(a.low, b.low), std::min(a.high, b.high)};
  }

  static double up(double x) { return x + (std::fabs(x) * 0x1p-52 + least_step); }
  static double down(double x) { return x - (std::fabs(x) * 0x1p-52 + least_step); }

 private:
  static constexpr double least_step = std::numeric_limits<double>::denorm_min();
};

}  // namespace liecheck::properties
