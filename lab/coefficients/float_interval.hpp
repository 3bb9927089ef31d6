#pragma once
// Interval arithmetic on floats, as a scalar type for the library's templates.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <liecheck/scalar/scalar.hpp>
#include <limits>

namespace liecheck::properties {

/// All floats in [low, high]. Rounding to nearest is monotone, so that the results of an operation lie
/// between its results at the ends of the operands. An interval therefore contains every float that the code
/// can return. A comparison or function that the ends do not determine sets `undecided`.
struct FloatInterval {
  using Lane = float;
  float low, high;
  static inline thread_local bool undecided = false;

  FloatInterval() = default;
  FloatInterval(float from, float to) : low(from), high(to) {}
  FloatInterval(float x) : low(x), high(x) {}
  FloatInterval(int x) : FloatInterval(static_cast<float>(x)) {}

  static FloatInterval of(std::initializer_list<float> corners) {
    const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
    return {*least, *most};
  }
  static FloatInterval unknown() {
    undecided = true;
    return 0;
  }
  friend FloatInterval operator+(const FloatInterval& x, const FloatInterval& y) {
    return {x.low + y.low, x.high + y.high};
  }
  friend FloatInterval operator-(const FloatInterval& x, const FloatInterval& y) {
    return {x.low - y.high, x.high - y.low};
  }
  friend FloatInterval operator-(const FloatInterval& x) { return {-x.high, -x.low}; }
  friend FloatInterval operator*(const FloatInterval& x, const FloatInterval& y) {
    return of({x.low * y.low, x.low * y.high, x.high * y.low, x.high * y.high});
  }
  friend FloatInterval operator/(const FloatInterval& x, const FloatInterval& y) {
    if (y.low <= 0 && y.high >= 0) return unknown();
    return of({x.low / y.low, x.low / y.high, x.high / y.low, x.high / y.high});
  }
  FloatInterval& operator*=(const FloatInterval& y) { return *this = *this * y; }
  friend FloatInterval mul_add(const FloatInterval& x, const FloatInterval& y, const FloatInterval& z) {
#if defined(__FMA__)
    const FloatInterval lows = of({std::fma(x.low, y.low, z.low), std::fma(x.low, y.high, z.low),
                                   std::fma(x.high, y.low, z.low), std::fma(x.high, y.high, z.low)}),
                        highs = of({std::fma(x.low, y.low, z.high), std::fma(x.low, y.high, z.high),
                                    std::fma(x.high, y.low, z.high), std::fma(x.high, y.high, z.high)});
    return {lows.low, highs.high};
#else
    return x * y + z;
#endif
  }
  friend bool operator<=(const FloatInterval& x, const FloatInterval& y) {
    if (!(x.high <= y.low || x.low > y.high)) undecided = true;
    return x.high <= y.low;
  }
  friend bool operator<(const FloatInterval& x, const FloatInterval& y) {
    if (!(x.high < y.low || x.low >= y.high)) undecided = true;
    return x.high < y.low;
  }
  friend FloatInterval sqrt(const FloatInterval& x) {
    return {std::sqrt(x.low), std::sqrt(x.high)};
  }
  friend FloatInterval sin(const FloatInterval&) {
    return unknown();
  }
  friend FloatInterval cos(const FloatInterval&) {
    return unknown();
  }
  friend FloatInterval atan2(const FloatInterval&, const FloatInterval&) {
    return unknown();
  }
  friend FloatInterval fabs(const FloatInterval&) {
    return unknown();
  }
  friend FloatInterval ldexp(const FloatInterval& x, int e) {
    return {std::ldexp(x.low, e), std::ldexp(x.high, e)};
  }
  friend bool isfinite(const FloatInterval& x) {
    return std::isfinite(x.low) && std::isfinite(x.high);
  }
};

}  // namespace liecheck::properties

template <>
struct std::numeric_limits<liecheck::properties::FloatInterval> : std::numeric_limits<float> {};
