#pragma once
// Double-double arithmetic: x = high + low, |low| <= ulp(high) / 2, 106 bits in the exponent range of double.
//
// Bounds of the relative errors, u = 2^-53, if nothing underflows or overflows (Joldes, Muller & Popescu
// 2017, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic"):
//   a + b   5 u^2 of |a| + |b|   algorithm 5; there is no bound relative to the sum
//   a b     5 u^2    algorithm 11
//   a / b   15 u^2   algorithm 17        sqrt  25/8 u^2   Lefevre et al. 2023
// The last step of a + b is two_sum, which is exact even if a cancellation makes the low part the larger one.
// Before it a.low + b.low has an error of at most u^2 (|a| + |b|), and s.low + t one of 3 u^2 (|a| + |b|).
// Fused multiply-add does not change any bit: the products are error-free with and without it.

#include <cmath>
#include <limits>

namespace liecheck::oracles {

struct DoubleDouble {
  double high = 0, low = 0;
};

namespace dd {

inline DoubleDouble fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}
/// a b = high + low exactly, by Dekker's product with Veltkamp's splitting, for |a|, |b| < 2^995.
inline DoubleDouble two_product(double a, double b) {
#if defined(__FMA__)
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
#else
  constexpr double factor = 134217729;  // 2^27 + 1
  const double p = a * b, ca = factor * a, cb = factor * b;
  const double ah = ca - (ca - a), al = a - ah, bh = cb - (cb - b), bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
#endif
}

}  // namespace dd

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.high, -a.low};
}
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = dd::two_sum(a.high, b.high);
  return dd::two_sum(s.high, s.low + (a.low + b.low));
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}
/// a + b by algorithm 6: the error is at most 3 u^2 of the sum, even if a and b nearly cancel.
inline DoubleDouble accurate_sum(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = dd::two_sum(a.high, b.high), t = dd::two_sum(a.low, b.low);
  const DoubleDouble v = dd::fast_two_sum(s.high, s.low + t.high);
  return dd::fast_two_sum(v.high, t.low + v.low);
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = dd::two_product(a.high, b.high);
  return dd::fast_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
inline DoubleDouble operator*(const DoubleDouble& a, double b) {
  const DoubleDouble p = dd::two_product(a.high, b);
  return dd::fast_two_sum(p.high, p.low + a.low * b);
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double q = a.high / b.high;
  const DoubleDouble r = b * q;
  return dd::fast_two_sum(q, ((a.high - r.high) + (a.low - r.low)) / b.high);
}
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (!(a.high > 0)) return {0, 0};
  const double s = std::sqrt(a.high);
  const DoubleDouble square = dd::two_product(s, s);
  return dd::fast_two_sum(s, ((a.high - square.high) - square.low + a.low) / (2 * s));
}

}  // namespace liecheck::oracles
