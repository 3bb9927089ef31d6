#pragma once
// What the correct implementations of trees share: dual numbers, the joints and bodies of a tree, and the
// operations that solve with the mass matrix. What is longer stands in the .cpp, once for all of them.

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <memory>
#include <subjects/tree.hpp>
#include <type_traits>
#include <vector>

namespace liecheck::properties::correct {

/// x + e d with e^2 = 0.
template <class W>
struct Dual {
  W x{}, d{};
  Dual() = default;
  Dual(const W& value, const W& derivative = W(0)) : x(value), d(derivative) {}  // NOLINT: a constant
  Dual(int value) : x(value) {}                                                  // NOLINT
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.x + b.x, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.x - b.x, a.d - b.d}; }
  friend Dual operator-(const Dual& a) { return {-a.x, -a.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.x * b.x, a.d * b.x + a.x * b.d}; }
  friend bool operator==(const Dual&, const Dual&) = default;
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
};

}  // namespace liecheck::properties::correct

template <class W>
struct Eigen::NumTraits<liecheck::properties::correct::Dual<W>> : Eigen::NumTraits<W> {
  using Real = liecheck::properties::correct::Dual<W>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum { RequireInitialization = 1 };
};

namespace liecheck::properties::correct {

template <class T>
using Columns = Eigen::Matrix<T, 6, Eigen::Dynamic>;

template <class T>
Vec<T, 6> joined(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  Vec<T, 6> v;
  v << a, b;
  return v;
}
template <class T>
Mat<T, 6> four(const Mat<T, 3>& a, const Mat<T, 3>& b, const Mat<T, 3>& c, const Mat<T, 3>& d) {
  Mat<T, 6> m;
  m << a, b, c, d;
  return m;
}
/// Maps motions from a parent's axes to those of a child at (R, p).
template <class T>
Mat<T, 6> to_child(const Mat<T, 3>& R, const Vec<T, 3>& p) {
  const Mat<T, 3> Rt = R.transpose();
  return four<T>(Rt, -Rt * hat(p), Mat<T, 3>::Zero(), Rt);
}
template <class T>
Mat<T, 6> to_parent(const Mat<T, 3>& R, const Vec<T, 3>& p) {
  return four<T>(R, hat(p) * R, Mat<T, 3>::Zero(), R);
}
/// V x as a matrix on motions; -V x transposed acts on forces.
template <class T>
Mat<T, 6> ad(const Vec<T, 6>& V) {
  const Mat<T, 3> w = hat<T>(V.template tail<3>());
  return four<T>(w, hat<T>(V.template head<3>()), Mat<T, 3>::Zero(), w);
}

/// The joints of a tree (poses, motion subspaces and armatures) and its bodies.
template <class S>
class TreeParts {
 public:
  using X = VecX<S>;
  using M = MatX<S>;
  using V3 = Vec<S, 3>;
  using V6 = Vec<S, 6>;
  using M3 = Mat<S, 3>;
  using M6 = Mat<S, 6>;
  using D = Dual<S>;

 protected:
  explicit TreeParts(const Tree<S>& tree);

  static V3 vector(const oracles::Vec3<S>& v) { return {v[0], v[1], v[2]}; }
  static M3 rotation(const oracles::Quaternion<S>& Q);
  static M3 inertia(const oracles::BodyOf<S>& b) {
    M3 I;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) I(i, j) = b.I_C(i, j);
    return I;
  }
  /// The constant columns of a joint's motion, in the axes of its body.
  static Columns<S> subspace(const oracles::JointOf<S>& j);
  /// The pose of joint i in its parent's axes.
  Pose<S> local(std::size_t i, const X& q) const;

  /// local(), displaced along the coordinates `moved` if T is a dual number.
  template <class T>
  Pose<T> displaced(std::size_t i, const X& q, const X& moved) const {
    const Pose<S> L = local(i, q);
    Pose<T> X{L.R.template cast<T>(), L.p.template cast<T>()};
    if constexpr (!std::is_same_v<T, S>) {
      if (moved.size() > 0) {
        const V6 d = columns_[i] * moved.segment(tree_.idx_v[i], columns_[i].cols());
        const M3 dR = L.R * hat<S>(d.template tail<3>());
        const V3 dp = L.R * d.template head<3>();
        for (int k = 0; k < 9; ++k) X.R.data()[k].d = dR.data()[k];
        for (int k = 0; k < 3; ++k) X.p[k].d = dp[k];
      }
    }
    return X;
  }
  /// The derivatives of torque(v, moved), or of another vector, where `moved` displaces the coordinates if it is not empty.
  template <class Torque>
  std::pair<M, M> derivatives(const X& v, const Torque& torque) const {
    const auto of = [](const VecX<D>& tau) -> X {
      X d(tau.size());
      for (int k = 0; k < tau.size(); ++k) d[k] = tau[k].d;
      return d;
    };
    M by_q, by_v;
    for (int k = 0; k < tree_.nv; ++k) {
      VecX<D> moving = v.template cast<D>();
      const X change = of(torque(moving, X(X::Unit(tree_.nv, k))));
      if (k == 0) by_q.resize(change.size(), tree_.nv), by_v = by_q;
      by_q.col(k) = change;
      moving[k].d = S(1);
      by_v.col(k) = of(torque(moving, X()));
    }
    return {by_q, by_v};
  }

  struct Centred {
    std::size_t joint;
    S mass;
    V3 c;  ///< from the joint's origin, in its axes
    M3 I;  ///< at the centre of mass
  };
  /// All bodies, each with its inertia at its centre of mass.
  std::vector<Centred> bodies() const;
  std::size_t joint() const { return static_cast<std::size_t>(tree_.frame_joint); }

  Tree<S> tree_;
  V3 gravity_;
  std::vector<Columns<S>> columns_;
  X armature_;
};

/// The factor of a mass matrix. Throws std::domain_error if M is not positive definite after rounding, for which
/// Eigen would solve with infinite numbers.
template <class S>
class Factor {
 public:
  explicit Factor(const MatX<S>& M);
  VecX<S> solve(const VecX<S>& b) const;
  MatX<S> solve(const MatX<S>& b) const;

 private:
  Eigen::LDLT<MatX<S>> ldlt_;
};

/// The operations of a class of trees.
template <class T, class S>
TreeOperations<S> bind(const Tree<S>& tree) {
  using X = VecX<S>;
  using M = MatX<S>;
  using V6 = Vec<S, 6>;
  const auto t = std::make_shared<const T>(tree);
  const auto with = [t](auto f) { return [t, f](const auto&... x) { return ((*t).*f)(x...); }; };
  const auto accelerated = [t](const X& q, const X& v, const X& tau, int joint, const V6& F) -> X {
    return Factor<S>(t->mass(q)).solve(X(tau - t->rnea(q, v, X::Zero(v.size()), joint, F)));
  };
  TreeOperations<S> o;
  o[op::tree_rnea] = with(&T::rnea);
  o[op::tree_aba] = accelerated;
  o[op::tree_nonlinear_effects] = [t](const X& q, const X& v) -> X {
    return t->rnea(q, v, X::Zero(v.size()), -1, V6::Zero());
  };
  o[op::tree_gravity] = [t, n = tree.nv](const X& q) -> X {
    return t->rnea(q, X::Zero(n), X::Zero(n), -1, V6::Zero());
  };
  o[op::tree_crba] = with(&T::mass);
  o[op::tree_mass_inverse] = [t, n = tree.nv](const X& q) -> M {
    return Factor<S>(t->mass(q)).solve(M(M::Identity(n, n)));
  };
  if constexpr (requires { &T::rnea_derivatives; }) {
    o[op::rnea_derivatives] = with(&T::rnea_derivatives);
    o[op::aba_derivatives] = [t, accelerated](const X& q, const X& v, const X& tau, int joint,
                                              const V6& F) -> std::pair<M, M> {
      const auto [by_q, by_v] = t->rnea_derivatives(q, v, accelerated(q, v, tau, joint, F), joint, F);
      const Factor<S> factor(t->mass(q));
      return {M(-factor.solve(by_q)), M(-factor.solve(by_v))};
    };
    o[op::tree_static_torque] = [t, n = tree.nv](const X& q, int joint, const V6& F) -> X {
      return t->rnea(q, X::Zero(n), X::Zero(n), joint, F);
    };
    o[op::static_torque_derivative] = [t, n = tree.nv](const X& q, int joint, const V6& F) -> M {
      return t->rnea_derivatives(q, X::Zero(n), X::Zero(n), joint, F).first;
    };
    o[op::momentum_derivative] = [t](const X& q, const X& v) -> M {
      return t->momentum_derivatives(q, v, v, false).first;
    };
    o[op::momentum_rate_derivatives] = [t](const X& q, const X& v, const X& a) -> std::pair<M, M> {
      return t->momentum_derivatives(q, v, a, true);
    };
    o[op::frame_velocity_derivatives] = [t](const X& q, const X& v, Seen seen) -> std::pair<M, M> {
      return t->frame_derivatives(q, v, v, seen, false);
    };
    o[op::frame_acceleration_derivatives] = [t](const X& q, const X& v, const X& a,
                                                Seen seen) -> std::pair<M, M> {
      return t->frame_derivatives(q, v, a, seen, true);
    };
  }
  if constexpr (requires { &T::momentum_map; }) {
    o[op::tree_kinetic_energy] = with(&T::kinetic_energy);
    o[op::tree_potential_energy] = with(&T::potential_energy);
    o[op::tree_momentum] = [t](const X& q, const X& v) -> V6 { return t->momentum_map(q) * v; };
    o[op::tree_momentum_map] = with(&T::momentum_map);
    o[op::frame_pose] = with(&T::frame);
    o[op::frame_velocity] = with(&T::frame_velocity);
    o[op::frame_acceleration] = [t](const X& q, const X& v, const X& a, Seen seen) -> V6 {
      return t->frame_acceleration(q, v, a, seen, false);
    };
    o[op::frame_classical_acceleration] = [t](const X& q, const X& v, const X& a, Seen seen) -> V6 {
      return t->frame_acceleration(q, v, a, seen, true);
    };
    o[op::frame_jacobian] = with(&T::frame_jacobian);
    o[op::frame_jacobian_rate] = with(&T::frame_jacobian_rate);
    o[op::tree_coriolis] = with(&T::coriolis);
    o[op::tree_center_of_mass] = with(&T::center_of_mass);
    o[op::tree_com_jacobian] = [t](const X& q) -> M {
      return t->momentum_map(q).topRows(3) / t->total_mass();
    };
    o[op::operational_inertia] = [t](const X& q, Seen seen) -> Mat<S, 6> {
      const M J = t->frame_jacobian(q, seen), x = Factor<S>(t->mass(q)).solve(M(J.transpose()));
      return Factor<S>(M(J * x)).solve(M(M::Identity(6, 6)));
    };
  }
  return o;
}

}  // namespace liecheck::properties::correct
