#pragma once
// Kinematics and dynamics of one tree in many states at once: forwardKinematics, rnea and aba of the room
// algorithms for a pack of columns, with the same equations, in the same axes. kernels.hpp states the rules.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/batch/pack.hpp>
#include <liecheck/batch/sine.hpp>
#include <liecheck/batch/tree_table.hpp>

namespace liecheck::batch::detail {

/// The quantities of a joint that a pass leaves to the next one.
template <class P>
struct JointWork {
  SE3<P> liMi, oMi;
  Motion<P> velocity, acceleration, bias;
  Force<P> force;
  Vector3<P> r;
  Matrix6<P> articulated, L, S_columns, U;
  Vector6<P> u;
};

/// One pack of columns, from `first` on.
template <class P>
class TreePack {
  using S = Lane<P>;
  using Mask = typename P::Mask;

 public:
  TreePack(const TreeTask<S>& task, const Axis<P>* axes, JointWork<P>* work, Eigen::Index first)
      : task_(task), axes_(axes), work_(work), first_(first), usual_(P::less(P(0), P(1))) {}

  /// Each returns the lanes that need no branch.
  Mask forwardKinematics() {
    for (int i = 1; i < task_.njoints; ++i) {
      place(i);
      const Matrix3<P>& R = work_[i].oMi.rotation();
#pragma GCC unroll 9
      for (int k = 0; k < 9; ++k) store(12 * i + k, R(k / 3, k % 3));
      for (int k = 0; k < 3; ++k) store(12 * i + 9 + k, work_[i].oMi.translation()[k]);
    }
    for (int k = 0; k < 12; ++k) store(k, P(k == 0 || k == 4 || k == 8 ? 1 : 0));
    return usual_;
  }

  Mask rnea() {
    using namespace algorithms_detail;
    work_[0].acceleration = gravitated();
    for (int i = 1; i < task_.njoints; ++i) {
      JointWork<P>&w = work_[i], &parent = work_[task_.joints[i].parent];
      w.liMi = transform(i);
      const Motion<P> relative = motion(i, 1);
      w.velocity = task_.joints[i].parent == 0 ? relative : actInv(w.liMi, parent.velocity) + relative;
      w.acceleration = actInv(w.liMi, parent.acceleration) + crossed(w.velocity, relative) + motion(i, 2);
      const Inertia<P> I = inertia(i);
      w.force = momentum(I, w.acceleration) + crossed(w.velocity, momentum(I, w.velocity));
      if (task_.in[3]) w.force = w.force - external(i);
    }
    work_[0].force = Force<P>::Zero();
    for (int i = task_.njoints - 1; i > 0; --i) {
      const TreeJoint<S>& joint = task_.joints[i];
      const Vector6<P> F = work_[i].force.to_vector();
      for (int k = 0; k < joint.columns; ++k) {
        P tau = P(joint.armature[k]) * in(2, joint.v + k);
        if (joint.kind == JointKind::free_flyer)
          tau += F[k];
        else
          tau += axes_[i].to_vector().dot(F.template segment<3>(joint.kind == JointKind::prismatic ? 0 : 3));
        store(joint.v + k, tau);
      }
      Force<P>& f = work_[joint.parent].force;
      f = f + algorithms_detail::act(work_[i].liMi, work_[i].force);
    }
    return usual_;
  }

  Mask aba() {
    using namespace algorithms_detail;
    for (int i = 1; i < task_.njoints; ++i) moveBody(i);
    for (int i = task_.njoints - 1; i > 0; --i) {
      project(i);
      const int parent = task_.joints[i].parent;
      if (parent != 0) addToParent(work_[i], work_[parent], task_.joints[i].columns);
    }
    work_[0].acceleration = gravitated();
    for (int i = 1; i < task_.njoints; ++i) accelerate(i);
    return usual_;
  }

 private:
  P in(int argument, int row) const {
    return P::load(task_.in[argument] + row * task_.stride + first_);
  }
  void store(int row, const P& x) const {
    x.store(task_.out + row * task_.stride + first_);
  }
  Motion<P> gravitated() const {
    return {each<P>([&](int i) { return P(-task_.gravity[i]); }), Vector3<P>(P(0), P(0), P(0))};
  }
  Inertia<P> inertia(int i) const {
    const Inertia<S>& I = task_.joints[i].inertia;
    Matrix3<P> m;
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = P(I.inertia()(k / 3, k % 3));
    return {P(I.mass()), each<P>([&](int k) { return P(I.lever()[k]); }), m};
  }

  /// The pose of joint i in its parent's frame.
  SE3<P> transform(int i) {
    const TreeJoint<S>& joint = task_.joints[i];
    Matrix3<P> R;
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k) R(k / 3, k % 3) = P(joint.X_PJ.rotation()(k / 3, k % 3));
    const SE3<P> X(R, each<P>([&](int k) { return P(joint.X_PJ.translation()[k]); }));
    const P y = in(0, joint.q);
    if (joint.kind == JointKind::revolute) {
      const SineAndCosine<P> at(y);
      return {axes_[i].rotated(R, at.cosine, at.sine), X.translation()};
    }
    if (joint.kind == JointKind::prismatic)
      return {R, X.act(each<P>([&](int k) { return y * axes_[i].to_vector()[k]; }))};
    if (joint.kind == JointKind::continuous) {
      const Eigen::Matrix<P, 2, 1> u(y, in(0, joint.q + 1));
      const P excess = u[0] * u[0] + u[1] * u[1] - P(1);
      usual_ &= P::less(excess * excess, P(eps<S>() / 4));
      const P scale = (P(3) - (u[0] * u[0] + u[1] * u[1])) / P(2);
      return {axes_[i].rotated(R, u[0] * scale, u[1] * scale), X.translation()};
    }
    const Vector4<P> Q(in(0, joint.q + 3), in(0, joint.q + 4), in(0, joint.q + 5), in(0, joint.q + 6));
    const P excess = (Q[0] * Q[0] + Q[1] * Q[1]) + (Q[2] * Q[2] + Q[3] * Q[3]) - P(1);
    usual_ &= P::less(excess * excess, P(eps<S>() / 4));
    return X * SE3<P>(SO3<P>(Q), Vector3<P>(y, in(0, joint.q + 1), in(0, joint.q + 2)));
  }
  /// S v of joint i, v from an argument.
  Motion<P> motion(int i, int argument) const {
    const TreeJoint<S>& joint = task_.joints[i];
    const Vector3<P> zero(P(0), P(0), P(0));
    if (joint.kind == JointKind::free_flyer)
      return {each<P>([&](int k) { return in(argument, joint.v + k); }),
              each<P>([&](int k) { return in(argument, joint.v + 3 + k); })};
    const P rate = in(argument, joint.v);
    const Vector3<P> along = each<P>([&](int k) { return rate * axes_[i].to_vector()[k]; });
    return joint.kind == JointKind::prismatic ? Motion<P>(along, zero) : Motion<P>(zero, along);
  }
  Force<P> external(int i) const {
    return {each<P>([&](int k) { return in(3, 6 * i + k); }),
            each<P>([&](int k) { return in(3, 6 * i + 3 + k); })};
  }
  /// Sets liMi, oMi, and r in world axes.
  void place(int i) {
    JointWork<P>& w = work_[i];
    const int parent = task_.joints[i].parent;
    w.liMi = transform(i);
    if (parent == 0) {
      w.oMi = w.liMi, w.r = w.liMi.translation();
      return;
    }
    const SE3<P>& X = work_[parent].oMi;
    w.r = product<P>(X.rotation(), w.liMi.translation());
    w.oMi = SE3<P>(product<P>(X.rotation(), w.liMi.rotation()),
                   algorithms_detail::added<P>(X.translation(), w.r));
  }
  /// The first pass of aba, for joint i.
  void moveBody(int i) {
    using namespace algorithms_detail;
    place(i);
    const TreeJoint<S>& joint = task_.joints[i];
    JointWork<P>& w = work_[i];
    const Matrix3<P>& R = w.oMi.rotation();
    const Vector3<P> zero(P(0), P(0), P(0));
    Motion<P> relative = Motion<P>::Zero();
    for (int k = 0; k < joint.columns; ++k) {
      const bool linear =
          joint.kind == JointKind::prismatic || (joint.kind == JointKind::free_flyer && k < 3);
      const Vector3<P> axis = joint.kind == JointKind::free_flyer ? Vector3<P>(R.col(k % 3)) : axes_[i].in(R);
      const Motion<P> s = linear ? Motion<P>(axis, zero) : Motion<P>(zero, axis);
      w.S_columns.col(k) = s.to_vector();
      relative = relative + s * in(1, joint.v + k);
    }
    w.velocity = joint.parent == 0 ? relative : shifted(work_[joint.parent].velocity, w.r) + relative;
    w.bias = crossed(w.velocity, relative);
    const MovingInertia<P> moving(CompositeInertia<P>::rotated(R, inertia(i)), w.velocity);
    w.articulated = moving.matrix();
    w.force = crossed(w.velocity, Force<P>(moving.f, moving.n));
    if (task_.in[3]) w.force = w.force - SE3<P>(R, zero).act(external(i));
  }
  /// projectOnJoint and factorizeJointInertia of aba.hpp.
  void project(int i) {
    const TreeJoint<S>& joint = task_.joints[i];
    JointWork<P>& w = work_[i];
    const int n = joint.columns;
    const Matrix6<P>& I = w.articulated;
    const P t = I(0, 0) + I(1, 1) + I(2, 2), r = I(3, 3) + I(4, 4) + I(5, 5);
    Vector6<P> rounding;
    for (int k = 0; k < n; ++k) {
      const Vector6<P> s = w.S_columns.col(k);
      w.U.col(k).noalias() = I * s;
      for (int j = 0; j <= k; ++j) w.L(k, j) = w.S_columns.col(j).dot(w.U.col(k));
      w.L(k, k) += P(joint.armature[k]);
      w.u[k] = in(2, joint.v + k) - s.dot(w.force.to_vector());
      rounding[k] = P(S(4096) * eps<S>()) * ((s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) * t +
                                             (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]) * r);
    }
    for (int k = 0; k < n; ++k) {
      usual_ &= P::less(rounding[k], w.L(k, k));
      if (n == 1) return void(w.L(0, 0) = P(1) / w.L(0, 0));
      w.L(k, k) = sqrt(w.L(k, k));
      for (int l = k + 1; l < n; ++l) w.L(l, k) /= w.L(k, k);
      for (int l = k + 1; l < n; ++l)
        for (int j = k + 1; j <= l; ++j) w.L(l, j) -= w.L(l, k) * w.L(j, k);
    }
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < k; ++j) w.U.col(k) -= w.L(k, j) * w.U.col(j), w.u[k] -= w.L(k, j) * w.u[j];
      w.U.col(k) /= w.L(k, k), w.u[k] /= w.L(k, k);
    }
  }
  static void addToParent(JointWork<P>& w, JointWork<P>& parent, int n) {
    using namespace algorithms_detail;
    Matrix6<P>& I = w.articulated;
    Vector6<P> f = Vector6<P>::Zero();
    for (int k = 0; k < n; ++k) {
      const Vector6<P> U = w.U.col(k), UD = n == 1 ? Vector6<P>(w.L(0, 0) * U) : U;
      I.noalias() -= UD * U.transpose();
      f += UD * w.u[k];
    }
    parent.force = parent.force + shifted(w.force + Force<P>(Vector6<P>(I * w.bias.to_vector() + f)), w.r);
    addShifted(parent.articulated, I, w.r);
  }
  /// The last pass of aba, for joint i.
  void accelerate(int i) {
    using namespace algorithms_detail;
    const TreeJoint<S>& joint = task_.joints[i];
    JointWork<P>& w = work_[i];
    const int n = joint.columns;
    Vector6<P> a = (shifted(work_[joint.parent].acceleration, w.r) + w.bias).to_vector(), ddq;
    for (int k = 0; k < n; ++k) ddq[k] = w.u[k] - w.U.col(k).dot(a);
    if (n == 1)
      ddq[0] *= w.L(0, 0);
    else  // solves L^T qdd = u - U^T a
      for (int k = n - 1; k >= 0; --k) {
        for (int j = k + 1; j < n; ++j) ddq[k] -= w.L(j, k) * ddq[j];
        ddq[k] /= w.L(k, k);
      }
    for (int k = 0; k < n; ++k) a += w.S_columns.col(k) * ddq[k], store(joint.v + k, ddq[k]);
    w.acceleration = Motion<P>(a);
  }

  const TreeTask<S>& task_;
  const Axis<P>* axes_;
  JointWork<P>* work_;
  Eigen::Index first_;
  Mask usual_;
};

template <class P, class F>
[[gnu::always_inline]] inline void forEachPack(const TreeTask<Lane<P>>& task, F f) {
  const std::size_t n = std::size_t(task.njoints);
  auto* const work = static_cast<JointWork<P>*>(task.work);
  auto* const axes = reinterpret_cast<Axis<P>*>(work + n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& axis = task.joints[i].axis;
    ::new (work + i) JointWork<P>;
    ::new (axes + i) Axis<P>(typename Axis<P>::Unit{each<P>([&](int k) { return P(axis[k]); })});
  }
  for (Eigen::Index i = 0; i < task.columns; i += P::size) {
    const auto usual = f(TreePack<P>(task, axes, work, i));
    if (P::all(usual)) [[likely]]
      continue;
    for (int lane = 0; lane < P::size; ++lane)
      if (usual[lane] == 0) task.alone(task, i + lane);
  }
}
template <class P>
void treePoses(const TreeTask<Lane<P>>& task) {
  forEachPack<P>(task, [](TreePack<P> pack) { return pack.forwardKinematics(); });
}
template <class P>
void treeRnea(const TreeTask<Lane<P>>& task) {
  forEachPack<P>(task, [](TreePack<P> pack) { return pack.rnea(); });
}
template <class P>
void treeAba(const TreeTask<Lane<P>>& task) {
  forEachPack<P>(task, [](TreePack<P> pack) { return pack.aba(); });
}

}  // namespace liecheck::batch::detail
