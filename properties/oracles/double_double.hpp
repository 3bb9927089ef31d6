#pragma once
// Double-double arithmetic: x = high + low, |low| <= ulp(high) / 2, 106 bits in the exponent range of double.
//
// Relative errors, u = 2^-53, barring under- and overflow (Joldes, Muller & Popescu 2017, "Tight and rigorous
// error bounds for basic building blocks of double-word arithmetic"; Lefevre et al. 2023 for the root):
//   a + b   5 u^2 of |a| + |b|: algorithm 5, which has no bound relative to the sum; the last step is two_sum, since
//           after a cancellation the low part may be the larger one. Errors u |a.low + b.low| <= u^2 (|a| + |b|) and
//           u |s.low + t| <= 3 u^2 (|a| + |b|), then none.
//   a b     5 u^2    algorithm 11
//   a / b   15 u^2   algorithm 17        sqrt  25/8 u^2
// The same bits with and without fused multiply-add: the products are error-free either way.

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
/// Dekker's product by Veltkamp's splitting; |a|, |b| < 2^995.
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
/// Within 3 u^2 of the sum itself, whatever cancels: algorithm 6.
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
