#pragma once
// A dual number: a value and its derivatives in N directions, as automatic differentiation carries them along.

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace liecheck::test {

template <int N>
struct Dual {
  double v = 0;
  Eigen::Matrix<double, N, 1> d = Eigen::Matrix<double, N, 1>::Zero();

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: numbers are constants
  Dual(double value, Eigen::Matrix<double, N, 1> derivatives) : v(value), d(std::move(derivatives)) {}

  Dual operator-() const { return {-v, -d}; }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.d * b.v + a.v * b.d}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.v / b.v;
    return {q, (a.d - q * b.d) / b.v};
  }
  friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v; }
  friend bool operator!=(const Dual& a, const Dual& b) { return a.v != b.v; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.v >= b.v; }

  friend Dual sqrt(const Dual& a) { return {std::sqrt(a.v), a.d / (2 * std::sqrt(a.v))}; }
  friend Dual sin(const Dual& a) { return {std::sin(a.v), std::cos(a.v) * a.d}; }
  friend Dual cos(const Dual& a) { return {std::cos(a.v), -std::sin(a.v) * a.d}; }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const double n = x.v * x.v + y.v * y.v;
    return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / n};
  }
  friend Dual fabs(const Dual& a) { return a.v < 0 ? -a : a; }
  friend Dual abs(const Dual& a) { return fabs(a); }
  friend Dual ldexp(const Dual& a, int e) { return {std::ldexp(a.v, e), a.d * std::ldexp(1.0, e)}; }
  friend Dual frexp(const Dual& a, int* e) {
    const double f = std::frexp(a.v, e);
    return {f, a.d * std::ldexp(1.0, -*e)};
  }
  friend bool isfinite(const Dual& a) { return std::isfinite(a.v); }
  friend bool isnan(const Dual& a) { return std::isnan(a.v); }
};

}  // namespace liecheck::test

template <int N>
struct std::numeric_limits<liecheck::test::Dual<N>> : std::numeric_limits<double> {
  static liecheck::test::Dual<N> epsilon() { return std::numeric_limits<double>::epsilon(); }
  static liecheck::test::Dual<N> min() { return std::numeric_limits<double>::min(); }
  static liecheck::test::Dual<N> max() { return std::numeric_limits<double>::max(); }
};

template <int N>
struct Eigen::NumTraits<liecheck::test::Dual<N>> : Eigen::NumTraits<double> {
  using Real = liecheck::test::Dual<N>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = N,
    MulCost = 2 * N
  };
};
