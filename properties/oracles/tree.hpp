#pragma once
// Kinematics and inverse dynamics of a tree of rigid bodies from its poses alone, without spatial algebra.
//
// The pose of joint i is a homogeneous matrix X_i = X_p L_i, with the parent's pose X_p and L_i = P_i E_i(q).
// The joint's velocity is V = sum_k [s_k] v_k with constant s_k and [s] = [[w]x u; 0 0], and E' = E V. The
// product rule gives X', X'' and their derivatives for a displacement q exp([d]). With U_k = dX/dq_k and a
// body's second moments of mass J = sum m (x; 1)(x; 1)^T and the armatures m, the kinetic energy is
// T = sum_i tr(X_i' J_i X_i'^T) / 2 + sum_k m_k v_k^2 / 2. Lagrange's equations are
//
//   tau_k = sum_i tr(U_ik J_i (X_i'' - g)^T) + m_k a_k,   M_kl = sum_i tr(U_ik J_i U_il^T) + m_k [k = l]
//
// Sources: Uicker 1965; Paul 1981, chapter 6.
//
// Second formula, at 100 digits and to 1e-30: central differences of the poses along q exp(t v + t^2 a / 2)
// and q exp(t e_k) confirm X', X'' and U. Central differences of tau confirm the derivative of tau.
//
// Domain: stored quaternions, axes and (cos, sin) are not zero; each stands for its normalised value.

#include <limits>
#include <memory>
#include <oracles/homogeneous.hpp>
#include <oracles/joint_set.hpp>
#include <oracles/spatial.hpp>
#include <vector>

namespace liecheck::oracles {

/// The number of a joint's entries in q, and in v. A mimic has none.
constexpr int configuration_size(JointKind k) {
  return k == JointKind::free_flyer                            ? 7
         : k == JointKind::translation                         ? 3
         : k == JointKind::continuous                          ? 2
         : k == JointKind::spherical || k == JointKind::planar ? 4
                                                               : 1;
}
constexpr int velocity_size(JointKind k) {
  return k == JointKind::free_flyer                                                           ? 6
         : k == JointKind::spherical || k == JointKind::planar || k == JointKind::translation ? 3
                                                                                              : 1;
}

template <class T>
struct JointOf {
  JointKind kind = JointKind::revolute;
  int parent = -1;   ///< an earlier joint, or -1 for the world
  int primary = -1;  ///< -1, or for a mimic the joint whose coordinate y gives multiplier y + offset
  Quaternion<T> Q;   ///< Q and p are the pose in the parent's frame at q = neutral
  Vec3<T> p, axis;
  T pitch, multiplier, offset, armature;
  BodyOf<T> body;  ///< in the joint's frame
};

template <class T>
struct TreeOf {
  std::vector<JointOf<T>> joints;
  Vec3<T> gravity;
  int nq = 0, nv = 0;
  std::vector<int> idx_q, idx_v;  ///< a mimic has the indices of its primary
  /// Sets nq, nv, idx_q and idx_v.
  void index() {
    nq = nv = 0;
    idx_q.clear(), idx_v.clear();
    for (const JointOf<T>& j : joints) {
      const auto primary = static_cast<std::size_t>(j.primary);
      idx_q.push_back(j.primary < 0 ? nq : idx_q[primary]);
      idx_v.push_back(j.primary < 0 ? nv : idx_v[primary]);
      if (j.primary >= 0) continue;
      nq += configuration_size(j.kind), nv += velocity_size(j.kind);
    }
  }
};

/// add(k, armature) for each velocity k of a joint that is not a mimic.
template <class T, class Add>
void for_each_armature(const TreeOf<T>& tree, Add&& add) {
  for (std::size_t i = 0; i < tree.joints.size(); ++i)
    if (const JointOf<T>& j = tree.joints[i]; j.primary < 0)
      for (int k = 0; k < velocity_size(j.kind); ++k)
        add(static_cast<std::size_t>(tree.idx_v[i] + k), j.armature);
}

/// A wrench on a joint's body, in the joint's axes at its origin.
template <class T>
struct WrenchOf {
  int joint = -1;
  Vec6<T> F;
};

/// Column v of the Jacobian of the bodies behind `joint`, in world axes at the world's origin. The columns of
/// a mimic and of its primary have the same v and are added.
template <class T>
struct ColumnOf {
  int joint = 0, v = 0;
  Vec3<T> u, w;
};

/// What a tree's configuration determines.
template <class T>
struct TreePoses {
  using Numbers = std::vector<T>;
  /// q [nq]. With `displaced` [nv] the configuration is q exp(displaced).
  TreePoses(const TreeOf<T>& tree, const Numbers& q, const Numbers& displaced = {});

  /// The columns s_k of joint i's motion subspace, times the multiplier of a mimic, are S[first[i]] to
  /// S[first[i + 1] - 1].
  std::vector<Vec6<T>> S;
  std::vector<std::size_t> first{0};
  /// The origin of all poses in the world. In ball arithmetic it is that of joint 0, because moments about a
  /// distant point cancel. Otherwise it is the world's.
  Vec3<T> origin;
  std::vector<Mat34<T>> L, X;  ///< of each joint in its parent, and in the frame at the origin
  std::vector<ColumnOf<T>> columns;
  std::vector<Mat44<T>> J, XJ;  ///< the bodies' second moments of mass, and X J

  /// sum_k s_k x_k of joint i, whose first velocity is idx_v.
  Vec6<T> twist(std::size_t i, int idx_v, const Numbers& x) const;
};

/// X, X' and X'' of each joint, in the frame of TreePoses.
template <class T>
struct MotionOf {
  Vec3<T> origin;
  std::vector<Mat34<T>> X, X1, X2;
};

template <class T>
struct FrameMotion;

template <class T>
class TreeDynamics {
 public:
  using Numbers = std::vector<T>;
  /// q [nq]; v and a [nv]. With a direction (dq, dv, da) [nv each] the derivatives along it are computed too.
  /// With `displaced` [nv] everything is evaluated at q exp(displaced).
  TreeDynamics(const TreeOf<T>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
               const Numbers& dq = {}, const Numbers& dv = {}, const Numbers& da = {},
               const Numbers& displaced = {})
      : TreeDynamics(tree, std::make_shared<TreePoses<T>>(tree, q, displaced), v, a, dq, dv, da) {}
  /// The same for poses that are known.
  TreeDynamics(const TreeOf<T>& tree, std::shared_ptr<const TreePoses<T>> poses, const Numbers& v,
               const Numbers& a, const Numbers& dq = {}, const Numbers& dv = {}, const Numbers& da = {});

  const MotionOf<T>& motion() const { return at_; }
  const std::vector<ColumnOf<T>>& columns() const { return poses_->columns; }

  /// tau = M a + h - (generalised forces of the external wrenches) [nv], armature included.
  Numbers torque(const std::vector<WrenchOf<T>>& fext = {}) const;
  /// The derivative of torque() along the direction.
  Numbers torque_derivative(const std::vector<WrenchOf<T>>& fext = {}) const;
  /// M [nv x nv], row by row.
  Numbers mass() const;
  T kinetic_energy() const;  ///< of the bodies and of the rotors, whose inertias are the armatures
  T potential_energy() const;
  T energy_rate() const;  ///< time derivative of kinetic + potential energy
  /// The momentum about the centre of mass.
  Vec6<T> momentum() const { return moment_about_centre(at_.X1); }
  /// The time derivative of momentum(). Its angular part is sum m (x - c) cross x'', since x' cross x' = 0
  /// and c' cross sum m x' = 0.
  Vec6<T> momentum_rate() const { return moment_about_centre(at_.X2); }
  /// The derivative of momentum(), or of its rate, along the direction.
  Vec6<T> momentum_change(bool of_rate) const;
  T total_mass() const;
  Vec3<T> centre() const;  ///< of mass, in the world
  /// The derivative of a FrameMotion along the direction.
  FrameMotion<T> frame_change(std::size_t joint, const Quaternion<T>& Q, const Vec3<T>& position) const;

 private:
  const TreeOf<T>& tree_;
  std::shared_ptr<const TreePoses<T>> poses_;
  Numbers v_, a_, da_;  ///< copies, since an argument may be a temporary
  MotionOf<T> at_, change_;  ///< change_.X and columns_change_ are empty if dq is zero
  std::vector<ColumnOf<T>> columns_change_;

  void differentiate(const Numbers& dq, const Numbers& dv, const Numbers& da);
  /// Is `ancestor` the joint itself or one of its ancestors?
  bool carries(int ancestor, std::size_t joint) const;
  Vec6<T> moment_about_centre(const std::vector<Mat34<T>>& y) const;
};

/// The motion of a frame that is fixed to a joint at the pose (Q, position), in the world's axes.
template <class T>
struct FrameMotion {
  Mat3<T> R;
  Vec3<T> p, p1, p2;  ///< position, velocity, acceleration
  Vec3<T> w, w1;      ///< angular velocity, angular acceleration
  FrameMotion(const MotionOf<T>& m, std::size_t joint, const Quaternion<T>& Q, const Vec3<T>& position);
};

/// Do differences of poses confirm X', X'' and U of this state? With dq: do differences of tau also confirm
/// the derivative of tau along dq?
bool confirmed(const TreeOf<Real>& tree, const std::vector<Real>& q, const std::vector<Real>& v,
               const std::vector<Real>& a, const std::vector<Real>& dq = {});

/// L, with 1 / D on its diagonal, of A = L D L^T [n x n], row by row. Empty if A is not positive definite.
template <class T>
std::vector<T> positive_factor(std::vector<T> A, std::size_t n);
/// A^-1 b for the factors of A.
template <class T>
std::vector<T> solve(const std::vector<T>& factor, std::vector<T> b);

/// Solves with a positive definite A [n x n]. In ball arithmetic, the radii of elimination grow by a factor for
/// each row. Smaller ones follow from the residual (Rump 2010, Acta Numerica 19): with the midpoints x,
/// D = diag A and B = D^-1/2 A D^-1/2, the error of x_k is at most D_kk^-1/2 ||B^-1|| ||D^-1/2 (b - A x)||, and
/// ||B^-1|| <= ||X|| / (1 - ||B X - I||) for any X near B^-1.
template <class T>
class Solver {
 public:
  Solver(std::vector<T> A, std::size_t n);
  /// Whether A is positive definite; otherwise there is no solution.
  explicit operator bool() const { return !factor_.empty(); }
  const std::vector<T>& factor() const { return factor_; }
  std::vector<T> operator()(const std::vector<T>& b) const;

 private:
  std::vector<T> A_, factor_;
  std::vector<double> scale_;                                 ///< numbers near D_kk^-1/2; empty for a Real
  double inverse_ = std::numeric_limits<double>::infinity();  ///< a bound of ||B^-1||
};

}  // namespace liecheck::oracles
