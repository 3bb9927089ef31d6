#include <oracles/ball_arithmetic.hpp>

#include <array>
#include <boost/math/constants/constants.hpp>
#include <oracles/real.hpp>

namespace liecheck::oracles {
namespace {

/// x rounded to a midpoint type. The error is at most u^2 |x| / 2 in double-double and u |x| in double.
template <class M>
M rounded(const Real& x);
template <>
DoubleDouble rounded<DoubleDouble>(const Real& x) {
  const auto high = static_cast<double>(x);
  return {high, static_cast<double>(Real(x - high))};
}
template <>
double rounded<double>(const Real& x) {
  return static_cast<double>(x);
}

template <class M>
Ball<M> constant(const Real& x) {
  const M m = rounded<M>(x);
  return {m, std::fabs(Rounding<M>::head(m)) * Rounding<M>::add};
}

constexpr int table_size = 64;  ///< sines and cosines are tabulated at 2 pi k / 64

template <class M>
struct Tables {
  std::array<double, 3> step;  ///< their sum is 2 pi / 64 to a relative 2^-159
  std::array<Ball<M>, table_size> sine, cosine;
  Tables() {
    const Real angle = 2 * boost::math::constants::pi<Real>() / table_size;
    Real remainder = angle;
    for (double& s : step) {
      s = static_cast<double>(remainder);
      remainder -= s;
    }
    for (int k = 0; k < table_size; ++k) {
      const auto i = static_cast<std::size_t>(k);
      sine[i] = k % (table_size / 2) == 0 ? Ball<M>(0) : constant<M>(sin(Real(k * angle)));
      cosine[i] =
          (k + table_size / 4) % (table_size / 2) == 0 ? Ball<M>(0) : constant<M>(cos(Real(k * angle)));
    }
  }
};
template <class M>
const Tables<M>& tables() {
  static const Tables<M> t;
  return t;
}

/// The numbers (-1)^j / (2j + K)! for j < N.
template <class M, int K, int N>
const std::array<M, N>& series() {
  static const auto table = [] {
    std::array<M, N> c;
    Real factorial(1);
    for (int i = 2; i <= K; ++i) factorial *= i;
    for (int j = 0; j < N; ++j) {
      if (j > 0) factorial *= -(2 * j + K - 1) * (2 * j + K);
      c[static_cast<std::size_t>(j)] = rounded<M>(1 / factorial);
    }
    return c;
  }();
  return table;
}

/// sum_j (-x)^j / (2j + K)!: the first terms in double-double, the rest (below 2^-50 of the sum) in double.
template <int K, int N, int DoubleDoubleTerms>
DoubleDouble sum(const DoubleDouble& x) {
  const auto& c = series<DoubleDouble, K, N>();
  double tail = c[N - 1].high;
  for (int j = N - 2; j >= DoubleDoubleTerms; --j) tail = tail * x.high + c[static_cast<std::size_t>(j)].high;
  DoubleDouble s = x * tail + c[DoubleDoubleTerms - 1];
  for (int j = DoubleDoubleTerms - 2; j >= 0; --j) s = s * x + c[static_cast<std::size_t>(j)];
  return s;
}
/// The same sum in double for 0 <= x <= 1. The last addition and the rounding of its constant have errors of
/// 2 u together, and the last product has an error of u / 12. Each term is at most 1/12 of the one before it
/// in the series, so each step of the loop adds at most 1/12 of what the next step adds: in all below 2.3 u.
template <int K, int N, int>
double sum(double x) {
  const auto& c = series<double, K, N>();
  double s = c[N - 1];
  for (int j = N - 2; j >= 0; --j) s = s * x + c[static_cast<std::size_t>(j)];
  return s;
}

/// sin r = r - r x c_3(x) and cos r = 1 - x c_2(x) for |r| <= 0.05, x = r^2 <= 0.0025. Errors relative to the
/// result: the truncation error is x^9/19! < 2^-140.
/// - Double-double: the terms that are summed in double are below x^4 / 9! < 2^-52, and their rounding errors
///   are below 2^-104. The other terms are below x/2 and have errors of 2^-103 each, 2^-110 in total. The
///   last addition has an error of 3 2^-106.
/// - Double: the subtraction has an error of u, and the terms below x/2 have five roundings.
template <class M>
void small_sin_cos(const Ball<M>& r, Ball<M>& sine, Ball<M>& cosine) {
  const M x = r.m * r.m;
  const M s = r.m - r.m * (x * sum<3, 8, 4>(x)), c = Rounding<M>::make(1) - x * sum<2, 9, 4>(x);
  // If a product underflows, x is below 2^-1060, and r x c_3 and x c_2 are below 2^-900 of the result.
  constexpr double small = Rounding<M>::small_sine;
  sine = {s, Ball<M>::up(r.r + small * std::fabs(Rounding<M>::head(s)))};
  cosine = {c, Ball<M>::up(r.r + small)};
}

}  // namespace

template <class M>
void sin_cos(const Ball<M>& x, Ball<M>& sine, Ball<M>& cosine) {
  if (!(x.size() < 0x1p40)) throw Undecided();
  const Tables<M>& t = tables<M>();
  const double k = std::nearbyint(x.head() / t.step[0]);
  if (k == 0) return small_sin_cos(x, sine, cosine);
  // In double-double each product is exact. If x is exact too, the first differences keep their relative
  // accuracy, even if x is very close to k 2 pi / 64.
  Ball<M> remainder = x;
  for (const double step : t.step) remainder -= Ball<M>(k) * Ball<M>(step);
  remainder.r = Ball<M>::up(remainder.r + std::fabs(x.head()) * 0x1p-158);
  Ball<M> s, c;
  small_sin_cos(remainder, s, c);
  const auto i = static_cast<std::size_t>(static_cast<long long>(k) & (table_size - 1));
  sine = t.sine[i] * c + t.cosine[i] * s;
  cosine = t.cosine[i] * c - t.sine[i] * s;
}

/// a0 + atan(t) with t = (y cos a0 - x sin a0) / (x cos a0 + y sin a0), an identity for any a0. Here a0 is
/// atan2(y, x) in double, so that |t| < 2^-20 and atan t = t - t^3/3 with an error below |t|^5.
template <class M>
Ball<M> atan2(const Ball<M>& y, const Ball<M>& x) {
  const double a0 = std::atan2(y.head(), x.head());
  if (!std::isfinite(a0) || (y.exactly_zero() && x.head() >= 0)) {
    if (x.size() <= x.r || !std::isfinite(a0)) throw Undecided();
    return y;
  }
  if (a0 < 0 && std::fabs(y.head()) <= y.r && x.head() < 0) throw Undecided();  // on the branch cut
  Ball<M> s, c;
  sin_cos(Ball<M>(a0), s, c);
  const Ball<M> t = (y * c - x * s) / (x * c + y * s);
  if (!(t.size() + t.r < 0x1p-20)) throw Undecided();
  const Ball<M> a = Ball<M>(a0) + (t - t * t * t / Ball<M>(3));
  const double t_bound = t.size() + t.r;
  return {a.m, Ball<M>::up(a.r + t_bound * t_bound * t_bound * t_bound * t_bound)};
}

template <>
void sin_cos(const RealBall& x, RealBall& sine, RealBall& cosine) {
  if (!(x.size() < 0x1p40)) throw Undecided();
  sin_cos(x.m, sine.m, cosine.m);
  const double r = RealBall::up(x.r + RealBall::Round::multiply);
  sine.r = x.exactly_zero() ? 0 : r, cosine.r = x.exactly_zero() ? 0 : r;
}

/// If a point at the distance d moves by r <= d / 2, its direction changes by at most asin(r / d) <= 1.1 r / d.
template <>
RealBall atan2(const RealBall& y, const RealBall& x) {
  if (y.exactly_zero() && x.head() > x.r) return y;
  const double distance = std::hypot(x.head(), y.head()) * (1 - 0x1p-50), moved = x.r + y.r;
  if (!(moved <= distance / 2) || (x.head() < 0 && std::fabs(y.head()) <= y.r)) throw Undecided();
  const Real angle = atan2(y.m, x.m);
  return {angle, RealBall::up(1.1 * moved / distance + RealBall::Round::multiply * 4)};
}

// Errors relative to the sum: truncation after fourteen terms gives x^14/32! < 2^-113. The terms from x^8 on
// are summed in double and are below 2^-56. The eight double-double steps give 2^-101, since each term is at
// most 1/30 of the one before it. The error of x adds less than its radius, since |c_k'| <= 1/2.
template <class M>
Ball<M> stumpff_series(int k, const Ball<M>& x) {
  const M s = k == 4 ? sum<4, 14, 8>(x.m) : k == 5 ? sum<5, 14, 8>(x.m) : sum<6, 14, 8>(x.m);
  return {s, Ball<M>::up(x.r + Rounding<M>::stumpff * Rounding<M>::head(s))};
}

#define LIECHECK_BALL_FUNCTIONS(T)         \
  template void sin_cos(const T&, T&, T&); \
  template T atan2(const T&, const T&);    \
  template T stumpff_series(int k, const T&);
LIECHECK_BALL_FUNCTIONS(DoubleBall)
LIECHECK_BALL_FUNCTIONS(DoubleDoubleBall)

}  // namespace liecheck::oracles
