#pragma once
// Powers of two that bring the norm of a quaternion or of (cos, sin) near 1 without a rounding error.

#include <liecheck/scalar/double_word.hpp>
#include <liecheck/spatial/types.hpp>
#include <stdexcept>
#include <type_traits>

namespace liecheck {

namespace unit_vector_detail {

template <int N>
inline constexpr const char* zero_is_refused =
    N == 4 ? "a zero quaternion is not a rotation" : "(cos, sin) = (0, 0) is not an angle";

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
