#pragma once
// The unit vectors that are stored in q: (cos, sin) [2] and quaternions [4]. A finite vector u != 0 of any
// norm represents u/|u|. Formulas for |u| near 1 have an error of (|u|^2 - 1)^2, so other vectors are scaled
// or normalised first.

#include <liecheck/scalar/double_word.hpp>
#include <liecheck/spatial/unit_scale.hpp>
#include <type_traits>

namespace liecheck {

namespace unit_vector_detail {

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

}  // namespace unit_vector_detail

/// u/|u|, without overflow or underflow of |u|^2. Error 2 eps. NaN if u is not finite. Throws
/// std::invalid_argument if u is zero.
template <Scalar S, int N>
[[gnu::noinline]] Eigen::Matrix<S, N, 1> normalizedUnit(const Eigen::Matrix<S, N, 1>& u) {
  const auto over_norm = [](const Eigen::Matrix<S, N, 1>& x, const S& square) {
    using std::sqrt;
    return Eigen::Matrix<S, N, 1>(x / S(sqrt(square)));
  };
  const S square = unit_vector_detail::square<S, N>(u);
  if (unit_vector_detail::atUnitScale<S>(S(square - S(1)))) [[likely]]
    return over_norm(u, square);
  const Eigen::Matrix<S, N, 1> scaled = unit_vector_detail::scaledByPowerOfTwo<S, N>(u);
  return over_norm(scaled, unit_vector_detail::square<S, N>(scaled));
}

/// u itself if |u|^2 is in (1/2, 3/2), otherwise scaled by a power of two so that it is in [1/2, 2).
template <Scalar S, int N>
[[gnu::always_inline]] inline Eigen::Matrix<S, N, 1> atUnitScale(const Eigen::Matrix<S, N, 1>& u) {
  if (!unit_vector_detail::atUnitScale<S>(S(unit_vector_detail::square<S, N>(u) - S(1)))) [[unlikely]]
    return unit_vector_detail::scaledByPowerOfTwo<S, N>(u);
  return u;
}

/// u itself if a first-order normalisation of it suffices, otherwise normalizedUnit(u).
template <Scalar S, int N>
[[gnu::always_inline]] inline Eigen::Matrix<S, N, 1> nearUnit(const Eigen::Matrix<S, N, 1>& u) {
  if (!unit_vector_detail::firstOrderSuffices<S>(S(unit_vector_detail::square<S, N>(u) - S(1)))) [[unlikely]]
    return normalizedUnit<S, N>(u);
  return u;
}

}  // namespace liecheck
