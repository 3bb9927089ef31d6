#pragma once
// A prismatic joint: a translation along an axis by q [m], v [m/s]. nq = nv = 1.

#include <liecheck/multibody/joints/axis.hpp>
#include <liecheck/multibody/joints/linear_coordinates.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck {

template <Scalar S>
struct Prismatic : LinearCoordinates<S, 1> {
  Axis<S> axis;
  explicit Prismatic(const Axis<S>& unit_axis) : axis(unit_axis) {}
  explicit Prismatic(const Vector3<S>& direction) : axis(direction) {}

  /// X_PJ times the pose with rotation I and translation q axis.
  SE3<S> transform(const SE3<S>& X_PJ, const Vector1<S>& q) const {
    return SE3<S>(X_PJ.rotation(), X_PJ.act(Vector3<S>(q[0] * axis.to_vector())));
  }
  /// (axis, 0).
  Vector6<S> subspace() const { return Motion<S>(axis.to_vector(), Vector3<S>::Zero()).to_vector(); }

  std::string shortname() const { return axis.shortname("JointModelP", "JointModelPrismaticUnaligned"); }
  template <Scalar T>
  Prismatic<T> cast() const {
    return Prismatic<T>(axis.template cast<T>());
  }
};

}  // namespace liecheck
