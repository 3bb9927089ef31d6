#pragma once
// A revolute joint: a rotation about an axis by q [rad], v [rad/s]. nq = nv = 1.

#include <liecheck/multibody/joints/axis.hpp>
#include <liecheck/multibody/joints/linear_coordinates.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck {

template <Scalar S>
struct Revolute : LinearCoordinates<S, 1> {
  Axis<S> axis;
  explicit Revolute(const Axis<S>& unit_axis) : axis(unit_axis) {}
  explicit Revolute(const Vector3<S>& direction) : axis(direction) {}

  /// X_PJ times the pose with rotation R(axis, q) and translation 0. Error 4 eps.
  [[gnu::always_inline]] SE3<S> transform(const SE3<S>& X_PJ, const Vector1<S>& q) const {
    using std::cos, std::sin;
    return SE3<S>(axis.rotated(X_PJ.rotation(), S(cos(q[0])), S(sin(q[0]))), X_PJ.translation());
  }
  /// (0, axis).
  Vector6<S> subspace() const { return Motion<S>(Vector3<S>::Zero(), axis.to_vector()).to_vector(); }

  std::string shortname() const { return axis.shortname("JointModelR", "JointModelRevoluteUnaligned"); }
  template <Scalar T>
  Revolute<T> cast() const {
    return Revolute<T>(axis.template cast<T>());
  }
};

}  // namespace liecheck
