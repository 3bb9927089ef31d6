#pragma once
// Powers of two that bring the norm of a quaternion or of (cos, sin) near 1 without a rounding error.

#include <liecheck/scalar/double_word.hpp>
#include <liecheck/scalar/precision.hpp>
#include <liecheck/spatial/types.hpp>
#include <stdexcept>
#include <type_traits>

namespace liecheck {

namespace unit_vector_detail {

template <int N>
inline constexpr const char* zero_is_refused = N == 4   ? "a zero quaternion is not a rotation"
                                               : N == 3 ? "a zero vector has no direction"
                                                        : "(cos, sin) = (0, 0) is not an angle";

/// True if |u|^2 is in (1/2, 3/2); false for NaN. excess = |u|^2 - 1.
template <Scalar S>
[[gnu::always_inline]] inline bool atUnitScale(const S& excess) {
  return absolute<S>(excess) < S(1) / S(2);
}

/// The scalar to which results are rounded: S, or for a double word that of its parts.
template <class S>
struct RoundedTo : std::type_identity<S> {};
template <class S>
struct RoundedTo<DoubleWord<S>> : std::type_identity<S> {};

/// True if 3/8 excess^2, which a first-order normalisation leaves, is at most eps/10; false for NaN.
/// excess = |u|^2 - 1.
template <Scalar S>
[[gnu::always_inline]] inline bool firstOrderSuffices(const S& excess) {
  return excess * excess < S(eps<typename RoundedTo<S>::type>() / 4);
}

/// R, or for scalars wider than double, whose matrices may hold the numbers of narrower ones, a matrix X with the same
/// nearest rotation for which firstOrderSuffices: X <- X (3 I - X^T X)/2 (Higham 2008, eq. 8.20), which squares
/// |X^T X - I|. Domain: |R^T R - I| <= 1/2; the steps end where they do not converge.
template <Scalar S, Precision P = Precision::standard>
[[gnu::always_inline]] inline decltype(auto) firstOrderOrthogonal(const Matrix3<S>& R) {
  if constexpr (std::numeric_limits<S>::digits <= 64 || P == Precision::fast ||
                !std::is_same_v<typename RoundedTo<S>::type, S>) {
    return R;
  } else {
    Matrix3<S> X = R;
    for (S last(2);;) {
      const Matrix3<S> E = Matrix3<S>(X.transpose() * X) - Matrix3<S>(Matrix3<S>::Identity());
      S size(0);
      for (int i = 0; i < 9; ++i) size += absolute<S>(E.data()[i]);
      if (firstOrderSuffices<S>(size) || !(size < last)) return X;
      X = Matrix3<S>(X - Matrix3<S>(X * E) / S(2)), last = size;
    }
  }
}

/// |u|^2.
template <Scalar S, int N>
[[gnu::always_inline]] inline S square(const Eigen::Matrix<S, N, 1>& u) {
  S sum = u[0] * u[0];
  for (int i = 1; i < N; ++i) sum += u[i] * u[i];
  return sum;
}

/// True if a sum of squares has neither overflowed nor lost digits to underflow; false for NaN. A square that underflows
/// is wrong by less than min, which is eps^2 of the sum.
template <Scalar S>
[[gnu::always_inline]] inline bool squareIsAccurate(const S& square) {
  using Limits = std::numeric_limits<S>;
  static const S least = S(Limits::min()) / (eps<S>() * eps<S>());
  return least < square && square < S(Limits::max());
}

/// u 2^k with |u 2^k|^2 in [1/2, 2): exact, except for numbers that are 2^-1000 of the largest. NaN if u is
/// not finite. Throws std::invalid_argument if u is zero.
template <Scalar S, int N>
[[gnu::noinline, gnu::cold]] Eigen::Matrix<S, N, 1> scaledByPowerOfTwo(Eigen::Matrix<S, N, 1> u) {
  using std::frexp, std::ldexp;
  S largest(0);
  bool all_finite = true;
  for (int i = 0; i < N; ++i) {
    const S a = absolute<S>(u[i]);
    if (largest < a) largest = a;
    all_finite = all_finite && finite<S>(a);
  }
  if (!all_finite) return Eigen::Matrix<S, N, 1>::Constant(S(std::numeric_limits<S>::quiet_NaN()));
  if (largest == S(0)) throw std::invalid_argument(zero_is_refused<N>);
  int k = 0;
  static_cast<void>(frexp(largest, &k));
  for (int i = 0; i < N; ++i) u[i] = S(ldexp(u[i], -k));
  const S scale = square<S, N>(u);  // in [1/4, 4)
  if (!(scale < S(2))) u /= S(2);
  if (scale < S(1) / S(2)) u *= S(2);
  return u;
}

/// f(u...), with every u scaled as above unless all |u|^2 are between 2^-20 and 2^20, so that products of the vectors neither
/// overflow nor underflow.
template <class F, Scalar S, int... N>
[[gnu::noinline, gnu::cold]] auto scaledFirst(F f, const Eigen::Matrix<S, N, 1>&... u) {
  return f(scaledByPowerOfTwo<S, N>(u)...);
}
template <class F, Scalar S, int... N>
[[gnu::always_inline]] inline auto atUnitScale(F f, const Eigen::Matrix<S, N, 1>&... u) {
  const S most(1 << 20), least = S(1) / most;
  if (((least < square<S, N>(u) && square<S, N>(u) < most) && ...)) [[likely]]
    return f(u...);
  return scaledFirst<F, S, N...>(f, u...);
}

template <Scalar S, int N>
[[gnu::always_inline]] inline Eigen::Matrix<S, N, 1> overNorm(const Eigen::Matrix<S, N, 1>& u,
                                                              const S& square) {
  using std::sqrt;
  return Eigen::Matrix<S, N, 1>(u / S(sqrt(square)));
}
template <Scalar S, int N>
[[gnu::noinline, gnu::cold]] Eigen::Matrix<S, N, 1> normalizedFar(const Eigen::Matrix<S, N, 1>& u) {
  const Eigen::Matrix<S, N, 1> scaled = scaledByPowerOfTwo<S, N>(u);
  return overNorm<S, N>(scaled, square<S, N>(scaled));
}

}  // namespace unit_vector_detail

/// u/|u|, without overflow or underflow of |u|^2. Error 2 eps. NaN if u is not finite. Throws
/// std::invalid_argument if u is zero.
template <Scalar S, int N>
[[gnu::always_inline]] inline Eigen::Matrix<S, N, 1> normalizedUnit(const Eigen::Matrix<S, N, 1>& u) {
  const S square = unit_vector_detail::square<S, N>(u);
  if (!unit_vector_detail::squareIsAccurate<S>(square)) [[unlikely]]
    return unit_vector_detail::normalizedFar<S, N>(u);
  return unit_vector_detail::overNorm<S, N>(u, square);
}

}  // namespace liecheck
