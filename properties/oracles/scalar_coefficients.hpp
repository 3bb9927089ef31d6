#pragma once
// The scalar coefficients of exp, log and their Jacobians as cubic polynomials on short intervals, in double,
// each with a proved error bound. This oracle is fast enough to check every float.
//
// For theta <= pi each coefficient is a quotient A(x) / B(x) of power series that converge everywhere.
// With x = theta^2, h = theta/2, y = h^2 = x/4, N = (sin h - h cos h) / h^3 and D = sin h / h:
//
//     c_k = sum_j (-x)^j / (2j + k)!           c_3 - 2 c_4, c_4 - 3 c_5: differences of these
//     d   = N / (4 D)      d2 = 2 d' = (N' D - N D') / (2 D^2)
//     sin h / theta = D/2  cos h = sum_j (-y)^j / (2j)!
//
// The series' coefficients are computed in binary128. About the middle of an interval the third-order Taylor
// polynomials of A and B are summed in 64 bits and divided. The bound adds the Lagrange remainders of A and B
// (with bounds of the fourth derivatives on [0, 10]), the remainder of the division, and every rounding. The
// coefficients of the logarithm are G(t) = atan(sqrt t) / sqrt t = int_0^1 ds / (1 + t s^2) and 2 G(t). The
// Taylor coefficients of G follow from 2 t G' + G = 1/(1+t). Cauchy's estimate bounds the remainder:
// |G| <= sqrt(2) G(m) for |t - m| <= m/2, because sqrt(t) G grows.

#include <array>
#include <string_view>

namespace liecheck::oracles {

/// The argument of the last two coefficients is t = tan^2 h >= 0, of all others x = theta^2 in [0, 9.8697].
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

/// Is the error absolute? It is for coefficients that cross zero or are added to 1.
constexpr bool is_absolute(Coefficient c) {
  return c == Coefficient::c0 || c == Coefficient::c1 || c == Coefficient::half_cosine;
}

/// p(u) = p0 + p1 u + p2 u^2 + p3 u^3 with u = x - centre, by Horner's scheme in double. For a coefficient F
/// with absolute error, |p(u) - F(x)| <= bound. Otherwise p approximates 1 / F, and |p(u) F(x) - 1| <= bound.
struct LocalExpansion {
  double centre, bound;
  std::array<double, 4> p;
  double at(double x) const {
    const double u = x - centre;
    return p[0] + u * (p[1] + u * (p[2] + u * p[3]));
  }
  /// An upper bound of the condition number for |u| <= half_width, the factor by which a relative error
  /// of x is multiplied. It is |x p'(u)| for an absolute error. Otherwise it is |x F'/F| = |x (1/F)'| F, that
  /// is |x p'(u)| divided by a lower bound of |p|.
  double condition(double half_width, bool absolute) const;
};

/// Preconditions: 0 <= low <= high are floats; high <= 9.8697 for the coefficients of x; x - (low + high)/2
/// is exact in double, as for floats of one binade or all floats below one power of two. Never throws. The
/// bound is large if the interval is too wide for a cubic.
LocalExpansion expand(Coefficient c, double low, double high);

}  // namespace liecheck::oracles
