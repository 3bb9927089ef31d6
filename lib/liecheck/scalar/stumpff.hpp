#pragma once
// The series near 0 of exp, log and their Jacobians: the Stumpff functions.
// Longer than 400 lines: all formulas for small angles stand in this file.
//
// Every coefficient of exp, log and their Jacobians is a function of x = theta^2. It is smooth at 0, although
// its textbook closed form is 0/0 there. The Stumpff functions need no special case at 0:
//
//     c_k(x) = sum_j (-x)^j / (2j + k)!    c_0 = cos theta                 c_1 = sin theta / theta
//                                          c_2 = (1 - cos theta)/theta^2   c_3 = (theta - sin theta)/theta^3
//
// c_4 and c_5 at h = x/4 in [0, (pi/2)^2] are computed as polynomials. Those of lower k follow from
//
//     c_k = 1/k! - x c_{k+2}                   (Stumpff 1959; Stiefel & Scheifele 1971, eq. 11.27)
//
// whose subtraction cancels at most a factor 1.6. The values at x itself follow by doubling the angle:
//     c_0(4h) = 2 c_0^2 - 1,  c_1(4h) = c_0 c_1,  c_2(4h) = c_1^2 / 2,  c_3(4h) = (c_2 + c_0 c_3) / 4.
//
// The error has no jump, since no threshold is at small angles: the number of terms follows from the scalar's digits.
// The only branch is at theta = pi, beyond which sines are as accurate. d c_k / dx = (k c_{k+2} - c_{k+1}) / 2.
//
// The error bounds below are verified in float at every argument (`liecheck lab sweep`; x.low = 0, cosine = 1). Those of the
// polynomials are proved in float and double (tests/proofs). For wider scalars only random arguments are tested.

#include <array>
#include <bit>
#include <liecheck/scalar/compensated.hpp>
#include <liecheck/scalar/precision.hpp>
#include <liecheck/scalar/scalar.hpp>
#include <limits>
#include <stdexcept>

namespace liecheck {

namespace stumpff_detail {

/// c_K(x/4) = sum_j (-x/4)^j / (2j + K)! on [0, 10]; pi^2 = 9.87. It is written as a series in x, for speed.
template <Scalar S, int K>
struct StumpffSeries {
  static constexpr int most = std::numeric_limits<S>::digits / 5 + 10, outer = 1;
  static constexpr S domain() { return S(10); }
  static constexpr S first() {
    S factorial(1);
    for (int i = 2; i <= K; ++i) factorial = factorial * S(i);
    return S(1) / factorial;
  }
  /// The ratio of term j to term j - 1, at x = 1.
  static constexpr S ratio(int j) { return S(-1) / S(4 * (2 * j + K - 1) * (2 * j + K)); }
};

template <class S>
using Fourth = StumpffSeries<S, 4>;
template <class S>
using Fifth = StumpffSeries<S, 5>;

/// c_K(x) = sum_j (-x)^j / (2j + K)! on [0, 10].
template <Scalar S, int K>
struct WholeStumpffSeries : StumpffSeries<S, K> {
  static constexpr int most = std::numeric_limits<S>::digits / 3 + 12;
  static constexpr S ratio(int j) { return S(-1) / S((2 * j + K - 1) * (2 * j + K)); }
};
template <class S>
using WholeFifth = WholeStumpffSeries<S, 5>;
template <class S>
using WholeSixth = WholeStumpffSeries<S, 6>;

/// h / sin h = sum_j j!^2 / (2j + 1)! (2 s)^j for s = 1 - cos h in [0, 1]. All terms are positive. Error 2.2
/// eps, or 1.7 eps with fused multiply-adds.
template <Scalar S>
struct InverseSincSeries {
  static constexpr int most = std::numeric_limits<S>::digits + 10, outer = 2;
  static constexpr S domain() { return S(1); }
  static constexpr S first() { return S(1); }
  static constexpr S ratio(int j) { return S(j) / S(2 * j + 1); }
};

/// h / sin h = sum_j ((2j)! / (2^j j!)^2 / (2j + 1)) y^j for y = sin^2 h in [0, 1/256].
template <Scalar S>
struct NearInverseSincSeries {
  static constexpr int most = std::numeric_limits<S>::digits / 8 + 10, outer = 2;
  static constexpr S domain() { return S(1) / S(256); }
  static constexpr S first() { return S(1); }
  static constexpr S ratio(int j) { return S((2 * j - 1) * (2 * j - 1)) / S(2 * j * (2 * j + 1)); }
};
/// (1 - h cot h) / y for the same y.
template <Scalar S>
struct NearAlongSeries : NearInverseSincSeries<S> {
  static constexpr S first() { return S(1) / S(3); }
  static constexpr S ratio(int j) { return S(2 * j) / S(2 * j + 3); }
};

/// A series economised on its domain (Lanczos 1938; Clenshaw 1962). It starts with the first `most` terms of
/// Taylor's series. Subtracting a multiple of the shifted Chebyshev polynomial removes the highest power.
/// This is repeated while the changes sum to less than eps/32 of the first term. `terms` coefficients remain.
template <Scalar S, class Series>
struct Economised {
  static constexpr int most = Series::most;
  std::array<S, most> a{};
  int terms = most;

  constexpr Economised() {
    const S length = Series::domain(), limit = std::numeric_limits<S>::epsilon() / S(32) * Series::first();
    a[0] = Series::first();  // a is a polynomial in x / length
    for (int j = 1; j < most; ++j) a[j] = a[j - 1] * Series::ratio(j) * length;
    S change(0);
    for (;; --terms) {
      // T*_n(t) = sum_j t_j t^j, t_{j-1} = -t_j j (2j - 1) / (2 (n^2 - (j-1)^2)), t_n = 2^(2n-1).
      const int n = terms - 1;
      S multiple = a[n] * S(2);
      for (int i = 0; i < n; ++i) multiple = multiple / S(4);
      change = change + (multiple < S(0) ? S(-multiple) : multiple);
      if (limit < change) break;
      S t = a[n];
      for (int j = n; j > 0; --j) {
        t = -t * S(j * (2 * j - 1)) / S(2 * (n * n - (j - 1) * (j - 1)));
        a[j - 1] = a[j - 1] - t;
      }
    }
    S power(1);
    for (int j = 0; j < terms; ++j, power = power * length) a[j] = a[j] / power;
  }
};

/// sum of a_j x^(j - FROM), j = FROM ... FROM + COUNT - 1, by Estrin's scheme (1960); squares[i] = x^(2^i).
template <int FROM, int COUNT, class A, class S, std::size_t M>
[[gnu::always_inline]] inline S estrin(const A& a, const std::array<S, M>& squares) {
  if constexpr (COUNT == 1) {
    return S(a[FROM]);
  } else {
    constexpr int level = std::bit_width(unsigned(COUNT - 1)) - 1, half = 1 << level;
    return mul_add(estrin<FROM + half, COUNT - half>(a, squares), squares[level],
                   estrin<FROM, half>(a, squares));
  }
}

/// sum of a_j x^(j - FROM), j >= FROM, of the economised series. FROM is 0 or 1.
template <template <class> class Series, int FROM = 0, Scalar S>
[[gnu::always_inline]] inline S evaluate(const S& x) {
  using Of = Series<Lane<S>>;
  if constexpr (std::is_floating_point_v<Lane<S>>) {
    static constexpr Economised<Lane<S>, Of> p;
    std::array<S, std::bit_width(unsigned(p.terms - 1))> squares{x};
    for (std::size_t i = 1; i < squares.size(); ++i) squares[i] = squares[i - 1] * squares[i - 1];
    // The first `outer` terms are added last (Horner), so that only one rounding error reaches half an ulp.
    S sum = estrin<Of::outer, p.terms - Of::outer>(p.a, squares);
    for (int j = Of::outer; j-- > FROM;) sum = mul_add(sum, x, S(p.a[j]));
    return sum;
  } else {
    static const Economised<S, Of> p;
    S sum = p.a[p.terms - 1];
    for (int j = p.terms - 1; j-- > FROM;) sum = mul_add(sum, x, p.a[j]);
    return sum;
  }
}

/// A few ulp above pi^2, so that theta = pi rounded up is inside the domain; the series are valid to 10.
template <Scalar S>
S series_limit() {
  if constexpr (std::is_floating_point_v<S>) return pi<S>() * pi<S>() * (S(1) + S(8) * eps<S>());
  static const S limit = pi<S>() * pi<S>() * (S(1) + S(8) * eps<S>());
  return limit;
}

}  // namespace stumpff_detail

/// True if theta <= pi for x = theta^2, so that the series are valid. False also if x overflowed.
template <Scalar S>
[[gnu::always_inline]] inline bool within_pi(const S& x) {
  return x <= stumpff_detail::series_limit<S>();
}

/// theta^2 = phi . phi as a double word, with twice the digits of S for theta < 4; in fast precision low = 0.
template <Scalar S, Precision P, class Vector>
[[gnu::always_inline]] inline DoubleWord<S> squared_angle(const Vector& phi) {
  const S x = mul_add(phi[0], phi[0], mul_add(phi[1], phi[1], S(phi[2] * phi[2])));
  if constexpr (P == Precision::fast) return {x, S(0)};
  auto sum = SplitDot<S, 4>::square(S(phi[0]));
  sum.add_square(S(phi[1])).add_square(S(phi[2]));
  return {x, (sum.high - x) + sum.low_a};
}

/// The Stumpff functions c_0 ... c_5 at h = x/4, for theta^2 = x in [0, pi^2]: c_0 = cos(theta/2),
/// c_1 = 2 sin(theta/2)/theta and so on. The member functions double the angle to get the values at x itself.
/// The rounding error of theta^2, up to 1.5 eps, would cause an error of 2.4 eps of the angle at pi; x.low
/// corrects it to first order. Error at h (all proved): c_0 0.65 and c_1 0.45 eps absolute; c_2 0.7, c_3 0.9,
/// c_4 and c_5 1.1 eps relative. Error of second_slope 2.6 and third_slope 2.4 eps relative, since c_2 - c_3
/// cancels a factor 2 and c_3 - 2 c_4 a factor 3.
template <Scalar S, Precision P = Precision::standard>
struct HalfAngle {
  S c0, c1, c2, c3, c4, c5;
  [[gnu::always_inline]] explicit HalfAngle(const S& x) : HalfAngle(DoubleWord<S>(x)) {}
  [[gnu::always_inline]] explicit HalfAngle(const DoubleWord<S>& x) {
    const S h = x.high / S(4), square = h * h;
    c4 = stumpff_detail::evaluate<stumpff_detail::Fourth>(x.high);
    c5 = stumpff_detail::evaluate<stumpff_detail::Fifth>(x.high);
    c2 = mul_add(S(-h), c4, S(1) / S(2));
    c3 = mul_add(S(-h), c5, S(1) / S(6));
    if constexpr (P == Precision::fast) {
      c1 = mul_add(S(-h), c3, S(1));
      c0 = mul_add(S(-h), c2, S(1));
    } else {
      // c_0 = 1 - h/2 + h^2 c_4 and c_1 = 1 - h/8 - h (1/24 - h c_5), each as a double word: high is the sum
      // of the first two terms, low its rounding error plus the third. x.low enters with the slopes in x.
      const auto sum = [&h](const S& factor, const S& small) __attribute__((always_inline)) {
        const S linear = h * factor, head = S(1) - linear;
        return DoubleWord<S>(head, ((S(1) - head) - linear) + small);
      };
      // Slopes c_0' = -c_1/2 and c_1' = (c_3 - c_2)/2 to 1/100, since the correction is about eps.
      const S step = x.low / S(8),
              slope1 = mul_add(h, mul_add(h, S(-1) / S(840), S(1) / S(30)), S(-1) / S(3)),
              slope0 = mul_add(h, mul_add(h, S(1) / S(120), S(-1) / S(6)), S(1));
      half_sine_ = sum(S(1) / S(8), mul_add(h, mul_add(h, c5, S(-1) / S(24)), S(step * slope1)));
      c1 = half_sine_.high + half_sine_.low;
      half_cosine_ = sum(S(1) / S(2), mul_add(square, c4, S(-step * slope0)));
      c0 = half_cosine_.high + half_cosine_.low;
    }
  }
  /// sin(theta/2) / theta.
  [[gnu::always_inline]] S sine_over_angle() const { return c1 / S(2); }
  /// c_1(x) = sin(theta) / theta.
  [[gnu::always_inline]] S sine() const {
    if constexpr (P == Precision::fast) return c0 * c1;
    return rounded_product(half_cosine_, half_sine_);
  }
  /// c_2(x) = (1 - cos(theta)) / theta^2.
  [[gnu::always_inline]] S versine() const {
    if constexpr (P == Precision::fast) return c1 * c1 / S(2);
    return rounded_square(half_sine_) / S(2);
  }
  /// c_3(x).
  [[gnu::always_inline]] S third() const { return mul_add(c0, c3, c2) / S(4); }
  /// (c_3 - 2 c_4)(x) = -2 c_2'(x).
  [[gnu::always_inline]] S second_slope() const { return c1 * (c2 - c3) / S(4); }
  /// (c_4 - 3 c_5)(x) = -2 c_3'(x).
  [[gnu::always_inline]] S third_slope() const {
    return ((c3 - S(2) * c4) + mul_add(c1, c3, S(c0 * mul_add(S(-3), c5, c4)))) / S(16);
  }

 private:
  DoubleWord<S> half_cosine_, half_sine_;  // c0 and c1; not set in fast precision
};

/// The Stumpff functions c_2 ... c_6 at x = theta^2 [rad^2], at the places of their indices: c_k = 1/k! - x c_{k+2}. Up to
/// pi, c_5 and c_6 are polynomials that approximate their power series, with an error of 4 eps; beyond pi, c_2 and c_3
/// follow from cos and sin, and the others by division by x, which cancels nothing there. Throws std::invalid_argument if x
/// is not finite.
template <Scalar S>
std::array<S, 7> stumpff_functions(const S& x) {
  using std::cos, std::sin, std::sqrt;
  if (!finite<S>(x)) throw std::invalid_argument("the square of an angle is not finite");
  const S inverse_factorials[] = {S(1) / S(2), S(1) / S(6), S(1) / S(24), S(1) / S(120), S(1) / S(720)};
  std::array<S, 7> c{};
  if (!within_pi(x)) {
    const S theta = sqrt(x);
    c[2] = (S(1) - S(cos(theta))) / x, c[3] = (S(1) - S(sin(theta)) / theta) / x;
    for (std::size_t k = 4; k < 7; ++k) c[k] = (inverse_factorials[k - 4] - c[k - 2]) / x;
    return c;
  }
  c[5] = stumpff_detail::evaluate<stumpff_detail::WholeFifth>(x);
  c[6] = stumpff_detail::evaluate<stumpff_detail::WholeSixth>(x);
  for (std::size_t k = 4; k >= 2; --k) c[k] = inverse_factorials[k - 2] - x * c[k + 2];
  return c;
}

/// The coefficient d of [phi]^2 in the inverse Jacobian of SO(3), and twice its slope in x.
///     d(x)  = (1 - (theta/2) cot(theta/2)) / theta^2 = (c_2 - c_3) / (4 c_1) at x/4  1/12 at 0, 1/pi^2 at pi
///     d2(x) = 2 d'(x)                                                                1/360 at 0
/// on [0, pi^2]. Relative error: d 2.6 eps; d2 5 eps, since c_4 - 3 c_5 cancels a factor 4.
template <Scalar S, Precision P = Precision::standard>
struct InverseCoefficient {
  S d, d2;
  [[gnu::always_inline]] explicit InverseCoefficient(const S& x) {
    // At h = x/4: c_2 - c_3 = 1/3 - h (c_4 - c_5), 2 d' = (c_4 - 3 c_5 + c_3 (c_2 - 2 c_3)) / (16 c_1^2):
    // all three terms are positive.
    const HalfAngle<S, Precision::fast> k(x);
    const S minus_h = x / S(-4), step = mul_add(minus_h, S(k.c4 - k.c5), S(1) / S(3)),
            difference = mul_add(minus_h, mul_add(S(-2), k.c5, k.c4), S(1) / S(6));  // c_2 - 2 c_3
    d = step / (S(4) * k.c1);
    d2 = mul_add(k.c3, difference, mul_add(S(-3), k.c5, k.c4)) / (S(16) * k.c1 * k.c1);
  }
};

/// Taylor's series in double for theta^2 = x <= 2^-8, for loops that meet hardly any other angle, such as the steps of
/// an integrator: sin(theta/2) / theta, cos(theta/2), and d of InverseCoefficient. Relative errors of what is left out:
/// below 2^-55 of the first two, and below 2^-40 of d, so that d [phi]^2 omega has an error below 0.9 eps |omega|.
struct SmallAngle {
  static constexpr double largest = 0x1p-8;  ///< of x
  [[gnu::always_inline]] static double sine_over_angle(double x) {
    const double y = x / 4;
    return 0.5 - y * (1. / 12 - y * (1. / 240 - y * (1. / 10080)));
  }
  [[gnu::always_inline]] static double cosine(double x) {
    const double y = x / 4;
    return 1 - y * (0.5 - y * (1. / 24 - y * (1. / 720)));
  }
  [[gnu::always_inline]] static double inverse(double x) {
    return 1. / 12 + x * (1. / 720 + x * (1. / 30240));
  }
};

/// The coefficients of the logarithm of a quaternion (v, w >= 0) of any norm, h = theta/2 = atan2(|v|, w):
///     angle_over_sine = 2 h / |v|       phi = angle_over_sine v
///     alpha = h cot h                   (theta/2) cot(theta/2)
///     along = (1 - alpha) / |v|^2       so that J^-1 p = p - phi x p / 2 + along v x (v x p)
/// h / sin h is a smooth function of w/|Q| alone. To first order 1/|Q| = r (1 - e/2), where e = r^2 |Q|^2 - 1
/// and r = fl(1/|Q|), or r = 1 if |Q| is 1 up to rounding errors. If |v|^2 underflows, the results are 2/w, 1
/// and 0. Precondition: w >= 0, and |Q|^2 is a normal number. Relative error if |Q|^2 is in [1/8, 8] and
/// known to a relative error of eps/4: angle_over_sine 1.5 eps, alpha 2.5 eps; otherwise 2.5 and 3.5 eps. In `along`,
/// |v|^2 + eps^2 keeps a rounding error of 1 - alpha small where |v|^2 is tiny.
template <Scalar S>
struct LogarithmCoefficients {
  S angle_over_sine, alpha, along;
  DoubleWord<S> ratio;  ///< angle_over_sine before rounding: 2 r + 2 r (h / sin h (1 - e/2) - 1)
  LogarithmCoefficients(const S& squared_sine, const S& cosine)
      : LogarithmCoefficients(squared_sine, cosine, excess_of(squared_sine, cosine)) {}
  /// |v| <= 1/16 and e = |Q|^2 - 1 with e^2 < eps/8; w is not needed.
  [[gnu::always_inline]] static LogarithmCoefficients near(const S& squared_sine, const S& e) {
    const S y = mul_add(S(-e), squared_sine, squared_sine),
            argument = y + std::numeric_limits<S>::epsilon() / S(512),
            series = y * stumpff_detail::evaluate<stumpff_detail::NearInverseSincSeries, 1>(argument),
            slope = stumpff_detail::evaluate<stumpff_detail::NearAlongSeries>(argument);
    LogarithmCoefficients c;
    c.ratio = {S(2), S(2) * mul_add(S(e / S(-2)), S(1) + series, series)};
    c.angle_over_sine = c.ratio.high + c.ratio.low;
    c.alpha = mul_add(S(-y), slope, S(1));
    c.along = mul_add(S(-e), slope, slope);
    return c;
  }
  /// excess is |Q|^2 - 1.
  [[gnu::always_inline]] LogarithmCoefficients(const S& squared_sine, const DoubleWord<S>& cosine,
                                               const DoubleWord<S>& excess) {
    S e = excess.high + excess.low;
    DoubleWord<S> c = cosine;
    ratio.high = S(2);
    if constexpr (!side_by_side<S>)
      if (!(e * e < eps<S>() / S(8))) normalize(squared_sine, excess, e, c);
    // s = 1 - cos h, series = h / sin h - 1. Without eps/512, powers of a tiny s would be subnormal: slow.
    const S half_e = e / S(2), s = mul_add(half_e, c.high, S((S(1) - c.high) - c.low)),
            argument = s + std::numeric_limits<S>::epsilon() / S(512),
            series = s * stumpff_detail::evaluate<stumpff_detail::InverseSincSeries, 1>(argument);
    ratio.low = ratio.high * mul_add(S(-half_e), S(1) + series, series);
    angle_over_sine = ratio.high + ratio.low;
    alpha = angle_over_sine * cosine.high / S(2);
    along = mul_add(S(-series), S(S(1) - s), s) * (S(1) / (squared_sine + eps<S>() * eps<S>()));
  }

 private:
  LogarithmCoefficients() = default;
  static DoubleWord<S> excess_of(const S& squared_sine, const S& cosine) {
    const auto square = two_prod<S>(cosine, cosine);
    const auto sum = two_sum<S>(square.high, squared_sine);
    const auto excess = two_sum<S>(sum.high, S(-1));
    return {excess.high, excess.low + (sum.low + square.low)};
  }
  /// For |Q| away from 1: sets ratio.high = 2 r, c = w r, and e, which is 0 unless 1/8 < |Q|^2 < 8.
  [[gnu::always_inline]] void normalize(const S& squared_sine, const DoubleWord<S>& excess, S& e,
                                        DoubleWord<S>& c) {
    using std::sqrt;
    const S rough = mul_add(c.high, c.high, squared_sine);
    if (S(1) / S(8) < rough && rough < S(8)) {
      const auto sum = two_sum<S>(excess.high, excess.low), square = two_sum<S>(S(1), sum.high);
      const S r = S(1) / S(sqrt(square.high));
      const auto length = two_prod<S>(r, square.high), one = two_prod<S>(r, length.high);
      e = (one.high - S(1)) + (one.low + r * (length.low + r * (square.low + sum.low)));
      const auto product = two_prod<S>(r, c.high);
      c = {product.high, product.low + r * c.low};
      ratio.high = S(2) * r;
    } else {
      const S r = S(1) / S(sqrt(rough));
      e = S(0);
      c = {c.high * r, S(0)};
      ratio.high = S(2) * r;
    }
  }
};

namespace stumpff_detail {

/// RotationCoefficients for theta > pi, computed with sines and an axis of unit length.
template <Scalar S>
struct BeyondPi {
  S theta, k1, k2, k3, slope2, slope3, sine_half, cosine_half;
};
template <Scalar S>
[[gnu::noinline]] BeyondPi<S> beyond_pi(const S& theta) {
  using std::cos, std::sin;
  BeyondPi<S> k;
  k.theta = theta;
  k.sine_half = sin(theta / S(2));
  k.cosine_half = cos(theta / S(2));
  k.k1 = S(2) * k.sine_half * k.cosine_half / theta;
  k.k2 = S(2) * k.sine_half * k.sine_half / theta;
  k.k3 = S(1) - k.k1;
  // x (2 c_4 - c_3) = c_1 - 2 c_2 and x (3 c_5 - c_4) = c_2 - 3 c_3: no cancellation for theta > pi.
  const S c2 = k.k2 / theta;
  k.slope2 = k.k1 - S(2) * c2;
  k.slope3 = (c2 - S(3) * (k.k3 / theta) / theta) * theta;
  return k;
}

/// theta = |phi| from theta^2 = x, which may have overflowed: to the largest number, if the processor rounds down.
template <Scalar S, class Vector>
S large_angle(const Vector& phi, const S& x) {
  using std::ldexp, std::sqrt;
  if (x < S(ldexp(S(1), std::numeric_limits<S>::max_exponent - 4))) return sqrt(x);
  const S scale = S(ldexp(S(1), -std::numeric_limits<S>::max_exponent / 2 - 2)),
          xx = (scale * phi).squaredNorm();
  return S(sqrt(xx)) / scale;
}

}  // namespace stumpff_detail

/// The coefficients of exp and its Jacobians at any finite rotation vector phi, for the axis a = phi / t with
/// t = 1 for theta <= pi; beyond pi, t = theta, to avoid overflow:
///     k1 = c_1,  k2 = c_2 t,  k3 = c_3 t^2;  J = I + k2 [a] + k3 [a]^2; for t = 1, R = I + k1 [a] + k2 [a]^2
///     slope2 = 2 c_2' t^2 = (2 c_4 - c_3) t^2,  slope3 = 2 c_3' t^3 = (3 c_5 - c_4) t^3,
///     and (sine_half a, cosine_half) is the quaternion.
/// Error: as for HalfAngle up to pi; beyond pi 2 eps + theta eps (excess rule, docs/measuring.md).
template <Scalar S, class Vector, Precision P = Precision::standard>
struct RotationCoefficients {
  Vector axis;
  S theta;  ///< set for theta > pi only
  bool within_pi;
  S k1, k2, k3, slope2, slope3, sine_half, cosine_half;

  /// theta^2 = x, theta <= pi.
  [[gnu::always_inline]] RotationCoefficients(const Vector& phi, const DoubleWord<S>& x)
      : axis(phi), theta(0), within_pi(true) {
    const HalfAngle<S, P> k(x);
    k1 = k.sine(), k2 = k.versine(), k3 = k.third();
    slope2 = -k.second_slope(), slope3 = -k.third_slope();
    sine_half = k.sine_over_angle(), cosine_half = k.c0;
  }
  /// theta > pi.
  RotationCoefficients(const Vector& phi, const stumpff_detail::BeyondPi<S>& k)
      : axis(phi / k.theta),
        theta(k.theta),
        within_pi(false),
        k1(k.k1),
        k2(k.k2),
        k3(k.k3),
        slope2(k.slope2),
        slope3(k.slope3),
        sine_half(k.sine_half),
        cosine_half(k.cosine_half) {}
};

namespace stumpff_detail {
template <Scalar S, Precision P, class Vector, class F>
[[gnu::noinline, gnu::cold]] auto with_coefficients_beyond_pi(const Vector& phi, const S& x, F f) {
  return f(RotationCoefficients<S, Vector, P>(phi, beyond_pi<S>(large_angle<S>(phi, x))));
}
}  // namespace stumpff_detail

/// Returns f(k) for the coefficients k of phi. The rare, slower case theta > pi is a separate function.
template <Scalar S, Precision P, class Vector, class F>
[[gnu::always_inline]] inline auto with_coefficients(const Vector& phi, F f) {
  const auto x = squared_angle<S, P>(phi);
  if constexpr (!side_by_side<S>)
    if (!within_pi(x.high)) [[unlikely]]
      return stumpff_detail::with_coefficients_beyond_pi<S, P>(Vector(phi[0], phi[1], phi[2]), x.high, f);
  return f(RotationCoefficients<S, Vector, P>(phi, x));
}

}  // namespace liecheck
