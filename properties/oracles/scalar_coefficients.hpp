#pragma once
// The scalar coefficients of exp, log and their Jacobians as cubic polynomials on short intervals, in double, each
// with a proved error bound: an oracle that is fast enough for every float.
//
// For theta <= pi each coefficient is a quotient A(x) / B(x) of power series that converge everywhere; with
// h = theta/2, y = h^2 = x/4, N = (sin h - h cos h) / h^3 and D = sin h / h:
//
//     c_k = sum_j (-x)^j / (2j + k)!           c_3 - 2 c_4, c_4 - 3 c_5: differences of those
//     d   = N / (4 D)      d2 = 2 d' = (N' D - N D') / (2 D^2)
//     sin h / theta = D/2  cos h = sum_j (-y)^j / (2j)!
//
// Their coefficients are formed in binary128; about the middle of an interval, the third-order Taylor polynomials of
// A and B are summed in 64 bits, and divided. The bound adds Lagrange's remainders of A and of B (majorants of the
// fourth derivative on [0, 10]), the remainder of the division, and every rounding. The two coefficients of
// the logarithm are G(t) = atan(sqrt t) / sqrt t = int_0^1 ds / (1 + t s^2), whose Taylor coefficients follow
// from 2 t G' + G = 1/(1+t); |G| <= sqrt(2) G(m) for |t - m| <= m/2, because sqrt(t) G grows, and Cauchy's
// estimate bounds the remainder.

#include <array>
#include <string_view>

namespace liecheck::oracles {

/// In the order of the tables; x = theta^2 in [0, 9.8697] but for the last two, of t = tan^2 h >= 0.
enum class Coefficient {
  c0,
  c1,
  c2,
  c3,
  c4,
  c5,
  c3_minus_2c4,
  c4_minus_3c5,
  d,
  d2,
  half_sine,        ///< sin(theta/2) / theta
  half_cosine,      ///< cos(theta/2)
  angle_over_sine,  ///< 2 h / tan h
  alpha             ///< h / tan h
};
inline constexpr int coefficient_count = 14;

/// Whether the error is measured absolutely: the coefficient crosses zero, or is added to 1.
constexpr bool is_absolute(Coefficient c) {
  return c == Coefficient::c0 || c == Coefficient::c1 || c == Coefficient::half_cosine;
}

/// p(u) = p0 + p1 u + p2 u^2 + p3 u^3 with u = x - centre, Horner's scheme in double. Where the coefficient F is
/// measured absolutely |p(u) - F(x)| <= bound, otherwise |p(u) F(x) - 1| <= bound: p is the reciprocal.
struct LocalExpansion {
  double centre, bound;
  std::array<double, 4> p;
  double at(double x) const {
    const double u = x - centre;
    return p[0] + u * (p[1] + u * (p[2] + u * p[3]));
  }
  /// Upper bound of |x p'(u)| for |u| <= half_width, x <= centre + half_width: the condition number of the coefficient,
  /// by which a relative rounding error of x is multiplied; absolute or relative like the coefficient's error
  /// (|x (1/F)'| F = |x F'/F|), in the latter case divided by a lower bound of |p|.
  double condition(double half_width, bool absolute) const;
};

/// Precondition: 0 <= low <= high are floats, x - (low + high)/2 is exact in double (floats of one binade, or
/// all of them below one power of two), and high <= 9.8697 for the coefficients of x. Never throws; where the
/// interval is too wide for a cubic the bound is large.
LocalExpansion expand(Coefficient c, double low, double high);

}  // namespace liecheck::oracles
