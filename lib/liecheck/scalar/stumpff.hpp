#pragma once
// THE file of small-angle series and guards.
//
// Every coefficient of exp, log and their Jacobians is a function of x = theta^2 that is smooth at 0 although
// its textbook closed form is 0/0 there. With the Stumpff functions
//
//     c_k(x) = sum_j (-x)^j / (2j + k)!        c_0 = cos theta             c_1 = sin theta / theta
//                                              c_2 = (1 - cos theta)/theta^2   c_3 = (theta - sin theta)/theta^3
//
// nothing has to be guarded: on [0, pi^2] the highest ones are summed directly (the terms alternate and fall
// by x / ((k+1)(k+2)) < 1/3, so Horner's scheme loses nothing), and the lower ones follow by
//
//     c_k = 1/k! - x c_{k+2}                   (Stumpff 1959; Stiefel & Scheifele 1971, eq. 11.27)
//
// downwards, where the subtraction never cancels more than a factor 2.5 for c_2 and up. There is no cutoff at
// small angles, hence no cliff and no jump: the number of terms follows from the digits of the scalar. The one
// branch, at theta = pi, is where the half-angle forms are as good as the series.
//
// Derivatives in x (not in theta): c_k' = (k c_{k+2} - c_{k+1}) / 2.
//
// In float the error bounds below are verified at every argument it has (`liecheck sweep`; HalfAngle with x_low
// = 0, LogarithmCoefficients with cosine = 1). In wider scalars, by the same formulas, they rest on samples.

#include <array>
#include <liecheck/scalar/compensated.hpp>
#include <liecheck/scalar/scalar.hpp>
#include <limits>

namespace liecheck {

namespace stumpff_detail {

/// Number of terms of c_k, k >= 2, that S can see on x in [0, 10] (pi^2 < 10): those below eps / 256 of the
/// first one are dropped, which leaves room for the weights (2j + 2) of the derived series.
template <Scalar S>
constexpr int terms(int k) {
  double log2_term = 0;
  int j = 0;
  // log2(10) = 3.3219...; log2 of the product of the two new factorial factors by repeated halving.
  while (log2_term > -double(std::numeric_limits<S>::digits) - 8) {
    double factor = double(2 * j + k + 1) * double(2 * j + k + 2) / 10.0;
    while (factor >= 2) {
      factor /= 2;
      log2_term -= 1;
    }
    log2_term -= factor - 1;  // log2(f) >= f - 1 on [1, 2]: errs to the safe side
    ++j;
  }
  return j + 1;
}

/// The coefficients (-1)^j w_j / (2j + K)! of a series in x.
template <Scalar S, int K, class Weight>
auto coefficients(Weight weight) {
  static_assert(K >= 2);
  constexpr int n = terms<S>(K);
  std::array<S, n> a;
  S factorial(1);
  for (int i = 2; i <= K; ++i) factorial *= S(i);
  for (int j = 0; j < n; ++j) {
    if (j > 0) factorial *= S((2 * j + K - 1) * (2 * j + K));
    a[j] = S((j % 2 == 0 ? 1 : -1) * weight(j)) / factorial;
  }
  return a;
}

template <class S, std::size_t N>
S horner(const std::array<S, N>& a, const S& x) {
  S sum = a[N - 1];
  for (std::size_t j = N - 1; j-- > 0;) sum = mul_add(sum, x, a[j]);
  return sum;
}

template <Scalar S, int K>
S c(const S& x) {
  static const auto a = coefficients<S, K>([](int) { return 1; });
  return horner(a, x);
}

/// A few ulp above pi^2, so that theta = pi rounded up is inside: the domain of the series, which hold to 10.
template <Scalar S>
const S& series_limit() {
  static const S limit = pi<S>() * pi<S>() * (S(1) + S(8) * eps<S>());
  return limit;
}

}  // namespace stumpff_detail

/// c_0 ... c_5 at x = theta^2 on [0, pi^2]. Error: c_3 ... c_5 1.5 eps relative, c_2 2 (1.7 with FMA); c_0
/// and c_1 1.5 eps absolute (they cross zero).
template <Scalar S>
struct Stumpff {
  S c0, c1, c2, c3, c4, c5;
  /// Precondition: 0 <= x <= pi^2.
  explicit Stumpff(const S& x) {
    using namespace stumpff_detail;
    c4 = c<S, 4>(x);
    c5 = c<S, 5>(x);
    c2 = S(1) / S(2) - x * c4;
    c3 = S(1) / S(6) - x * c5;
    c1 = S(1) - x * c3;
    // c_0 = 2 cos^2(theta/2) - 1, expanded: 1 - x c_2 would lose 4 eps at pi, where x c_2 = 2.
    const S versine = x / S(4) * stumpff_detail::c<S, 2>(x / S(4));
    c0 = (S(1) - S(4) * versine) + S(2) * versine * versine;
  }
};

/// Are the series valid for this x = theta^2? Beyond it (theta > pi, or x overflowed) use the sine forms.
template <Scalar S>
bool within_half_turn(const S& x) {
  return x <= stumpff_detail::series_limit<S>();
}

/// g = c_3 - 2 c_4 = sum_j (-x)^j (2j + 2) / (2j + 4)!, x in [0, pi^2]; minus twice c_2'. 1.5 eps relative.
template <Scalar S>
S c3_minus_2c4(const S& x) {
  static const auto a = stumpff_detail::coefficients<S, 4>([](int j) { return 2 * j + 2; });
  return stumpff_detail::horner(a, x);
}

/// c_4 - 3 c_5 = sum_j (-x)^j (2j + 2) / (2j + 5)!, x in [0, pi^2]; minus twice c_3'. 1.6 eps relative.
template <Scalar S>
S c4_minus_3c5(const S& x) {
  static const auto a = stumpff_detail::coefficients<S, 5>([](int j) { return 2 * j + 2; });
  return stumpff_detail::horner(a, x);
}

/// The coefficient of [phi]^2 in the inverse Jacobian of SO(3), and its slope.
///     d(x)  = (1 - (theta/2) cot(theta/2)) / theta^2 = (c_3 - 2 c_4) / (2 c_2)      1/12 at 0, 1/pi^2 at pi
///     d2(x) = 2 d'(x)                                                               1/360 at 0
/// on [0, pi^2]. Error, relative: d 3.1 eps; d2 22 eps, near pi, where the products of its numerator cancel.
template <Scalar S>
struct InverseCoefficient {
  S d, d2;
  explicit InverseCoefficient(const S& x) {
    // d = g / (2 c2) with c2' = -g/2 gives 2 d' = (g' c2 + g^2/2) / c2^2, g' = -sum (-x)^j (j+1)(2j+4)/(2j+6)!.
    static const auto slope = stumpff_detail::coefficients<S, 6>([](int j) { return (j + 1) * (2 * j + 4); });
    const S c2 = S(1) / S(2) - x * stumpff_detail::c<S, 4>(x);
    const S g = c3_minus_2c4(x);
    d = g / (S(2) * c2);
    d2 = (g * g / S(2) - stumpff_detail::horner(slope, x) * c2) / (c2 * c2);
  }
};

namespace stumpff_detail {

/// 1/6 = value + low to twice the digits.
template <Scalar S>
struct Sixth {
  S value = S(1) / S(6), low;
  Sixth() {
    const auto [p, e] = two_product<S>(S(6), value);
    low = ((S(1) - p) - e) / S(6);
  }
};

/// a + a_low - x b, x = x_high + x_low, as an unevaluated sum (high, low): b's own error is what is left of it.
template <Scalar S>
std::pair<S, S> minus_product(const S& a, const S& a_low, const S& x, const S& x_low, const S& b,
                              const S& b_low) {
  const auto [p, pe] = two_product<S>(x, b);
  const auto [sum, se] = two_sum<S>(a, -p);
  return two_sum<S>(sum, a_low + ((se - pe) - (x * b_low + x_low * b)));
}

}  // namespace stumpff_detail

/// sin(theta/2)/theta and cos(theta/2) from theta^2 = x + x_low on [0, pi^2]: the quaternion of a rotation
/// vector. The rounding of theta^2, up to 1.5 eps, would turn into 2.4 eps of angle at pi; x_low carries it to
/// first order, and the last two steps of Horner's scheme carry their roundings: sine_low is what sine_over_angle
/// leaves of the sine. Error 0.6 eps each, relative for the sine, absolute for the cosine.
template <Scalar S>
struct HalfAngle {
  S sine_over_angle, sine_low, cosine;
  explicit HalfAngle(const S& x, const S& x_low = S(0)) {
    using namespace stumpff_detail;
    static const Sixth<S> sixth;
    const S h = x / S(4), h_low = x_low / S(4);
    const auto [c3, c3_low] = minus_product<S>(sixth.value, sixth.low, h, h_low, c<S, 5>(h), S(0));
    const auto [c2, c2_low] = minus_product<S>(S(1) / S(2), S(0), h, h_low, c<S, 4>(h), S(0));
    const auto [c1, c1_low] = minus_product<S>(S(1), S(0), h, h_low, c3, c3_low);
    sine_over_angle = c1 / S(2), sine_low = c1_low / S(2);
    cosine = minus_product<S>(S(1), S(0), h, h_low, c2, c2_low).first;
  }
};

/// What the logarithm needs of a quaternion (v, w) of any scale, with h = theta/2 = atan2(|v|, w), w >= 0:
///     angle_over_sine = 2 h / |v|       phi = angle_over_sine v
///     alpha = h cot h                   (theta/2) cot(theta/2)
///     along = (1 - alpha) / |v|^2       so that J^-1 p = alpha p - phi x p / 2 + along v (v . p)
/// |v| = 0 and every |v| whose square underflows are the limit 2/w, 1, 1/(3 w^2). Precondition: w >= 0, not both
/// zero. Error: angle_over_sine 1.5 eps, alpha 2.5 eps relative; along is consistent with the rounded alpha.
template <Scalar S>
struct LogarithmCoefficients {
  S angle_over_sine, alpha, along;
  LogarithmCoefficients(const S& squared_sine, const S& cosine) {
    using std::atan2, std::sqrt;
    // tan^2 h <= eps/4: atan2(t, 1)/t = 1 - t^2/3 is 1 to eps/12, for every scalar: nothing is traded here.
    if (squared_sine <= eps<S>() / S(4) * (cosine * cosine)) {
      angle_over_sine = S(2) / cosine;
      alpha = S(1);
      along = S(1) / (S(3) * cosine * cosine);
    } else {
      const S sine = sqrt(squared_sine);
      angle_over_sine = S(2) * S(atan2(sine, cosine)) / sine;
      alpha = angle_over_sine * cosine / S(2);
      along = (S(1) - alpha) / squared_sine;
    }
  }
};

/// A rotation vector phi with the coefficients that exp and its Jacobians need, valid for every finite phi.
/// The axis a is phi itself up to half a turn, and the unit vector phi/theta beyond, so that nothing overflows;
/// the coefficients are scaled to match: with t = 1 or theta,
///     k1 = c_1,  k2 = c_2 t,  k3 = c_3 t^2     R = I + (c_1 t)[a] + (c_2 t^2)[a]^2,   J = I + k2 [a] + k3 [a]^2.
/// Error: as for Stumpff up to half a turn; beyond it 2 eps + theta eps (excess rule).
template <Scalar S, class Vector>
struct RotationCoefficients {
  Vector axis;
  S x;      ///< theta^2, or infinity where it overflows
  S theta;  ///< set beyond half a turn only
  bool half_turn;
  S k1, k2, k3, sine_half,
      cosine_half;  ///< sine_half: sin(theta/2)/theta * t, so that the vector part is sine_half a

  explicit RotationCoefficients(const Vector& phi) : axis(phi), x(phi.dot(phi)), theta(0) {
    half_turn = within_half_turn(x);
    if (half_turn) {
      S low(0);
      S high(0);
      for (int i = 0; i < 3; ++i) {
        const auto [p, pe] = two_product<S>(phi[i], phi[i]);
        const auto [sum, se] = two_sum<S>(high, p);
        high = sum;
        low += pe + se;
      }
      const HalfAngle<S> half(high, low);
      sine_half = half.sine_over_angle;
      cosine_half = half.cosine;
      using stumpff_detail::minus_product;
      static const stumpff_detail::Sixth<S> sixth;
      k3 = minus_product<S>(sixth.value, sixth.low, high, low, stumpff_detail::c<S, 5>(x), S(0)).first;
      const auto [square, rest] = two_product<S>(sine_half, sine_half);
      k2 = S(2) * (square + (rest + S(2) * sine_half * half.sine_low));
      k1 = S(2) * (sine_half * cosine_half + half.sine_low * cosine_half);
    } else {
      using std::cos, std::sin, std::sqrt;
      theta = finite(x) ? S(sqrt(x)) : S(phi.stableNorm());
      axis = phi / theta;
      sine_half = sin(theta / S(2));
      cosine_half = cos(theta / S(2));
      k1 = S(2) * sine_half * cosine_half / theta;
      k2 = S(2) * sine_half * sine_half / theta;
      k3 = S(1) - k1;
    }
  }
};

}  // namespace liecheck
