#pragma once
// A translation joint: a displacement by q [3, m], v [m/s], in the axes of the parent, which are also the
// child's. nq = nv = 3.

#include <liecheck/multibody/joints/linear_coordinates.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck {

template <Scalar S>
struct Translation : LinearCoordinates<S, 3> {
  static SE3<S> transform(const SE3<S>& X_PJ, const Vector3<S>& q) {
    return SE3<S>(X_PJ.rotation(), X_PJ.act(q));
  }
  /// [I; 0].
  static Eigen::Matrix<S, 6, 3> subspace() { return Eigen::Matrix<S, 6, 3>::Identity(); }

  std::string shortname() const { return "JointModelTranslation"; }
};

}  // namespace liecheck
