#pragma once
// Motion: a spatial velocity V_AB_E = (u, omega), linear part first, at a reference point, in a frame's axes
// [m/s, rad/s]. The same class holds a twist increment [m, rad].

#include <liecheck/spatial/types.hpp>

namespace liecheck {

template <Scalar S>
class Force;

template <Scalar S>
class Motion {
 public:
  /// Uninitialised: NaN in debug.
  Motion() {
    mark_uninitialised(linear_);
    mark_uninitialised(angular_);
  }
  Motion(const Vector3<S>& linear, const Vector3<S>& angular) : linear_(linear), angular_(angular) {}
  explicit Motion(const Vector6<S>& v) : linear_(v.template head<3>()), angular_(v.template tail<3>()) {}

  static Motion Zero() { return Motion(Vector3<S>::Zero(), Vector3<S>::Zero()); }

  const Vector3<S>& linear() const { return linear_; }
  const Vector3<S>& angular() const { return angular_; }
  /// (linear, angular), shape 6.
  [[gnu::always_inline]] Vector6<S> to_vector() const {
    Vector6<S> v;
    for (int i = 0; i < 3; ++i) v[i] = linear_[i], v[3 + i] = angular_[i];
    return v;
  }

  Motion operator+(const Motion& o) const { return {linear_ + o.linear_, angular_ + o.angular_}; }
  Motion operator-(const Motion& o) const { return {linear_ - o.linear_, angular_ - o.angular_}; }
  Motion operator-() const { return {-linear_, -angular_}; }
  Motion operator*(const S& s) const { return {linear_ * s, angular_ * s}; }

  /// ad_V W = (omega_V x u_W + u_V x omega_W, omega_V x omega_W). Featherstone (2008), eq. 2.31.
  Motion cross(const Motion& W) const {
    return {liecheck::cross(angular_, W.linear_) + liecheck::cross(linear_, W.angular_),
            liecheck::cross(angular_, W.angular_)};
  }
  /// ad_V* F = -ad_V^T F = (omega x f, omega x n + u x f). Featherstone (2008), eq. 2.32.
  Force<S> cross(const Force<S>& F) const;

  /// Power F^T V [W]: the same in every frame.
  S dot(const Force<S>& F) const;

 private:
  Vector3<S> linear_, angular_;
};

}  // namespace liecheck
