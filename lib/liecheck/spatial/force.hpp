#pragma once
// Force: a wrench F_B_E = (f, n), force first, then the moment about the reference point [N, N m].

#include <liecheck/spatial/motion.hpp>
#include <liecheck/spatial/types.hpp>

namespace liecheck {

template <Scalar S>
class Force {
 public:
  /// Uninitialised: NaN in debug.
  Force() {
    mark_uninitialised(linear_);
    mark_uninitialised(angular_);
  }
  Force(const Vector3<S>& linear, const Vector3<S>& angular) : linear_(linear), angular_(angular) {}
  explicit Force(const Vector6<S>& v) : linear_(v.template head<3>()), angular_(v.template tail<3>()) {}

  static Force Zero() { return Force(Vector3<S>::Zero(), Vector3<S>::Zero()); }

  const Vector3<S>& linear() const { return linear_; }
  const Vector3<S>& angular() const { return angular_; }
  /// (force, moment), shape 6.
  [[gnu::always_inline]] Vector6<S> to_vector() const {
    Vector6<S> v;
    for (int i = 0; i < 3; ++i) v[i] = linear_[i], v[3 + i] = angular_[i];
    return v;
  }

  Force operator+(const Force& o) const { return {linear_ + o.linear_, angular_ + o.angular_}; }
  Force operator-(const Force& o) const { return {linear_ - o.linear_, angular_ - o.angular_}; }
  Force operator-() const { return {-linear_, -angular_}; }
  Force operator*(const S& s) const { return {linear_ * s, angular_ * s}; }

  /// Power F^T V [W].
  [[gnu::always_inline]] S dot(const Motion<S>& V) const {
    const Vector3<S>&u = V.linear(), &w = V.angular();
    return S(linear_[0] * u[0] + linear_[1] * u[1] + linear_[2] * u[2]) +
           S(angular_[0] * w[0] + angular_[1] * w[1] + angular_[2] * w[2]);
  }

 private:
  Vector3<S> linear_, angular_;
};

template <Scalar S>
Force<S> Motion<S>::cross(const Force<S>& F) const {
  return {liecheck::cross(angular_, F.linear()),
          liecheck::cross(angular_, F.angular()) + liecheck::cross(linear_, F.linear())};
}

template <Scalar S>
[[gnu::always_inline]] inline S Motion<S>::dot(const Force<S>& F) const {
  return F.dot(*this);
}

}  // namespace liecheck
