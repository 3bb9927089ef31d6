#pragma once
// The subject correct:kane: the equations of Newton and Euler of each body at its centre of mass, in world
// axes, projected on the partial velocities:
//
//   tau = sum_i J_c^T m (c'' - g) + J_w^T (I w' + w x I w) + A a - external forces
//   M = sum_i m J_c^T J_c + J_w^T I J_w + A
//
// u = J_u v is the velocity of a joint's origin o, w = J_w v its angular velocity. Lever arms are summed
// along the tree, so that its distance from the world's origin does not matter. Source: Kane & Levinson 1985.

#include <correct/correct_tree_parts.hpp>

namespace liecheck::properties::correct {

template <class S>
class KaneTree : TreeParts<S> {
 public:
  static constexpr const char *name = "correct:kane", *version = "centres of mass in world axes";
  using B = TreeParts<S>;
  using typename B::M, typename B::M3, typename B::M6, typename B::V3, typename B::V6, typename B::X;

  explicit KaneTree(const Tree<S>& tree) : B(tree), bodies_(B::bodies()) {}

  X rnea(const X& q, const X& v, const X& a, int joint, const V6& F) const {
    return torque(at(q, v), v, a, joint, F);
  }
  M mass(const X& q) const {
    const State s = at(q, X::Zero(tree_.nv));
    M A = M::Zero(tree_.nv, tree_.nv);
    for (const Rigid& b : bodies_) {
      const Link& i = s[b.joint];
      const Rows J_c = i.J_u - hat<S>(i.R * b.c) * i.J_w;
      A += b.mass * J_c.transpose() * J_c + i.J_w.transpose() * (i.R * b.I * i.R.transpose()) * i.J_w;
    }
    A.diagonal() += armature_;
    return (A + A.transpose()) / 2;
  }
  // It has no derivatives: those of forces in world axes lose what a rotation of the whole tree cancels.

  S kinetic_energy(const X& q, const X& v) const {
    const State s = at(q, v);
    S sum = armature_.dot(v.cwiseAbs2()) / 2;
    for (const Rigid& b : bodies_) {
      const Link& i = s[b.joint];
      const V3 w = i.J_w * v, local = i.R.transpose() * w, u = i.J_u * v + w.cross(V3(i.R * b.c));
      sum += (b.mass * u.squaredNorm() + local.dot(b.I * local)) / 2;
    }
    return sum;
  }
  S potential_energy(const X& q) const {
    const State s = at(q, X::Zero(tree_.nv));
    S sum(0);
    for (const Rigid& b : bodies_) sum -= b.mass * gravity_.dot(s[b.joint].o + s[b.joint].R * b.c);
    return sum;
  }
  M momentum_map(const X& q) const {
    const State s = at(q, X::Zero(tree_.nv));
    V3 centre = V3::Zero();
    S mass(0);
    for (const Rigid& b : bodies_) centre += b.mass * (s[b.joint].o + s[b.joint].R * b.c), mass += b.mass;
    centre /= mass;
    M A = M::Zero(6, tree_.nv);
    for (const Rigid& b : bodies_) {
      const Link& i = s[b.joint];
      const V3 c = i.R * b.c;
      const Rows momentum = b.mass * (i.J_u - hat<S>(c) * i.J_w);
      A.template topRows<3>() += momentum;
      A.template bottomRows<3>() += i.R * b.I * i.R.transpose() * i.J_w + hat<S>(i.o - centre + c) * momentum;
    }
    return A;
  }

  S total_mass() const {
    S sum(0);
    for (const Rigid& b : bodies_) sum += b.mass;
    return sum;
  }
  V3 center_of_mass(const X& q) const {
    const State s = at(q, X::Zero(tree_.nv));
    V3 sum = V3::Zero();
    for (const Rigid& b : bodies_) sum += b.mass * (s[b.joint].o + s[b.joint].R * b.c);
    return sum / total_mass();
  }
  /// C = sum_i m J_c^T J_c' + J_w^T (I (J_w' - [w] J_w) - [I w] J_w), so that M' = C + C^T.
  M coriolis(const X& q, const X& v) const {
    const State s = at(q, v);
    M C = M::Zero(tree_.nv, tree_.nv);
    for (const Rigid& b : bodies_) {
      const Link& i = s[b.joint];
      const V3 c = i.R * b.c, w = i.J_w * v;
      const M3 I = i.R * b.I * i.R.transpose();
      const Rows J_c = i.J_u - hat<S>(c) * i.J_w,
                 J_c1 = i.J_u1 - hat<S>(c) * i.J_w1 - hat<S>(V3(w.cross(c))) * i.J_w;
      C += b.mass * J_c.transpose() * J_c1 +
           i.J_w.transpose() * (I * (i.J_w1 - hat<S>(w) * i.J_w) - hat<S>(V3(I * w)) * i.J_w);
    }
    return C;
  }

  Pose<S> frame(const X& q) const { return Frame(*this, q, X::Zero(tree_.nv)).pose; }
  M frame_jacobian(const X& q, Seen seen) const {
    const Frame f(*this, q, X::Zero(tree_.nv));
    return seen == Seen::local     ? f.turned(f.J_u, f.J_w)
           : seen == Seen::aligned ? f.stacked(f.J_u, f.J_w)
                                   : f.stacked(f.J_u + hat<S>(f.pose.p) * f.J_w, f.J_w);
  }
  M frame_jacobian_rate(const X& q, const X& v, Seen seen) const {
    const Frame f(*this, q, v);
    const M3 w = hat<S>(f.J_w * v);
    if (seen == Seen::local) return f.turned(f.J_u1 - w * f.J_u, f.J_w1 - w * f.J_w);
    if (seen == Seen::aligned) return f.stacked(f.J_u1, f.J_w1);
    return f.stacked(f.J_u1 + hat<S>(f.J_u * v) * f.J_w + hat<S>(f.pose.p) * f.J_w1, f.J_w1);
  }
  V6 frame_velocity(const X& q, const X& v, Seen seen) const { return frame_jacobian(q, seen) * v; }
  V6 frame_acceleration(const X& q, const X& v, const X& a, Seen seen, bool classical) const {
    V6 A = frame_jacobian(q, seen) * a + frame_jacobian_rate(q, v, seen) * v;
    const bool is_classical = seen == Seen::aligned;
    const V6 V = frame_velocity(q, v, seen);
    const V3 turning = V3(V.template tail<3>()).cross(V3(V.template head<3>()));
    if (classical != is_classical) A.template head<3>() += is_classical ? V3(-turning) : turning;
    return A;
  }

 private:
  using Rows = Eigen::Matrix<S, 3, Eigen::Dynamic>;
  using Rigid = typename B::Centred;
  struct Link {
    M3 R;
    V3 o;
    Rows J_u, J_w, J_u1, J_w1;  ///< Jacobians and their rates
  };
  using State = std::vector<Link>;

  State at(const X& q, const X& v) const {
    State s;
    for (std::size_t i = 0; i < tree_.joints.size(); ++i) {
      const Pose<S> L = B::local(i, q);
      const int first = tree_.idx_v[i], n = static_cast<int>(columns_[i].cols()), nv = tree_.nv;
      const Rows none = Rows::Zero(3, nv);
      Link p{M3::Identity(), V3::Zero(), none, none, none, none};
      if (const int parent = tree_.joints[i].parent; parent >= 0) p = s[static_cast<std::size_t>(parent)];
      const V3 r = p.R * L.p;
      Link own = p;
      own.R = p.R * L.R, own.o = p.o + r;
      const Rows S_u = own.R * columns_[i].template topRows<3>(),
                 S_w = own.R * columns_[i].template bottomRows<3>();
      const V3 w_p = p.J_w * v, r1 = w_p.cross(r) + V3(S_u * v.segment(first, n));
      own.J_u -= hat<S>(r) * p.J_w;
      own.J_u1 -= hat<S>(r) * p.J_w1 + hat<S>(r1) * p.J_w;
      own.J_u.middleCols(first, n) += S_u;
      own.J_w.middleCols(first, n) += S_w;
      const M3 W = hat<S>(own.J_w * v);
      own.J_u1.middleCols(first, n) += W * S_u;
      own.J_w1.middleCols(first, n) += W * S_w;
      s.push_back(std::move(own));
    }
    return s;
  }
  X torque(const State& s, const X& v, const X& a, int joint, const V6& F) const {
    X tau = armature_.cwiseProduct(a);
    for (const Rigid& b : bodies_) {
      const Link& i = s[b.joint];
      const V3 c = i.R * b.c, w = i.J_w * v, w1 = i.J_w * a + i.J_w1 * v, g = gravity_,
               o2 = i.J_u * a + i.J_u1 * v - g;
      const M3 I = i.R * b.I * i.R.transpose();
      const V3 f = b.mass * (o2 + w1.cross(c) + w.cross(w.cross(c)));
      const V3 h = I * w, n = I * w1 + w.cross(h) + c.cross(f);
      tau += i.J_u.transpose() * f + i.J_w.transpose() * n;
    }
    if (joint >= 0) {
      const Link& i = s[static_cast<std::size_t>(joint)];
      const V3 f = i.R * F.template head<3>(), n = i.R * F.template tail<3>();
      tau -= i.J_u.transpose() * f + i.J_w.transpose() * n;
    }
    return tau;
  }

  /// The frame of the tree, in world axes.
  struct Frame {
    Pose<S> pose;
    Rows J_u, J_w, J_u1, J_w1;
    Frame(const KaneTree& t, const X& q, const X& v) {
      const State s = t.at(q, v);
      const Link& i = s[t.joint()];
      const V3 r = i.R * vector(t.tree_.frame_p);
      pose = {i.R * rotation(t.tree_.frame_Q), i.o + r};
      J_u = i.J_u - hat<S>(r) * i.J_w, J_w = i.J_w, J_w1 = i.J_w1;
      J_u1 = i.J_u1 - hat<S>(r) * i.J_w1 - hat<S>(V3(i.J_w * v).cross(r)) * i.J_w;
    }
    M stacked(const M& u, const M& w) const {
      M J(6, u.cols());
      J << u, w;
      return J;
    }
    M turned(const M& u, const M& w) const { return stacked(pose.R.transpose() * u, pose.R.transpose() * w); }
  };

  using B::armature_, B::columns_, B::gravity_, B::joint, B::rotation, B::tree_, B::vector;
  std::vector<Rigid> bodies_;
};

}  // namespace liecheck::properties::correct
