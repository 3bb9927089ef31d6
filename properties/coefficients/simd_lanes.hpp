#pragma once
// A scalar that runs the library's templates on eight floats at once.

#include <cmath>
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

}  // namespace liecheck::properties

template <>
struct std::numeric_limits<liecheck::properties::Lanes> : std::numeric_limits<float> {};
