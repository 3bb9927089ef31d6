#pragma once
// The subject correct:lagrange: Lagrange's equations of a tree of bodies with dense Jacobians. Column k of
// J_i is the motion of body i, in its own axes, for a unit velocity of coordinate k:
//
//   M = sum_i J_i^T M_i J_i + A
//   tau = sum_i J_i^T (M_i (J_i a + J_i' v - g_i) + V_i x* M_i V_i) + A a - external forces
//
// The forward dynamics is a solution of M a = tau - h with M = L D L^T, and derivatives follow from dual
// numbers. No recursion of Featherstone is used. Sources: Paul 1981, chapter 6; Featherstone 2008, chapter 2.

#include <correct/correct_tree_parts.hpp>

namespace liecheck::properties::correct {

template <class S>
class DenseTree : TreeParts<S> {
 public:
  static constexpr const char *name = "correct:lagrange", *version = "dense Jacobians in body axes";
  using B = TreeParts<S>;
  using typename B::D, typename B::M, typename B::M3, typename B::M6, typename B::V3, typename B::V6,
      typename B::X;

  explicit DenseTree(const Tree<S>& tree) : B(tree) {
    for (const auto& j : tree.joints) bodies_.push_back(body(j.body, M3::Identity(), V3::Zero()));
    for (const auto& b : tree.fixed) {
      const Rigid extra = body(b.body, rotation(b.Q), vector(b.p));
      Rigid& own = bodies_[static_cast<std::size_t>(b.joint)];
      own.mass += extra.mass, own.moment += extra.moment, own.M += extra.M;
    }
  }

  X rnea(const X& q, const X& v, const X& a, int joint, const V6& F) const {
    return torque<S>(at<S>(q, v), v, a, joint, F);
  }
  M mass(const X& q) const {
    const State<S> s = at<S>(q, X::Zero(tree_.nv));
    M A = M::Zero(tree_.nv, tree_.nv);
    for (std::size_t i = 0; i < s.J.size(); ++i) A += s.J[i].transpose() * bodies_[i].M * s.J[i];
    A.diagonal() += armature_;
    A.template triangularView<Eigen::StrictlyUpper>() = A.transpose().eval();
    return A;
  }
  std::pair<M, M> rnea_derivatives(const X& q, const X& v, const X& a, int joint, const V6& F) const {
    return B::derivatives(v, [&](const VecX<D>& moving, const X& moved) {
      return torque<D>(at<D>(q, moving, moved), moving, a, joint, F);
    });
  }

  S kinetic_energy(const X& q, const X& v) const {
    const State<S> s = at<S>(q, v);
    S sum = armature_.dot(v.cwiseAbs2()) / 2;
    for (std::size_t i = 0; i < s.V.size(); ++i) sum += s.V[i].dot(bodies_[i].M * s.V[i]) / 2;
    return sum;
  }
  S potential_energy(const X& q) const {
    const State<S> s = at<S>(q, X::Zero(tree_.nv));
    S sum(0);
    for (std::size_t i = 0; i < s.V.size(); ++i)
      sum -= gravity_.dot(bodies_[i].mass * s.world[i].p + s.world[i].R * bodies_[i].moment);
    return sum;
  }
  /// A_g: the momenta of all bodies, at the common centre of mass.
  M momentum_map(const X& q) const {
    const State<S> s = at<S>(q, X::Zero(tree_.nv));
    V3 centre = V3::Zero();
    S mass(0);
    for (std::size_t i = 0; i < s.J.size(); ++i) {
      centre += bodies_[i].mass * s.world[i].p + s.world[i].R * bodies_[i].moment;
      mass += bodies_[i].mass;
    }
    centre /= mass;
    M A = M::Zero(6, tree_.nv);
    for (std::size_t i = 0; i < s.J.size(); ++i) {
      const M3& R = s.world[i].R;
      A += four<S>(R, M3::Zero(), hat<S>(s.world[i].p - centre) * R, R) * (bodies_[i].M * s.J[i]);
    }
    return A;
  }

  S total_mass() const {
    S sum(0);
    for (const Rigid& b : bodies_) sum += b.mass;
    return sum;
  }
  V3 center_of_mass(const X& q) const { return centre_of(at<S>(q, X::Zero(tree_.nv))); }
  /// C = sum_i J_i^T (M_i J_i' + K_i J_i), where K_i x = x x* M_i V_i is skew, so that M' = C + C^T.
  M coriolis(const X& q, const X& v) const;
  std::pair<M, M> momentum_derivatives(const X& q, const X& v, const X& a, bool of_rate) const;
  std::pair<M, M> frame_derivatives(const X& q, const X& v, const X& a, Seen seen, bool acceleration) const;

  Pose<S> frame(const X& q) const { return frame_of(at<S>(q, X::Zero(tree_.nv))); }
  M frame_jacobian(const X& q, Seen seen) const {
    const State<S> s = at<S>(q, X::Zero(tree_.nv));
    return seen_from(frame_of(s), seen) * (to_frame() * s.J[joint()]);
  }
  M frame_jacobian_rate(const X& q, const X& v, Seen seen) const {
    const State<S> s = at<S>(q, v);
    const Columns<S> J = to_frame() * s.J[joint()];
    Columns<S> rate = to_frame() * s.Jd[joint()];
    const V6 V = to_frame() * s.V[joint()];
    if (seen == Seen::world) rate += ad(V) * J;
    if (seen == Seen::aligned) rate += ad<S>(joined<S>(V3::Zero(), V.template tail<3>())) * J;
    return seen_from(frame_of(s), seen) * rate;
  }
  V6 frame_velocity(const X& q, const X& v, Seen seen) const {
    const State<S> s = at<S>(q, v);
    return seen_from(frame_of(s), seen) * (to_frame() * s.V[joint()]);
  }
  V6 frame_acceleration(const X& q, const X& v, const X& a, Seen seen, bool classical) const {
    const State<S> s = at<S>(q, v);
    const V6 A = seen_from(frame_of(s), seen) * (to_frame() * (s.J[joint()] * a + s.Jd[joint()] * v));
    if (!classical) return A;
    const V6 V = seen_from(frame_of(s), seen) * (to_frame() * s.V[joint()]);
    const V3 u = V.template head<3>(), w = V.template tail<3>();
    return A + joined<S>(w.cross(u), V3::Zero());
  }

 private:
  struct Rigid {
    S mass;
    V3 moment;  ///< mass times centre of mass
    M6 M;       ///< at the joint's origin
  };
  template <class T>
  struct State {
    std::vector<Columns<T>> J, Jd;
    std::vector<Vec<T, 6>> V;
    std::vector<Vec<T, 3>> up;  ///< -g in the body's axes
    std::vector<Pose<T>> world;
  };

  static Rigid body(const oracles::BodyOf<S>& b, const M3& R, const V3& p) {
    const M3 I = B::inertia(b);
    const V3 c = R * vector(b.c) + p;
    const M3 C = b.mass * hat(c);
    return {b.mass, b.mass * c, four<S>(b.mass * M3::Identity(), -C, C, R * I * R.transpose() - C * hat(c))};
  }
  /// The tree at q, displaced along the coordinates `moved` if T is a dual number.
  template <class T>
  State<T> at(const X& q, const VecX<T>& v, const X& moved = {}) const {
    State<T> s;
    for (std::size_t i = 0; i < tree_.joints.size(); ++i) {
      const auto [R, p] = this->template displaced<T>(i, q, moved);
      const int first = tree_.idx_v[i], n = static_cast<int>(columns_[i].cols());
      const int parent = tree_.joints[i].parent;
      const auto at_parent = static_cast<std::size_t>(parent < 0 ? 0 : parent);
      const Mat<T, 6> X_child = to_child(R, p);
      const Columns<T> own = columns_[i].template cast<T>();
      const Vec<T, 6> V_joint = own * v.segment(first, n);
      Columns<T> J = Columns<T>::Zero(6, tree_.nv), Jd = J;
      if (parent >= 0) J = X_child * s.J[at_parent], Jd = X_child * s.Jd[at_parent] - ad(V_joint) * J;
      J.middleCols(first, n) += own;
      s.V.push_back(J * v);
      s.J.push_back(J), s.Jd.push_back(Jd);
      const Vec<T, 3> up = (-gravity_).template cast<T>();
      s.up.push_back(R.transpose() * (parent < 0 ? up : s.up[at_parent]));
      s.world.push_back(
          parent < 0 ? Pose<T>{R, p}
                     : Pose<T>{s.world[at_parent].R * R, s.world[at_parent].R * p + s.world[at_parent].p});
    }
    return s;
  }
  template <class T>
  VecX<T> torque(const State<T>& s, const VecX<T>& v, const X& a, int joint, const V6& F) const {
    const VecX<T> a_T = a.template cast<T>();
    VecX<T> tau = (armature_.cwiseProduct(a)).template cast<T>();
    for (std::size_t i = 0; i < s.J.size(); ++i) {
      const Mat<T, 6> I = bodies_[i].M.template cast<T>();
      const Vec<T, 6> lifted = joined<T>(s.up[i], Vec<T, 3>::Zero());
      const Vec<T, 6> A = s.J[i] * a_T + s.Jd[i] * v + lifted, h = I * s.V[i];
      Vec<T, 6> f = I * A - ad(s.V[i]).transpose() * h;
      if (static_cast<int>(i) == joint) f -= F.template cast<T>();
      tau += s.J[i].transpose() * f;
    }
    return tau;
  }
  M6 to_frame() const { return to_child<S>(rotation(tree_.frame_Q), vector(tree_.frame_p)); }
  template <class T>
  Pose<T> frame_of(const State<T>& s) const {
    const Pose<T>& X = s.world[joint()];
    return {X.R * rotation(tree_.frame_Q).template cast<T>(),
            X.R * vector(tree_.frame_p).template cast<T>() + X.p};
  }
  template <class T>
  static Mat<T, 6> seen_from(const Pose<T>& X, Seen seen) {
    if (seen == Seen::local) return Mat<T, 6>::Identity();
    return to_parent<T>(X.R, seen == Seen::world ? X.p : Vec<T, 3>(Vec<T, 3>::Zero()));
  }
  template <class T>
  Vec<T, 3> centre_of(const State<T>& s) const {
    Vec<T, 3> sum = Vec<T, 3>::Zero();
    for (std::size_t i = 0; i < s.J.size(); ++i)
      sum += T(bodies_[i].mass) * s.world[i].p + s.world[i].R * bodies_[i].moment.template cast<T>();
    return T(1 / total_mass()) * sum;
  }
  /// The momenta of all bodies, or their rates, at the common centre of mass in world axes.
  template <class T>
  Vec<T, 6> momentum(const State<T>& s, const VecX<T>& v, const X& a, bool of_rate) const {
    const Vec<T, 3> centre = centre_of(s);
    Vec<T, 6> sum = Vec<T, 6>::Zero();
    for (std::size_t i = 0; i < s.J.size(); ++i) {
      const Mat<T, 6> I = bodies_[i].M.template cast<T>();
      Vec<T, 6> h = I * s.V[i];
      if (of_rate) {
        const Vec<T, 6> A = s.J[i] * a.template cast<T>() + s.Jd[i] * v;
        h = (I * A - ad(s.V[i]).transpose() * h).eval();
      }
      const auto& [R, p] = s.world[i];
      const Vec<T, 3> f = R * h.template head<3>(), lever = p - centre;
      sum += joined<T>(f, R * h.template tail<3>() + lever.cross(f));
    }
    return sum;
  }

  using B::armature_, B::columns_, B::gravity_, B::joint, B::rotation, B::tree_, B::vector;
  std::vector<Rigid> bodies_;
};

template <class S>
auto DenseTree<S>::coriolis(const X& q, const X& v) const -> M {
  const State<S> s = at<S>(q, v);
  M C = M::Zero(tree_.nv, tree_.nv);
  for (std::size_t i = 0; i < s.J.size(); ++i) {
    const V6 h = bodies_[i].M * s.V[i];
    const M3 f = hat<S>(h.template head<3>()), n = hat<S>(h.template tail<3>());
    C += s.J[i].transpose() * (bodies_[i].M * s.Jd[i] + four<S>(M3::Zero(), -f, -f, -n) * s.J[i]);
  }
  return C;
}
template <class S>
auto DenseTree<S>::momentum_derivatives(const X& q, const X& v, const X& a, bool of_rate) const
    -> std::pair<M, M> {
  return B::derivatives(v, [&](const VecX<D>& moving, const X& moved) {
    return VecX<D>(momentum<D>(at<D>(q, moving, moved), moving, a, of_rate));
  });
}
template <class S>
auto DenseTree<S>::frame_derivatives(const X& q, const X& v, const X& a, Seen seen, bool acceleration) const
    -> std::pair<M, M> {
  return B::derivatives(v, [&](const VecX<D>& moving, const X& moved) {
    const State<D> s = at<D>(q, moving, moved);
    const Vec<D, 6> motion =
        acceleration ? Vec<D, 6>(s.J[joint()] * a.template cast<D>() + s.Jd[joint()] * moving) : s.V[joint()];
    return VecX<D>(seen_from(frame_of(s), seen) * (to_frame().template cast<D>() * motion));
  });
}

}  // namespace liecheck::properties::correct
