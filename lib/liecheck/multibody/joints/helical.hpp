#pragma once
// A helical joint: rotation about an axis by q [rad] and translation along it by pitch q [m]. nq = nv = 1.

#include <liecheck/multibody/joints/revolute.hpp>

namespace liecheck {

template <Scalar S>
struct Helical : LinearCoordinates<S, 1> {
  Axis<S> axis;
  S pitch;
  /// pitch [m/rad], not m per revolution. Throws std::invalid_argument if pitch is not finite.
  Helical(const Axis<S>& unit_axis, const S& metres_per_radian) : axis(unit_axis), pitch(metres_per_radian) {
    if (!finite<S>(pitch))
      checked_rotation_detail::refuse<S>("the pitch of a helical joint", pitch, "not finite");
  }
  Helical(const Vector3<S>& direction, const S& metres_per_radian)
      : Helical(Axis<S>(direction), metres_per_radian) {}

  /// X_PJ (R(axis, q), pitch q axis).
  SE3<S> transform(const SE3<S>& X_PJ, const Vector1<S>& q) const {
    const Vector3<S> p = S(pitch * q[0]) * axis.to_vector();
    return SE3<S>(Revolute<S>(axis).transform(X_PJ, q).rotation(), X_PJ.act(p));
  }
  /// (pitch axis, axis).
  Vector6<S> subspace() const { return Motion<S>(pitch * axis.to_vector(), axis.to_vector()).to_vector(); }

  std::string shortname() const { return axis.shortname("JointModelH", "JointModelHelicalUnaligned"); }
  template <Scalar T>
  Helical<T> cast() const {
    return Helical<T>(axis.template cast<T>(), T(pitch));
  }
};

}  // namespace liecheck
