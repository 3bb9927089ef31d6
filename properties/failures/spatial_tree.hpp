#pragma once
// Featherstone's recursions on a random tree in double, right or with one wrong step, to name the causes of wrong results.
// Motions are (u, omega) and forces (f, n), in the axes of a joint at its origin. Source: Featherstone 2008, chapters 5 to 7.

#include <Eigen/Dense>
#include <invariants/tree_law.hpp>
#include <optional>

namespace liecheck::properties::spatial {

using Vector3 = Eigen::Vector3d;
using Vector6 = Vec<double, 6>;
using Matrix3 = Mat<double, 3>;
using Matrix6 = Mat<double, 6>;
using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using Vector = VecX<double>;
using Matrix = MatX<double>;

enum class Step {
  right,  ///< none is wrong
  // inverse dynamics
  no_gyroscopic,
  opposite_gyroscopic,
  gyroscopic_of_motions,
  no_gyroscopic_force,
  no_gyroscopic_moment,
  no_gyroscopic_arm,
  spin_gyroscopic,
  no_coriolis,
  opposite_coriolis,
  no_linear_coriolis,
  no_angular_coriolis,
  own_velocities,
  own_accelerations,
  turned_velocities,
  turned_accelerations,
  turned_motions,
  turned_forces,
  opposite_arms,
  own_forces,
  one_child,
  own_wrench,
  diagonal_gyroscopic,
  gravity_of_first,
  about_world,
  one_torque,
  gyroscopic_of_own,
  // the mass matrix
  turned_inertias,
  own_inertias,
  inertia_of_one_child,
  turned_columns,
  stale_columns,
  columns_of_parents,
  only_blocks,
  only_parents,
  first_armature,
  once_of_mimic,
  armature_of_joint,
  // forward dynamics
  no_bias_of_c,
  no_bias_of_u,
  not_reduced,
  no_last_c,
  no_last_a,
  diagonal_D,
  turned_articulated,
  turned_bias,
  // derivatives: what is held where it was
  held_V_of_momentum,
  held_momentum,
  held_V_of_coriolis,
  held_joint_velocity,
  held_velocities,
  held_motions,
  held_forces
};

struct Link {
  oracles::JointKind kind;
  int parent, v, size;  ///< its velocities are v to v + size - 1
  Columns S;
  Matrix6 I;
  Matrix3 R;  ///< R and p are its pose in the world
  Vector3 p;
  double mass;
  Vector3 com;
  Matrix3 I_C;
  Vector6 wrench;   ///< on its body
  double armature;  ///< 0 of a mimic
};

/// A wrong step, of all joints or of one kind.
struct Wrong {
  Wrong(Step wrong, std::optional<oracles::JointKind> of_kind = {}) : step(wrong), kind(of_kind) {}
  Step of(const Link& l) const { return !kind || *kind == l.kind ? step : Step::right; }
  Step step;
  std::optional<oracles::JointKind> kind;
};

/// A configuration, as the matrices of motions from the parent's axes to the joint's, with v and a.
struct State {
  std::vector<Matrix6> X;
  Vector v, a;
};

struct Tree {
  /// From the numbers of generators/tree_layout.hpp.
  explicit Tree(const std::vector<double>& numbers);
  int nv() const { return static_cast<int>(at.v.size()); }
  Vector zero() const { return Vector::Zero(nv()); }

  std::vector<Link> links;
  Vector3 gravity;
  State at;
  Vector d;  ///< the direction of a derivative
  int frame_joint;
  Matrix3 frame_R;  ///< frame_R and frame_p are the frame's pose in its joint
  Vector3 frame_p;
  bool has_mimics = false;
};

Matrix3 hat(const Vector3& a);  ///< a x
/// The matrix of motions from B to A, where (R, p) is the pose of B in A.
Matrix6 motion_matrix(const Matrix3& R, const Vector3& p);
/// The inverse of a symmetric matrix.
Matrix inverse_of(const Matrix& M);
/// exp(-V x) to the second order: how a matrix of motions to a joint changes where the joint moves by a small V.
Matrix6 moved_by(const Vector6& V);

struct Motions {
  std::vector<Vector6> V, A;
};
/// V and A of all joints; A is -g in the world. A derivative holds some of the numbers as they are in the state `before`.
Motions motions(const Tree& t, const State& at, const Vector3& gravity, const Wrong& wrong,
                const State* before = nullptr, const Motions* held = nullptr);
/// tau = M a + h, and - J^T F if pushed, by Newton and Euler's recursion.
Vector torque(const Tree& t, const State& at, const Vector3& gravity, bool pushed, const Wrong& wrong,
              const State* before = nullptr);
/// M by composite bodies.
Matrix mass_matrix(const Tree& t, const Wrong& wrong);
/// M^-1 (tau - h), and + M^-1 J^T F if pushed, by articulated bodies, of a tree without mimics.
Vector acceleration(const Tree& t, const State& at, const Vector& tau, const Vector3& gravity, bool pushed,
                    const Wrong& wrong);

/// What sums over the bodies need, in the world's axes.
struct MovingBody {
  const Link& link;
  Vector3 x, x1, omega, spin,
      origin1;  ///< of the centre of mass; the spin is I_C omega; x' of the joint's origin
};
std::vector<MovingBody> bodies_of(const Tree& t);
/// The centre of mass, or the mean of the bodies' centres.
Vector3 centre_of(const std::vector<MovingBody>& bodies, bool weighted);

}  // namespace liecheck::properties::spatial
