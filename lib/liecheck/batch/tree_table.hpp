#pragma once
// A tree and a batch of its states, as plain numbers for the kernels of all sets of instructions.

#include <liecheck/spatial/inertia.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck::batch::detail {

/// The joints for which there are kernels.
enum class JointKind { revolute, continuous, prismatic, free_flyer };

template <class S>
struct TreeJoint {
  JointKind kind = JointKind::revolute;
  int parent = 0, q = 0, v = 0, columns = 0;  ///< q, v: the first row
  SE3<S> X_PJ;
  Inertia<S> inertia;
  Vector3<S> axis;  ///< a unit vector
  S armature[6];
};

/// `columns` states, a multiple of the size of a pack. Row r of argument a is in[a][r * stride], and so on.
template <class S>
struct TreeTask {
  const TreeJoint<S>* joints;  ///< [njoints]; the first is the universe
  int njoints;
  Vector3<S> gravity;
  const S* in[4];  ///< q; v; a or tau; external forces, or null
  S* out;
  Eigen::Index stride, columns;
  void* work;  ///< njoints times the kernels' joint_bytes, aligned to 64 bytes
  void (*alone)(const TreeTask& task, Eigen::Index column);  ///< does not throw
  void* context;                                             ///< for alone
};

}  // namespace liecheck::batch::detail
