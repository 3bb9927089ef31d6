#pragma once
// |v| without overflow or underflow of |v|^2.

#include <algorithm>
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

/// True if |p1 - p0| <= budget max(1, |p0|, |p1|). All lengths are divided by 4, so that none overflows. False
/// if a number is not finite.
template <class Vector>
bool samePosition(const Vector& p0, const Vector& p1, const typename Vector::Scalar& budget) {
  using S = typename Vector::Scalar;
  const Vector a = p0 / S(4), b = p1 / S(4);
  const S apart = norm(Vector(b - a));
  return finite<S>(apart) && apart <= budget * std::max({S(1) / S(4), norm(a), norm(b)});
}

}  // namespace multibody_detail
}  // namespace liecheck
