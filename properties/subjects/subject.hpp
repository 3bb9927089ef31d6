#pragma once
// A subject: a library under test in one scalar, as the table of operations that it offers.
//
// Adding one touches one file: fill an Operations<S>, leave null what the library lacks (it is reported as not
// offered), and register it with a static Registered<S>. Arguments and results are plain fixed-size vectors in
// the conventions of the README's notation table (twist and wrench linear part first, quaternion x y z w, pose
// acts on points); adapters do the reordering.

#include <Eigen/Core>
#include <boost/multiprecision/float128.hpp>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

using float128 = boost::multiprecision::float128;

template <class S, int N>
using Vec = Eigen::Matrix<S, N, 1>;
template <class S, int R, int C = R>
using Mat = Eigen::Matrix<S, R, C>;
template <class S>
using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using MatX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// R_AB, p_AB_A: a pose by its rotation matrix.
template <class S>
struct Pose {
  Mat<S, 3> R;
  Vec<S, 3> p;
};

/// A rigid body's mass, centre of mass and inertia about the centre of mass.
template <class S>
struct Body {
  S mass;
  Vec<S, 3> c;
  Mat<S, 3> I_C;
};

/// The configuration operations of one robot's whole vector, bound to a model in the subject's scalar.
template <class S>
struct RobotOperations {
  std::function<VecX<S>(const VecX<S>& q, const VecX<S>& delta)> integrate;
  std::function<VecX<S>(const VecX<S>& q0, const VecX<S>& q1)> difference;
  std::function<MatX<S>(const VecX<S>& q, const VecX<S>& delta, int argument)> d_integrate;
  std::function<bool(const VecX<S>& q0, const VecX<S>& q1)> is_same;
};

template <class S>
struct Tree;  // tree.hpp
template <class S>
struct TreeOperations;

/// A null entry is an operation that the subject does not offer.
template <class S>
struct Operations {
  using V3 = Vec<S, 3>;
  using V4 = Vec<S, 4>;
  using V6 = Vec<S, 6>;
  using V7 = Vec<S, 7>;
  using M3 = Mat<S, 3>;
  using M6 = Mat<S, 6>;

  // SO(3) and SE(3)
  V4 (*exp3_quaternion)(const V3& phi) = nullptr;
  M3 (*exp3_matrix)(const V3& phi) = nullptr;
  V3 (*log3_quaternion)(const V4& Q) = nullptr;
  V3 (*log3_matrix)(const M3& R) = nullptr;
  Pose<S> (*exp6)(const V6& xi) = nullptr;
  V6 (*log6)(const Pose<S>& T) = nullptr;

  // Jacobians of exp
  M3 (*left_jacobian3)(const V3& phi) = nullptr;
  M3 (*right_jacobian3)(const V3& phi) = nullptr;
  M3 (*left_jacobian3_inverse)(const V3& phi) = nullptr;
  M3 (*right_jacobian3_inverse)(const V3& phi) = nullptr;
  M6 (*left_jacobian6)(const V6& xi) = nullptr;
  M6 (*right_jacobian6)(const V6& xi) = nullptr;
  M6 (*left_jacobian6_inverse)(const V6& xi) = nullptr;
  M6 (*right_jacobian6_inverse)(const V6& xi) = nullptr;

  // configurations of a free-flyer, q = [p; x y z w], delta = (rho, phi)
  V7 (*integrate)(const V7& q, const V6& delta) = nullptr;
  V6 (*difference)(const V7& q0, const V7& q1) = nullptr;
  M6 (*d_integrate_arg0)(const V7& q, const V6& delta) = nullptr;
  M6 (*d_integrate_arg1)(const V7& q, const V6& delta) = nullptr;
  M6 (*d_difference_arg0)(const V7& q0, const V7& q1) = nullptr;
  M6 (*d_difference_arg1)(const V7& q0, const V7& q1) = nullptr;
  Mat<S, 7, 6> (*integrate_coefficient_jacobian)(const V7& q) = nullptr;

  // poses and spatial algebra; a pose is taken as the stored numbers (R, p)
  Pose<S> (*compose)(const Pose<S>& X, const Pose<S>& Y) = nullptr;
  Pose<S> (*inverse)(const Pose<S>& X) = nullptr;  ///< (R^T, -R^T p)
  V3 (*act_point)(const Pose<S>& X, const V3& x) = nullptr;
  V3 (*rotate_point)(const V4& Q, const V3& x) = nullptr;
  V6 (*act_motion)(const Pose<S>& X, const V6& V) = nullptr;
  V6 (*act_inverse_motion)(const Pose<S>& X, const V6& V) = nullptr;
  V6 (*act_force)(const Pose<S>& X, const V6& F) = nullptr;
  V6 (*act_inverse_force)(const Pose<S>& X, const V6& F) = nullptr;
  V6 (*cross_motion)(const V6& V, const V6& W) = nullptr;
  V6 (*cross_force)(const V6& V, const V6& F) = nullptr;
  Body<S> (*act_inertia)(const Pose<S>& X, const Body<S>& I) = nullptr;
  Body<S> (*act_inverse_inertia)(const Pose<S>& X, const Body<S>& I) = nullptr;
  V6 (*momentum)(const Body<S>& I, const V6& V) = nullptr;
  S (*kinetic_energy)(const Body<S>& I, const V6& V) = nullptr;
  M6 (*inertia_matrix)(const Body<S>& I) = nullptr;

  // The checked entrance, where the library has one: throws for numbers that its operations do not take.
  void (*check_quaternion)(const V4& Q) = nullptr;
  void (*check_rotation)(const M3& R) = nullptr;

  /// Reads a URDF with a free-flyer root and binds the configuration operations to it.
  RobotOperations<S> (*robot)(const std::string& urdf_text, bool fixed) = nullptr;

  /// Builds a tree of bodies and binds its algorithms.
  TreeOperations<S> (*tree)(const Tree<S>& tree) = nullptr;
};

template <class S>
struct Subject {
  std::string name;
  std::string version;
  Operations<S> operations;
  /// Angles [rad] at which the subject is known to change formula; others are hunted by the common ones.
  std::vector<double> cutoffs;
};

/// Every subject of the scalar, in registration-independent (alphabetical) order.
template <class S>
std::vector<const Subject<S>*> subjects();

/// A static of this type in a subject's file makes it known.
template <class S>
struct Registered {
  explicit Registered(Subject<S> subject);
};

/// Peers that the build did not find: their files register a name here instead.
const std::vector<std::string>& absent_subjects();
struct RegisteredAbsent {
  explicit RegisteredAbsent(std::string name);
};

}  // namespace liecheck::properties
