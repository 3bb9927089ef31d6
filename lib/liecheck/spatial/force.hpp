#pragma once
// Force: a wrench F_B_E = (f, n), force first, then the moment about the reference point [N, N m].

#include <liecheck/spatial/motion.hpp>
#include <liecheck/spatial/types.hpp>

namespace liecheck {

template <Scalar S>
class Force : public SpatialVector<Force<S>, S> {
  using Base = SpatialVector<Force<S>, S>;

 public:
  using Base::Base, Base::linear, Base::angular;

  /// Power F^T V [W].
  [[gnu::always_inline]] S dot(const Motion<S>& V) const {
    const Vector3<S>&f = linear(), &n = angular(), &u = V.linear(), &w = V.angular();
    return S(f[0] * u[0] + f[1] * u[1] + f[2] * u[2]) + S(n[0] * w[0] + n[1] * w[1] + n[2] * w[2]);
  }
};

template <Scalar S>
[[gnu::always_inline]] inline Force<S> Motion<S>::cross(const Force<S>& F) const {
  const Vector3<S> a = liecheck::cross<S>(angular(), F.linear()),
                   b = liecheck::cross<S>(angular(), F.angular()),
                   c = liecheck::cross<S>(linear(), F.linear());
  return {a[0], a[1], a[2], b[0] + c[0], b[1] + c[1], b[2] + c[2]};
}

template <Scalar S>
[[gnu::always_inline]] inline S Motion<S>::dot(const Force<S>& F) const {
  return F.dot(*this);
}

}  // namespace liecheck
