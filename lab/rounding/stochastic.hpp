#pragma once
// A double whose operations round up or down by chance: random rounding, or stochastic arithmetic (Vignes 1993,
// CESTAC). The spread of several runs estimates the digits of a result that rounding errors leave, without
// knowing the exact one.

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <cstdint>
#include <liecheck/scalar/double_word.hpp>
#include <limits>
#include <set>
#include <utility>

namespace liecheck::properties {

/// How the operations of this thread round.
struct RandomRounding {
  /// Error-free transformations (two_sum, fast_two_sum, two_prod) are exact as in double. If false, their
  /// steps round at random too, which their proofs do not allow.
  bool exempt = true;
  /// If set, only operations called from this address round at random, all others to nearest.
  const void* only = nullptr;
  /// If set, receives the addresses from which operations were called that rounded.
  std::set<const void*>* sites = nullptr;
  std::uint64_t state = 1;  ///< of the random bits (Marsaglia 2003, xorshift64*); not 0

  static RandomRounding& of_thread() {
    thread_local RandomRounding own;
    return own;
  }
  /// `nearest` or, with a probability of one half, the neighbour towards the exact value nearest + error.
  double round(double nearest, double error, const void* site) {
    if (error == 0 || !std::isfinite(nearest) || !std::isfinite(error)) return nearest;
    if (sites) sites->insert(site);
    if ((only && site != only) || !bit()) return nearest;
    return std::nextafter(nearest, error > 0 ? HUGE_VAL : -HUGE_VAL);
  }
  /// A value of a mathematical library, whose error has an unknown sign. Sines and cosines stay within 1.
  double round_either_way(double value, const void* site) {
    return round(value, (value == 1 || bit()) && value != -1 ? -1 : 1, site);
  }

 private:
  bool bit() {
    state ^= state >> 12, state ^= state << 25, state ^= state >> 27;
    return (state * 0x2545f4914f6cdd1d) >> 63;
  }
};

struct Stochastic {
  double v;

  Stochastic() = default;
  constexpr Stochastic(int x) : v(x) {}
  constexpr Stochastic(double x) : v(x) {}
  explicit constexpr operator double() const { return v; }
  explicit constexpr operator int() const { return static_cast<int>(v); }

  // Not inlined, so that the return address tells which line rounded.
  [[gnu::noinline]] friend Stochastic operator+(const Stochastic& a, const Stochastic& b) {
    return rounded(two_sum<double>(a.v, b.v), __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic operator-(const Stochastic& a, const Stochastic& b) {
    return rounded(two_sum<double>(a.v, -b.v), __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic operator*(const Stochastic& a, const Stochastic& b) {
    const double p = a.v * b.v;
    return rounded({p, std::fma(a.v, b.v, -p)}, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic operator/(const Stochastic& a, const Stochastic& b) {
    const double q = a.v / b.v, remainder = std::fma(-q, b.v, a.v);
    return rounded({q, b.v < 0 ? -remainder : remainder}, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic sqrt(const Stochastic& a) {
    const double r = std::sqrt(a.v);
    return rounded({r, std::fma(-r, r, a.v)}, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic sin(const Stochastic& a) {
    return either(std::sin(a.v), a.v == 0, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic cos(const Stochastic& a) {
    return either(std::cos(a.v), a.v == 0, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic acos(const Stochastic& a) {
    return either(std::acos(a.v), a.v == 1, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic asin(const Stochastic& a) {
    return either(std::asin(a.v), a.v == 0, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Stochastic atan2(const Stochastic& y, const Stochastic& x) {
    return either(std::atan2(y.v, x.v), y.v == 0, __builtin_return_address(0));
  }
  friend Stochastic operator-(const Stochastic& a) { return -a.v; }
  Stochastic& operator+=(const Stochastic& b) { return *this = *this + b; }
  Stochastic& operator-=(const Stochastic& b) { return *this = *this - b; }
  Stochastic& operator*=(const Stochastic& b) { return *this = *this * b; }
  Stochastic& operator/=(const Stochastic& b) { return *this = *this / b; }
  friend auto operator<=>(const Stochastic&, const Stochastic&) = default;

  friend Stochastic fabs(const Stochastic& a) { return std::fabs(a.v); }
  friend Stochastic abs(const Stochastic& a) { return std::fabs(a.v); }
  friend Stochastic floor(const Stochastic& a) { return std::floor(a.v); }
  friend Stochastic ldexp(const Stochastic& a, int e) { return std::ldexp(a.v, e); }
  friend Stochastic frexp(const Stochastic& a, int* e) { return std::frexp(a.v, e); }
  friend bool isfinite(const Stochastic& a) { return std::isfinite(a.v); }

 private:
  static Stochastic rounded(const DoubleWord<double>& exact, const void* site) {
    return RandomRounding::of_thread().round(exact.high, exact.low, site);
  }
  static Stochastic either(double value, bool exact, const void* site) {
    return exact ? value : RandomRounding::of_thread().round_either_way(value, site);
  }
};

}  // namespace liecheck::properties

template <>
struct std::numeric_limits<liecheck::properties::Stochastic> : std::numeric_limits<double> {
  using S = liecheck::properties::Stochastic;
  static constexpr S epsilon() { return std::numeric_limits<double>::epsilon(); }
  static constexpr S min() { return std::numeric_limits<double>::min(); }
  static constexpr S max() { return std::numeric_limits<double>::max(); }
  static constexpr S lowest() { return std::numeric_limits<double>::lowest(); }
  static constexpr S infinity() { return std::numeric_limits<double>::infinity(); }
  static constexpr S quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
  static constexpr S denorm_min() { return std::numeric_limits<double>::denorm_min(); }
};

template <>
struct Eigen::NumTraits<liecheck::properties::Stochastic>
    : Eigen::GenericNumTraits<liecheck::properties::Stochastic> {
  using Real = liecheck::properties::Stochastic;
  static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static Real dummy_precision() { return Real(1e-12); }
  static int digits10() { return std::numeric_limits<double>::digits10; }
};

namespace liecheck {

namespace stochastic_detail {
using properties::Stochastic, properties::RandomRounding;
inline DoubleWord<Stochastic> exact(const DoubleWord<double>& x) {
  return {Stochastic(x.high), Stochastic(x.low)};
}
}  // namespace stochastic_detail

template <>
inline DoubleWord<properties::Stochastic> two_sum(const properties::Stochastic& a,
                                                  const properties::Stochastic& b) {
  if (properties::RandomRounding::of_thread().exempt)
    return stochastic_detail::exact(two_sum<double>(a.v, b.v));
  const properties::Stochastic s = a + b, b_virtual = s - a, a_virtual = s - b_virtual;
  return {s, (a - a_virtual) + (b - b_virtual)};
}
template <>
inline DoubleWord<properties::Stochastic> fast_two_sum(const properties::Stochastic& a,
                                                       const properties::Stochastic& b) {
  if (properties::RandomRounding::of_thread().exempt)
    return stochastic_detail::exact(two_sum<double>(a.v, b.v));
  const properties::Stochastic s = a + b;
  return {s, b - (s - a)};
}
template <>
inline DoubleWord<properties::Stochastic> two_prod(const properties::Stochastic& a,
                                                   const properties::Stochastic& b) {
  if (properties::RandomRounding::of_thread().exempt) {
    const double p = a.v * b.v;
    return {properties::Stochastic(p), properties::Stochastic(std::fma(a.v, b.v, -p))};
  }
  const properties::Stochastic p = a * b;
  const auto [ah, al] = split(a);
  const auto [bh, bl] = split(b);
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

}  // namespace liecheck
