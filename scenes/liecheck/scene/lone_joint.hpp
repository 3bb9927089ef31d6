#pragma once
// System of a robot with one joint, revolute or prismatic, and forces along it: one equation of motion.
//
//   (D + armature) v_dot = tau + m g' . t(q),   D = S^T I S
//   prismatic: t = a;   revolute about the axis a through the joint's origin: t = a x R(a, q) c, D = a . I_O a
//
// with the centre of mass c, and g' = gravity in the axes of the joint's placement. The second term is
// A cos q + B sin q with constant A and B, or a constant. Observers read the poses of the tree of this one joint.
// Error of v_dot: 24 eps times the sum of its terms' absolute values, by counting the roundings of D, A, B and the sum.

#include <liecheck/scene/tree.hpp>

namespace liecheck::scene {

template <Scalar S>
class LoneJoint {
 public:
  using Scalar = S;
  using Configuration = Eigen::Matrix<S, 1, 1>;
  using Tangent = Eigen::Matrix<S, 1, 1>;
  struct Path {};

  /// True if the model is one revolute or prismatic joint, and all effects act on joints or on the model.
  static bool fits(const Model<S>& model, const Effects<S>& effects) {
    if (model.njoints != 2 || !(std::holds_alternative<Revolute<S>>(model.joints[1]) ||
                                std::holds_alternative<Prismatic<S>>(model.joints[1])))
      return false;
    return std::ranges::all_of(effects, [](const auto& e) { return e->acts() != Acts::OnBodies; });
  }

  /// Throws SingularInertia if D + armature is not positive.
  explicit LoneJoint(const Model<S>& robot, const Effects<S>& effects = {})
      : tree_(robot, effects), reads_(!tree_.effects().empty()) {
    const Model<S>& m = tree_.model();
    const Inertia<S>& I = m.inertias[1];
    const Vector3<S> g = m.jointPlacements[1].rotation().transpose() * m.gravity, c = I.lever();
    S D;
    if (const auto* hinge = std::get_if<Revolute<S>>(&m.joints[1])) {
      const Vector3<S> a = hinge->axis.to_vector(), arm = liecheck::cross<S>(a, c);
      D = a.dot(I.inertia() * a) + I.mass() * arm.squaredNorm();
      cosine_ = I.mass() * g.dot(arm), sine_ = I.mass() * g.dot(liecheck::cross<S>(a, arm));
    } else {
      const Vector3<S> a = std::get<Prismatic<S>>(m.joints[1]).axis.to_vector();
      D = I.mass();
      constant_ = I.mass() * g.dot(a);
    }
    inertia_ = D + m.armature[0];
    if (!(inertia_ > S(0)) || !finite<S>(inertia_)) throw SingularInertia(m.names[1], 1);
    swings_ = cosine_ != S(0) || sine_ != S(0);
  }

  static constexpr int nv() { return 1; }
  const Model<S>& model() const { return tree_.model(); }
  const Effects<S>& effects() const { return tree_.effects(); }
  Kinematics needs() const { return Kinematics::None; }
  Pieces<S>& pieces() { return tree_.pieces(); }
  Switches<S>& switches() { return tree_.switches(); }

  bool readsConfiguration() const { return swings_ || reads_; }

  [[gnu::always_inline]] void acceleration(const S& t, const Configuration& q, const Tangent& v, Tangent& a) {
    if (reads_ && !kept_.take(t, q, v)) load(t, q, v);
    equations(q, v, a);
  }
  void keep(const S& t, const Configuration& q, const Tangent& v) { kept_.keep(t, q, v); }
  /// Sums the forces of all effects.
  [[gnu::noinline]] void load(const S& t, const Configuration& q, const Tangent& v) {
    if (!reads_) return;
    kept_.drop(), tau_ = S(0);
    const Now<S> now{t, pieces().at(t), {q.data(), 1}, {v.data(), 1}, {}, {}, {}, &switches()};
    switches().restart();
    for (const auto& e : tree_.effects()) e->add(now, {{&tau_, 1}, {}});
  }
  /// Computes v_dot with the forces of the last load().
  [[gnu::always_inline]] void equations(const Configuration& q, const Tangent&, Tangent& a) const {
    using std::cos, std::sin;
    S tau = constant_;
    if (swings_) tau += cosine_ * S(cos(q[0])) + sine_ * S(sin(q[0]));
    if (reads_) tau += tau_;
    a[0] = tau / inertia_;
  }

  [[gnu::always_inline]] void integrate(const Configuration& q, const Tangent& delta,
                                        Configuration& result) const {
    result[0] = q[0] + delta[0];
  }
  void accumulate(Configuration& q, Tangent& low, const Tangent& delta) const {
    scene::accumulate<S>(q[0], low[0], delta[0]);
  }
  [[gnu::always_inline]] void tangentRate(const Tangent&, const Tangent& v, Tangent& rate) const {
    rate[0] = v[0];
  }
  void coefficientRate(const Configuration&, const Tangent& v, Configuration& rate) const { rate[0] = v[0]; }
  void normalize(Configuration&) const {}
  Tangent difference(const Configuration& q0, const Configuration& q1) const { return q1 - q0; }

  void fromModel(const VectorX<S>& q, const VectorX<S>& v, State<LoneJoint>& state) const {
    state.q[0] = q[0], state.v[0] = v[0];
  }
  std::pair<VectorX<S>, VectorX<S>> toModel(const State<LoneJoint>& s) const { return {s.q, s.v}; }

  /// The state that effects and observers read, valid until the next call. Give a = v_dot for accelerations.
  Now<S> here(const State<LoneJoint>& s, Kinematics kinematics, const Tangent* a = nullptr) {
    q_ = s.q, v_ = s.v;
    if (a) a_ = *a;
    return tree_.here(s.t, q_, v_, kinematics, a ? &a_ : nullptr);
  }

 private:
  Tree<S> tree_;  ///< of the one joint, for its effects and what observers read
  bool reads_, swings_ = false;
  S inertia_ = S(0), constant_ = S(0), cosine_ = S(0), sine_ = S(0), tau_ = S(0);
  Kept<S, Configuration, Tangent> kept_;
  VectorX<S> q_, v_, a_;
};

}  // namespace liecheck::scene
