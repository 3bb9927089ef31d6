#pragma once
// A slide along an axis by q [m], v [m/s]. nq = nv = 1.

#include <liecheck/multibody/joints/axis.hpp>
#include <liecheck/multibody/joints/linear_coordinates.hpp>

namespace liecheck {

template <Scalar S>
struct Prismatic : LinearCoordinates<S, 1> {
  Axis<S> axis;
  explicit Prismatic(const Axis<S>& unit_axis) : axis(unit_axis) {}
  explicit Prismatic(const Vector3<S>& direction) : axis(direction) {}

  std::string shortname() const { return axis.shortname("JointModelP", "JointModelPrismaticUnaligned"); }
  template <Scalar T>
  Prismatic<T> cast() const {
    return Prismatic<T>(axis.template cast<T>());
  }
};

}  // namespace liecheck
