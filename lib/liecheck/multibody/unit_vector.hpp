#pragma once
// The unit vectors that are stored in q: (cos, sin) [2] and quaternions [4]. A finite vector u != 0 of any
// norm represents u/|u|. Formulas for |u| near 1 have an error of (|u|^2 - 1)^2, so other vectors are scaled
// or normalised first.

#include <liecheck/spatial/unit_scale.hpp>

namespace liecheck {

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
