#include <oracles/ball_arithmetic.hpp>

#include <array>
#include <boost/math/constants/constants.hpp>
#include <oracles/real.hpp>

namespace liecheck::oracles {
namespace {

/// x rounded to a mid-point, within u^2 |x| / 2, or u |x|.
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

constexpr int parts = 64;  ///< of a turn

template <class M>
struct Tables {
  std::array<double, 3> part;  ///< 2 pi / 64, within 2^-159 of itself
  std::array<Ball<M>, parts> sine, cosine;
  Tables() {
    const Real angle = 2 * boost::math::constants::pi<Real>() / parts;
    Real rest = angle;
    for (double& p : part) {
      p = static_cast<double>(rest);
      rest -= p;
    }
    for (int k = 0; k < parts; ++k) {
      const auto i = static_cast<std::size_t>(k);
      sine[i] = k % (parts / 2) == 0 ? Ball<M>(0) : constant<M>(sin(Real(k * angle)));
      cosine[i] = (k + parts / 4) % (parts / 2) == 0 ? Ball<M>(0) : constant<M>(cos(Real(k * angle)));
    }
  }
};
template <class M>
const Tables<M>& tables() {
  static const Tables<M> t;
  return t;
}

/// (-1)^j / (2j + k)!
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

/// sum_j (-x)^j / (2j + K)! of `exact` terms in double-double and the rest, below 2^-50 of the sum, in double.
template <int K, int N, int Exact>
DoubleDouble sum(const DoubleDouble& x) {
  const auto& c = series<DoubleDouble, K, N>();
  double tail = c[N - 1].high;
  for (int j = N - 2; j >= Exact; --j) tail = tail * x.high + c[static_cast<std::size_t>(j)].high;
  DoubleDouble s = x * tail + c[Exact - 1];
  for (int j = Exact - 2; j >= 0; --j) s = s * x + c[static_cast<std::size_t>(j)];
  return s;
}
/// The same in double, 0 <= x <= 1: the terms fall by 1/12 and more, so that the last sum and constant cost 2 u, the
/// last product u / 12 and all before it a twelfth of the whole: below 2.3 u.
template <int K, int N, int>
double sum(double x) {
  const auto& c = series<double, K, N>();
  double s = c[N - 1];
  for (int j = N - 2; j >= 0; --j) s = s * x + c[static_cast<std::size_t>(j)];
  return s;
}

/// The relative error of small_sin_cos and of stumpff_series.
template <class M>
struct SeriesError;
template <>
struct SeriesError<DoubleDouble> {
  static constexpr double small = 0x1p-102, stumpff = 0x1p-101;
};
template <>
struct SeriesError<double> {
  static constexpr double small = 0x1p-52, stumpff = 0x1p-51;
};

/// sin and cos of |r| <= 0.05. With x = r^2 <= 0.0025: sin r = r - r x c_3(x), cos r = 1 - x c_2(x). Left out:
/// x^9/19! < 2^-140. In double-double: terms in double x^4 9!^-1 < 2^-52 of the whole, so 2^-104 of rounding; the
/// double-double ones are below x/2, so their 2^-103 each is 2^-110 of the whole; one addition, 3 2^-106. In double:
/// one subtraction, u, and what is below x/2 of the whole with five roundings.
template <class M>
void small_sin_cos(const Ball<M>& r, Ball<M>& sine, Ball<M>& cosine) {
  const M x = r.m * r.m;
  const M s = r.m - r.m * (x * sum<3, 8, 4>(x)), c = Rounding<M>::make(1) - x * sum<2, 9, 4>(x);
  // A product that underflows: r x c_3 and x c_2 are then below 2^-900 of the whole, the square below 2^-1060.
  constexpr double small = SeriesError<M>::small;
  sine = {s, Ball<M>::up(r.r + small * std::fabs(Rounding<M>::head(s)))};
  cosine = {c, Ball<M>::up(r.r + small)};
}

template <class M>
void table_sin_cos(const Ball<M>& x, Ball<M>& sine, Ball<M>& cosine) {
  if (!(x.size() < 0x1p40)) throw Undecided();
  const Tables<M>& t = tables<M>();
  const double k = std::nearbyint(x.head() / t.part[0]);
  if (k == 0) return small_sin_cos(x, sine, cosine);
  // Each product is exact; of an exact x even the first differences lose nothing, however near x is to a pole.
  Ball<M> rest = x;
  for (const double p : t.part) rest -= Ball<M>(k) * Ball<M>(p);
  rest.r = Ball<M>::up(rest.r + std::fabs(x.head()) * 0x1p-158);
  Ball<M> s, c;
  small_sin_cos(rest, s, c);
  const auto i = static_cast<std::size_t>(static_cast<long long>(k) & (parts - 1));
  sine = t.sine[i] * c + t.cosine[i] * s;
  cosine = t.cosine[i] * c - t.sine[i] * s;
}

/// With a0 = atan2(y, x) in double: a0 + atan(t), t = (y cos a0 - x sin a0) / (x cos a0 + y sin a0), exact
/// whatever a0 is; |t| < 2^-40, so that atan t = t - t^3/3 to t^5.
template <class M>
Ball<M> corrected_atan2(const Ball<M>& y, const Ball<M>& x) {
  const double a0 = std::atan2(y.head(), x.head());
  if (!std::isfinite(a0) || (y.exactly_zero() && x.head() >= 0)) {
    if (x.size() <= x.r || !std::isfinite(a0)) throw Undecided();
    return y;
  }
  if (a0 < 0 && std::fabs(y.head()) <= y.r && x.head() < 0) throw Undecided();  // the branch cut
  Ball<M> s, c;
  table_sin_cos(Ball<M>(a0), s, c);
  const Ball<M> t = (y * c - x * s) / (x * c + y * s);
  if (!(t.size() + t.r < 0x1p-20)) throw Undecided();
  const Ball<M> a = Ball<M>(a0) + (t - t * t * t / Ball<M>(3));
  const double rest = t.size() + t.r;
  return {a.m, Ball<M>::up(a.r + rest * rest * rest * rest * rest)};
}

}  // namespace

template <class M>
void sin_cos(const Ball<M>& x, Ball<M>& sine, Ball<M>& cosine) {
  table_sin_cos(x, sine, cosine);
}
template <class M>
Ball<M> atan2(const Ball<M>& y, const Ball<M>& x) {
  return corrected_atan2(y, x);
}

// Fourteen terms leave x^14/32! < 2^-113 of the sum; in double-double those from x^8 on, below 2^-56 of it, are in
// double. Eight double-double steps whose terms fall by 1/30: 2^-101. |c_k'| <= 1/2.
template <class M>
Ball<M> stumpff_series(int k, const Ball<M>& x) {
  const M s = k == 4 ? sum<4, 14, 8>(x.m) : k == 5 ? sum<5, 14, 8>(x.m) : sum<6, 14, 8>(x.m);
  return {s, Ball<M>::up(x.r + SeriesError<M>::stumpff * Rounding<M>::head(s))};
}

#define LIECHECK_BALL_FUNCTIONS(T)         \
  template void sin_cos(const T&, T&, T&); \
  template T atan2(const T&, const T&);    \
  template T stumpff_series(int k, const T&);
LIECHECK_BALL_FUNCTIONS(DoubleBall)
LIECHECK_BALL_FUNCTIONS(DoubleDoubleBall)

}  // namespace liecheck::oracles
