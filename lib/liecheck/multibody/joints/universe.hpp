#pragma once
// The universe is joint 0. It is fixed to the world and has no numbers in q.

#include <liecheck/multibody/joints/linear_coordinates.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck {

template <Scalar S>
struct Universe : LinearCoordinates<S, 0> {
  static SE3<S> transform(const SE3<S>& X_PJ, const Eigen::Matrix<S, 0, 1>&) { return X_PJ; }
  static Eigen::Matrix<S, 6, 0> subspace() { return {}; }
  std::string shortname() const { return "universe"; }
};

}  // namespace liecheck
