#pragma once
// A turn about an axis by q [rad], v [rad/s]. nq = nv = 1.

#include <liecheck/multibody/joints/axis.hpp>
#include <liecheck/multibody/joints/linear_coordinates.hpp>

namespace liecheck {

template <Scalar S>
struct Revolute : LinearCoordinates<S, 1> {
  Axis<S> axis;
  explicit Revolute(const Axis<S>& unit_axis) : axis(unit_axis) {}
  explicit Revolute(const Vector3<S>& direction) : axis(direction) {}

  std::string shortname() const { return axis.shortname("JointModelR", "JointModelRevoluteUnaligned"); }
  template <Scalar T>
  Revolute<T> cast() const {
    return Revolute<T>(axis.template cast<T>());
  }
};

}  // namespace liecheck
