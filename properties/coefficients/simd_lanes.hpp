#pragma once
// Two scalars that run the library's templates on many floats at once: eight in lanes, and all between two.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <liecheck/scalar/scalar.hpp>
#include <limits>

namespace liecheck::properties {

/// Eight floats side by side: each lane holds, bit for bit, what float itself would. No branches: they are
/// declared for the concept alone, and do not link.
struct Lanes {
  static constexpr int count = 8;
  using Lane = float;
  using SideBySide = void;
  using Half = float __attribute__((vector_size(16)));
  Half a, b;

  Lanes() = default;
  Lanes(Half low, Half high) : a(low), b(high) {}
  Lanes(float x) : a{x, x, x, x}, b{x, x, x, x} {}
  Lanes(int x) : Lanes(static_cast<float>(x)) {}

  friend Lanes operator+(const Lanes& x, const Lanes& y) { return {x.a + y.a, x.b + y.b}; }
  friend Lanes operator-(const Lanes& x, const Lanes& y) { return {x.a - y.a, x.b - y.b}; }
  friend Lanes operator-(const Lanes& x) { return {-x.a, -x.b}; }
  friend Lanes operator*(const Lanes& x, const Lanes& y) { return {x.a * y.a, x.b * y.b}; }
  friend Lanes operator/(const Lanes& x, const Lanes& y) { return {x.a / y.a, x.b / y.b}; }
  Lanes& operator*=(const Lanes& y) { return *this = *this * y; }
  /// The library's, found first by argument-dependent look-up: fused where float's is.
  friend Lanes mul_add(const Lanes& x, const Lanes& y, const Lanes& z) {
#if defined(__FMA__)
    Lanes r;
    for (int i = 0; i < 4; ++i)
      r.a[i] = std::fma(x.a[i], y.a[i], z.a[i]), r.b[i] = std::fma(x.b[i], y.b[i], z.b[i]);
    return r;
#else
    return x * y + z;
#endif
  }

  friend bool operator<(const Lanes&, const Lanes&);
  friend Lanes sqrt(const Lanes&);
  friend Lanes sin(const Lanes&);
  friend Lanes cos(const Lanes&);
  friend Lanes atan2(const Lanes&, const Lanes&);
  friend Lanes fabs(const Lanes&);
  friend Lanes ldexp(const Lanes& x, int e) {
    return x * Lanes(std::ldexp(1.0F, e));
  }
  friend bool isfinite(const Lanes&);
};

/// Every float from low to high. Rounding to nearest is monotone, so what an operation returns for any operands
/// between lies between what it returns at their ends: results hold every float that the code can return. An
/// answer that the ends do not settle (a comparison, a function of libm) sets `undecided`. It takes branches: it knows
/// where its ends would part.
struct Span {
  using Lane = float;
  float low, high;
  static inline thread_local bool undecided = false;

  Span() = default;
  Span(float from, float to) : low(from), high(to) {}
  Span(float x) : low(x), high(x) {}
  Span(int x) : Span(static_cast<float>(x)) {}

  static Span of(std::initializer_list<float> corners) {
    const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
    return {*least, *most};
  }
  static Span unknown() {
    undecided = true;
    return 0;
  }
  friend Span operator+(const Span& x, const Span& y) { return {x.low + y.low, x.high + y.high}; }
  friend Span operator-(const Span& x, const Span& y) { return {x.low - y.high, x.high - y.low}; }
  friend Span operator-(const Span& x) { return {-x.high, -x.low}; }
  friend Span operator*(const Span& x, const Span& y) {
    return of({x.low * y.low, x.low * y.high, x.high * y.low, x.high * y.high});
  }
  friend Span operator/(const Span& x, const Span& y) {
    if (y.low <= 0 && y.high >= 0) return unknown();
    return of({x.low / y.low, x.low / y.high, x.high / y.low, x.high / y.high});
  }
  Span& operator*=(const Span& y) { return *this = *this * y; }
  friend Span mul_add(const Span& x, const Span& y, const Span& z) {
#if defined(__FMA__)
    const Span lows = of({std::fma(x.low, y.low, z.low), std::fma(x.low, y.high, z.low),
                          std::fma(x.high, y.low, z.low), std::fma(x.high, y.high, z.low)}),
               highs = of({std::fma(x.low, y.low, z.high), std::fma(x.low, y.high, z.high),
                           std::fma(x.high, y.low, z.high), std::fma(x.high, y.high, z.high)});
    return {lows.low, highs.high};
#else
    return x * y + z;
#endif
  }
  friend bool operator<=(const Span& x, const Span& y) {
    if (!(x.high <= y.low || x.low > y.high)) undecided = true;
    return x.high <= y.low;
  }
  friend bool operator<(const Span& x, const Span& y) {
    if (!(x.high < y.low || x.low >= y.high)) undecided = true;
    return x.high < y.low;
  }
  friend Span sqrt(const Span& x) {
    return {std::sqrt(x.low), std::sqrt(x.high)};
  }
  friend Span sin(const Span&) {
    return unknown();
  }
  friend Span cos(const Span&) {
    return unknown();
  }
  friend Span atan2(const Span&, const Span&) {
    return unknown();
  }
  friend Span fabs(const Span&) {
    return unknown();
  }
  friend Span ldexp(const Span& x, int e) {
    return {std::ldexp(x.low, e), std::ldexp(x.high, e)};
  }
  friend bool isfinite(const Span& x) {
    return std::isfinite(x.low) && std::isfinite(x.high);
  }
};

}  // namespace liecheck::properties

template <>
struct std::numeric_limits<liecheck::properties::Lanes> : std::numeric_limits<float> {};
template <>
struct std::numeric_limits<liecheck::properties::Span> : std::numeric_limits<float> {};
