#pragma once
// |v| without overflow or underflow of |v|^2.

#include <liecheck/spatial/types.hpp>

namespace liecheck {

namespace multibody_detail {

/// 2-norm of a vector of n numbers; NaN if one of them is NaN. Error 2 eps + n/2 eps. (Eigen's stableNorm
/// needs numeric_limits::max, which float128 of Boost 1.74 defines in GNU mode only.)
template <class Vector>
typename Vector::Scalar norm(const Vector& v) {
  using S = typename Vector::Scalar;
  using std::sqrt;
  const S scale = v.size() == 0 ? S(0) : S(v.cwiseAbs().maxCoeff());
  if (!(scale > S(0)) || !finite<S>(scale)) return v.squaredNorm();
  return scale * S(sqrt((v / scale).squaredNorm()));
}

}  // namespace multibody_detail
}  // namespace liecheck
