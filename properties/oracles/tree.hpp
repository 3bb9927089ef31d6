#pragma once
// Kinematics and inverse dynamics of a tree of rigid bodies, derived from its poses alone.
//
// No spatial algebra is used: a pose is a homogeneous matrix X, X_i = X_p L_i, L_i = P_i E_i(q), E' = E V for the
// velocity V = sum_k [s_k] v_k of the joint (s_k constant, [s] = [[w]x u; 0 0]). The product rule gives X', X'' and,
// for a displacement q exp([d]), their derivatives. With U_k = dX/dq_k and a body's second moments of mass
// J = sum m (x; 1)(x; 1)^T, the kinetic energy is T = sum tr(X' J X'^T) / 2, and Lagrange's equations are
//
//   tau_k = sum_i tr(U_ik J_i (X_i'' - g)^T),   M_kl = sum_i tr(U_ik J_i U_il^T)
//
// Sources: Uicker 1965; Paul 1981, chapter 6.
//
// Confirmed at 100 digits, to 1e-30: X', X'' and U by central differences of the poses along q exp(t v + t^2 a / 2) and
// q exp(t e_k), and the derivative of tau by central differences of tau.
//
// Domain: stored quaternions, axes and (cos, sin) are not zero; each stands for its normalised value.

#include <oracles/homogeneous.hpp>
#include <oracles/spatial.hpp>
#include <vector>

namespace liecheck::oracles {

enum class JointKind { revolute, continuous, prismatic, helical, spherical, planar, translation, free_flyer };

/// How many numbers of q, and of v, a joint has that is no mimic; a mimic has none.
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
  int parent = -1;   ///< an earlier joint, -1: the world
  int primary = -1;  ///< of a mimic: its coordinate is multiplier y + offset, y the coordinate of this joint
  Quaternion<T> Q;   ///< with p: the pose in the parent's frame at q = neutral
  Vec3<T> p, axis;
  T pitch, multiplier, offset, armature;
  BodyOf<T> body;  ///< in the joint's frame
};

template <class T>
struct TreeOf {
  std::vector<JointOf<T>> joints;
  Vec3<T> gravity;
  int nq = 0, nv = 0;
  std::vector<int> idx_q, idx_v;  ///< a mimic has those of its primary
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

/// A wrench on a joint's body, in the joint's axes at its origin.
template <class T>
struct WrenchOf {
  int joint = -1;
  Vec6<T> F;
};

/// X, X' and X'' of each joint.
template <class T>
struct MotionOf {
  std::vector<Mat34<T>> X, X1, X2;
};

/// The twist that one velocity of a joint gives to all bodies behind it, at the world's origin in the world's axes.
template <class T>
struct ColumnOf {
  int joint = 0, v = 0;
  Vec3<T> u, w;
};

template <class T>
class TreeDynamics {
 public:
  using Numbers = std::vector<T>;
  /// q [nq], v, a [nv]. A direction (dq, dv, da) [nv each] adds the derivatives along it. With `displaced` [nv] all is
  /// evaluated at q exp(displaced).
  TreeDynamics(const TreeOf<T>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
               const Numbers& dq = {}, const Numbers& dv = {}, const Numbers& da = {},
               const Numbers& displaced = {});

  const MotionOf<T>& motion() const { return at_; }
  const std::vector<ColumnOf<T>>& columns() const { return columns_; }
  const Mat<4, 4, T>& moments(std::size_t joint) const { return J_[joint]; }

  /// tau = M a + h - (generalised forces of the external wrenches) [nv], armature included.
  Numbers torque(const std::vector<WrenchOf<T>>& fext = {}) const;
  /// The derivative of torque() along the direction.
  Numbers torque_derivative(const std::vector<WrenchOf<T>>& fext = {}) const;
  /// M [nv x nv], row by row.
  Numbers mass() const;
  T kinetic_energy() const;  ///< of the bodies, without the armatures
  T potential_energy() const;
  T energy_rate() const;  ///< time derivative of kinetic + potential energy
  Vec3<T> centre() const;
  Vec6<T> momentum() const;       ///< about the centre of mass
  Vec6<T> momentum_rate() const;  ///< its time derivative

 private:
  const TreeOf<T>& tree_;
  const Numbers &v_, &a_, &da_;
  MotionOf<T> at_, change_;
  std::vector<ColumnOf<T>> columns_, columns_change_;
  std::vector<Mat<4, 4, T>> J_;
  bool differentiated_;

  /// Is `ancestor` the joint or one of its ancestors?
  bool carries(int ancestor, std::size_t joint) const;
};

/// The motion of a frame that is fixed to a joint at the pose (Q, position), in the world's axes.
template <class T>
struct FrameMotion {
  Mat3<T> R;
  Vec3<T> p, p1, p2;  ///< position, velocity, acceleration
  Vec3<T> w, w1;      ///< angular velocity, angular acceleration
  FrameMotion(const MotionOf<T>& m, std::size_t joint, const Quaternion<T>& Q, const Vec3<T>& position);
};

/// Do differences of poses confirm X', X'' and U of this state, and differences of tau its derivative along dq, if
/// given?
bool confirmed(const TreeOf<Real>& tree, const std::vector<Real>& q, const std::vector<Real>& v,
               const std::vector<Real>& a, const std::vector<Real>& dq = {});

/// The factors of A = L D L^T [n x n], row by row, with 1 / D on the diagonal. Empty where A is not positive definite.
template <class T>
std::vector<T> positive_factor(std::vector<T> A, std::size_t n);
/// A^-1 b for the factors of A.
template <class T>
std::vector<T> solve(const std::vector<T>& factor, std::vector<T> b);

}  // namespace liecheck::oracles
