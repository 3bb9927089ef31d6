#pragma once
// System of one free rigid body, by the Newton-Euler equations at its centre of mass c, in world axes for the
// translation and in body axes for the rotation:
//
//   state     c [m], Q (x y z w);   c_dot [m/s, world], omega [rad/s, body]         on R^3 x SO(3)
//   c_ddot    = g + f/m
//   omega_dot = I_C^-1 (n - omega x I_C omega)        diagonal I_C: (I_j - I_k)/I_i omega_j omega_k
//
// f [N, world] and n [N m, body] are the sums of all forces at c. The model's state (pose and twist of the body's
// origin) is computed only where an effect or an observer reads it. Without coupling, the translation is that of
// a point mass, whatever the rotation is, and its error is independent of that of the rotation.
//
// Effects that read neither pose nor time (BodyTerms) are summed once, before the run, into constant coefficients.
//
// Error of omega_dot: 4 eps times the sum of its terms' absolute values; 3 eps relative if I_C is diagonal
// and no force acts.

#include <array>
#include <liecheck/algorithms/crba.hpp>
#include <liecheck/scene/accumulate.hpp>
#include <liecheck/scene/effects/effect.hpp>
#include <liecheck/scene/pieces.hpp>
#include <liecheck/scene/rotation_step.hpp>
#include <liecheck/scene/system.hpp>

namespace liecheck::scene {

/// With moves = false the translation is that of a point under a constant acceleration, in closed form, and only the
/// rotation is integrated: q = Q [4], v = omega [3].
template <Scalar S, bool moves = true>
class LoneBody {
 public:
  using Scalar = S;
  using Configuration = std::conditional_t<moves, Vector7<S>, Vector4<S>>;
  using Tangent = std::conditional_t<moves, Vector6<S>, Vector3<S>>;
  /// The translation at the time t [s], if it is not part of the state: c [m] and c_dot [m/s].
  struct Still {};
  struct Thrown {
    S t = S(0);
    Vector3<S> c, c_dot;
  };
  using Path = std::conditional_t<moves, Still, Thrown>;

  /// True if the model is one free-flyer at the world's origin and nothing else.
  static bool fits(const Model<S>& model) {
    return model.njoints == 2 && std::holds_alternative<FreeFlyer<S>>(model.joints[1]) &&
           model.jointPlacements[1].rotation().isIdentity(S(0)) &&
           model.jointPlacements[1].translation().isZero(S(0));
  }

  /// Throws SingularInertia if the mass or a moment is 0 or an effect sets an armature, and std::invalid_argument if
  /// the model does not fit, or if the acceleration of c is not constant and moves is false.
  explicit LoneBody(const Model<S>& robot, Effects<S> effects = {});

  static constexpr int nv() { return moves ? 6 : 3; }
  const Model<S>& model() const { return model_; }
  const Effects<S>& effects() const { return effects_; }  ///< those that are evaluated in a step
  Kinematics needs() const { return needs_; }
  Pieces<S>& pieces() { return pieces_; }
  Switches<S>& switches() { return switches_; }
  /// True if no force and no gravity acts. Momentum is then conserved.
  bool forceFree() const { return free_; }
  /// True if the acceleration of c is constant.
  bool thrown() const { return effects_.empty() && terms_.thrown(); }

  bool readsConfiguration() const { return moves && reads_; }

  [[gnu::always_inline]] void acceleration(const S& t, const Configuration& q, const Tangent& v, Tangent& a) {
    if constexpr (moves)
      if (reads_) reload(t, q, v);  // by value, so that q and v stay in registers
    equations(q, v, a);
  }
  void keep(const S& t, const Configuration& q, const Tangent& v) { kept_.keep(t, q, v); }
  /// Sums the forces that depend on the configuration.
  [[gnu::noinline]] void load(const S& t, const Configuration& q, const Tangent& v) {
    if constexpr (moves) {
      if (!readsConfiguration()) return;
      kept_.drop();
      Force<S> F(terms_.force_B, Vector3<S>::Zero());
      const Matrix3<S> R = matrixOf<S>(quaternionOf(q));
      if (!effects_.empty()) {
        const Now<S> now = here(t, q, v, R, needs_);
        switches_.restart();
        tau_.setZero(), f_[1] = Force<S>::Zero();
        for (const auto& e : effects_) e->add(now, {{tau_.data(), 6}, f_});
        const Force<S> G = Force<S>(tau_) + Force<S>(transposed_product<S>(R, f_[1].linear()),
                                                     transposed_product<S>(R, f_[1].angular()));
        F = F + Force<S>(G.linear(), Vector3<S>(G.angular() - liecheck::cross<S>(c_, G.linear())));
      }
      load_ = Force<S>(product<S>(R, F.linear()), F.angular());
    }
  }
  /// Computes v_dot with the forces of the last load().
  [[gnu::always_inline]] void equations(const Configuration&, const Tangent& v, Tangent& a) const {
    const Vector3<S> omega = spin(v);
    Vector3<S> angular;
    if (plain_) [[likely]] {
      angular = euler(omega);
    } else {
      angular =
          diagonal_ ? euler(omega) : product<S>(I_inverse_, liecheck::cross<S>(product<S>(I_, omega), omega));
      if (twisted_) angular += product<S>(I_inverse_, moment(v));
    }
    if constexpr (moves) {
      Vector3<S> linear = thrust_;
      if (slowed_) linear -= resistance(v);
      if (!plain_ && reads_) linear += load_.linear() / mass_;  // a plain body reads nothing: no second test
      for (int i = 0; i < 3; ++i) a[i] = linear[i], a[3 + i] = angular[i];
    } else {
      a = angular;
    }
  }
  /// The force of all effects but gravity at c [N, world]. load() must have seen the state.
  Vector3<S> force(const Vector6<S>& v) const {
    Vector3<S> f = mass_ * (thrust_ - model_.gravity);
    if (slowed_) f -= mass_ * resistance(v);
    if (reads_) f += load_.linear();
    return f;
  }
  /// The moment of all effects about c [N m, body]. load() must have seen the state.
  [[gnu::always_inline]] Vector3<S> moment(const Tangent& v) const {
    Vector3<S> n = terms_.moment_B;
    if (braked_) n -= against(terms_.angular_linear, terms_.angular_quadratic, spin(v)) * spin(v);
    if (moves && reads_) n += load_.angular();
    return n;
  }

  [[gnu::always_inline]] void integrate(const Configuration& q, const Tangent& delta,
                                        Configuration& result) const {
    const Vector4<S> Q = rotated<S>(quaternionOf(q), spin(delta));
    if constexpr (moves)
      for (int i = 0; i < 3; ++i) result[i] = q[i] + delta[i];
    for (int i = 0; i < 4; ++i) result[turn + i] = Q[i];
  }
  void accumulate(Configuration& q, Tangent& low, const Tangent& delta) const {
    if constexpr (moves)
      for (int i = 0; i < 3; ++i) scene::accumulate<S>(q[i], low[i], delta[i]);
    accumulateRotation<S>(q.template tail<4>(), low.template tail<3>(), quaternion::exp3<S>(spin(delta)));
  }
  [[gnu::always_inline]] void tangentRate(const Tangent& delta, const Tangent& v, Tangent& rate) const {
    const Vector3<S> w = rotationRate<S>(spin(delta), spin(v));
    if constexpr (moves)
      for (int i = 0; i < 3; ++i) rate[i] = v[i];
    for (int i = 0; i < 3; ++i) rate[turn + i] = w[i];
  }
  void coefficientRate(const Configuration& q, const Tangent& v, Configuration& rate) const {
    const Vector3<S> w = spin(v);
    const Vector4<S> half(w[0] / S(2), w[1] / S(2), w[2] / S(2), S(0));
    if constexpr (moves) rate.template head<3>() = v.template head<3>();
    rate.template tail<4>() = quaternionProduct<S>(quaternionOf(q), half);
  }
  void normalize(Configuration& q) const { q.template tail<4>() = Spherical<S>::normalized(quaternionOf(q)); }
  /// The increment from q0 to q1: (c1 - c0, log(Q0^-1 Q1)).
  Tangent difference(const Configuration& q0, const Configuration& q1) const {
    Vector7<S> a = Vector7<S>::Zero(), b = a;
    a.template tail<4>() = quaternionOf(q0), b.template tail<4>() = quaternionOf(q1);
    Tangent delta;
    if constexpr (moves) delta.template head<3>() = q1.template head<3>() - q0.template head<3>();
    delta.template tail<3>() = differenceSE3<S>(a, b).template tail<3>();
    return delta;
  }

  /// Sets the state to that of the model: (p, Q) and (u, omega) of the body's origin in its axes.
  void fromModel(const VectorX<S>& q, const VectorX<S>& v, State<LoneBody>& state) const {
    const SO3<S> Q(Vector4<S>(q[3], q[4], q[5], q[6]));
    const Vector3<S> omega(v[3], v[4], v[5]), u(v[0], v[1], v[2]), p(q[0], q[1], q[2]);
    const Vector3<S> c = p + Q.act(c_), c_dot = Q.act(Vector3<S>(u + liecheck::cross<S>(omega, c_)));
    if constexpr (moves)
      state.q.template head<3>() = c, state.v.template head<3>() = c_dot;
    else
      state.path = {state.t, c, c_dot};
    state.q.template tail<4>() = Q.to_vector(), state.v.template tail<3>() = omega;
  }
  /// The state of the model, q [7] and v [6].
  std::pair<Vector7<S>, Vector6<S>> toModel(const State<LoneBody>& s) const {
    const auto [x, w] = whole(s);
    return toModel(x, w, matrixOf<S>(quaternionOf(s.q)));
  }

  /// The state that effects and observers read, valid until the next call. Give a = v_dot for accelerations.
  Now<S> here(const State<LoneBody>& s, Kinematics kinematics, const Tangent* a = nullptr) {
    const auto [x, w] = whole(s);
    Now<S> now = here(s.t, x, w, matrixOf<S>(quaternionOf(s.q)), kinematics);
    if (!a) return now;
    if constexpr (moves)
      a_ = *a;
    else
      a_ << thrust_, *a;
    a_ = accelerationOfModel(a_);
    A_[1] = Motion<S>(a_), now.a = {a_.data(), 6};
    return now;
  }

  const S& mass() const { return mass_; }
  const Vector3<S>& lever() const { return c_; }    ///< p_BoBcm_B [m]
  const Matrix3<S>& inertia() const { return I_; }  ///< I_C [kg m^2]
  const Matrix3<S>& inertiaInverse() const { return I_inverse_; }

 private:
  [[gnu::noinline]] void reload(S t, Configuration q, Tangent v) {
    if (!kept_.take(t, q, v)) load(t, q, v);
  }
  static constexpr int turn = moves ? 3 : 0;  ///< where the rotation begins in q and in v
  template <class T>
  [[gnu::always_inline]] static Vector3<S> spin(const T& v) {
    constexpr int at = int(T::RowsAtCompileTime) - 3;
    return Vector3<S>(v[at], v[at + 1], v[at + 2]);
  }
  [[gnu::always_inline]] static Vector4<S> quaternionOf(const Configuration& q) {
    return Vector4<S>(q[turn], q[turn + 1], q[turn + 2], q[turn + 3]);
  }
  /// (c, Q) and (c_dot, omega).
  std::pair<Vector7<S>, Vector6<S>> whole(const State<LoneBody>& s) const {
    if constexpr (moves) {
      return {s.q, s.v};
    } else {
      const S t = s.t - s.path.t;
      const Vector3<S> a = thrust_;
      Vector7<S> x;
      Vector6<S> w;
      x << s.path.c + t * (s.path.c_dot + t / S(2) * a), s.q;
      w << s.path.c_dot + t * a, s.v;
      return {x, w};
    }
  }
  /// The model's state of c, c_dot and the rotation R.
  std::pair<Vector7<S>, Vector6<S>> toModel(const Vector7<S>& x, const Vector6<S>& w,
                                            const Matrix3<S>& R) const {
    Vector7<S> q = x;
    Vector6<S> v = w;
    v.template head<3>() = transposed_product<S>(R, Vector3<S>(w[0], w[1], w[2]));
    if (!centred_) {
      q.template head<3>() -= product<S>(R, c_);
      v.template head<3>() -= liecheck::cross<S>(Vector3<S>(w[3], w[4], w[5]), c_);
    }
    return {q, v};
  }
  Now<S> here(const S& t, const Vector7<S>& x, const Vector6<S>& w, const Matrix3<S>& R,
              Kinematics kinematics) {
    std::tie(q_, v_) = toModel(x, w, R);
    if (kinematics != Kinematics::None) X_[1] = SE3<S>(R, Vector3<S>(q_[0], q_[1], q_[2]));
    if (kinematics >= Kinematics::Velocities) V_[1] = Motion<S>(v_);
    return {t, pieces_.at(t), {q_.data(), 7}, {v_.data(), 6}, X_, {V_, X_, false}, A_, &switches_};
  }
  [[gnu::always_inline]] static S against(const S& linear, const S& quadratic, const Vector3<S>& u) {
    using std::sqrt;
    return quadratic == S(0) ? linear : S(linear + quadratic * S(sqrt(dot<S>(u, u))));
  }
  /// The deceleration by drag against c_dot [m/s^2, world].
  [[gnu::always_inline]] Vector3<S> resistance(const Vector6<S>& v) const {
    const Vector3<S> u(v[0], v[1], v[2]);
    return against(linear_, quadratic_, u) * u;
  }
  /// -I_C^-1 omega x I_C omega of a diagonal inertia.
  [[gnu::always_inline]] Vector3<S> euler(const Vector3<S>& omega) const {
    return Vector3<S>(euler_[0] * (omega[1] * omega[2]), euler_[1] * (omega[2] * omega[0]),
                      euler_[2] * (omega[0] * omega[1]));
  }
  /// The derivative of the model's velocity v_ in body axes: u_C_dot = R^T c_ddot - omega x u_C, less omega_dot x c.
  Vector6<S> accelerationOfModel(const Vector6<S>& a) const {
    const Vector3<S> omega(v_[3], v_[4], v_[5]), omega_dot(a[3], a[4], a[5]), u(v_[0], v_[1], v_[2]);
    Vector6<S> result = a;
    result.template head<3>() =
        SO3<S>(Vector4<S>(q_[3], q_[4], q_[5], q_[6])).actInv(Vector3<S>(a[0], a[1], a[2])) -
        liecheck::cross<S>(omega, Vector3<S>(u + liecheck::cross<S>(omega, c_))) -
        liecheck::cross<S>(omega_dot, c_);
    return result;
  }
  /// Computed by cofactors; correctly rounded for a diagonal matrix.
  static Matrix3<S> inverse(const Matrix3<S>& J) {
    if (J.isDiagonal(S(0))) return Matrix3<S>(Vector3<S>(J.diagonal().cwiseInverse()).asDiagonal());
    Matrix3<S> result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
        result(i, j) = J(a, c) * J(b, d) - J(a, d) * J(b, c);
      }
    return result / S(J.row(0).dot(result.col(0)));
  }

  Model<S> model_;
  Effects<S> effects_;
  Kinematics needs_ = Kinematics::None;
  Pieces<S> pieces_;
  Switches<S> switches_;
  S mass_;
  Vector3<S> c_, moments_, euler_;
  Matrix3<S> I_, I_inverse_;
  BodyTerms<S> terms_;
  Vector3<S> thrust_;     ///< g + force_W/m [m/s^2]
  S linear_, quadratic_;  ///< coefficients of drag divided by m
  bool diagonal_, centred_;
  /// omega_dot is that of a free body with diagonal inertia, and no force reads the pose.
  bool plain_ = false;
  bool free_ = false, reads_ = false, slowed_ = false, braked_ = false, twisted_ = false;
  std::array<SE3<S>, 2> X_;
  std::array<Motion<S>, 2> V_, A_;
  std::array<Force<S>, 2> f_;
  Kept<S, Configuration, Tangent> kept_;
  Force<S> load_ = Force<S>::Zero();
  Vector7<S> q_;
  Vector6<S> tau_, v_, a_;
};

template <Scalar S, bool moves>
LoneBody<S, moves>::LoneBody(const Model<S>& robot, Effects<S> effects) : model_(robot) {
  if (!fits(robot)) throw std::invalid_argument("a lone body is one free-flyer at the world's origin");
  model_.gravity.setZero(), model_.armature.setZero();
  const Inertia<S>& I = model_.inertias[1];
  const Matrix3<S>& J = I.inertia();
  mass_ = I.mass(), c_ = I.lever(), I_ = J;
  for (const auto& e : effects) {
    e->prepare(model_);
    if (e->acts() == Acts::OnModel || e->addConstant(c_, terms_)) continue;
    if (e->needs() > needs_) needs_ = e->needs();
    pieces_.add(e->events());
    effects_.push_back(e);
  }
  moments_ = J.diagonal();
  diagonal_ = J(0, 1) == S(0) && J(0, 2) == S(0) && J(1, 2) == S(0);
  centred_ = c_.isZero(S(0));
  thrust_ = model_.gravity + terms_.force_W / mass_;
  linear_ = terms_.linear / mass_, quadratic_ = terms_.quadratic / mass_;
  reads_ = !effects_.empty() || !terms_.force_B.isZero(S(0));
  slowed_ = terms_.linear != S(0) || terms_.quadratic != S(0);
  braked_ = terms_.angular_linear != S(0) || terms_.angular_quadratic != S(0);
  twisted_ = !effects_.empty() || braked_ || !terms_.moment_B.isZero(S(0));
  plain_ = diagonal_ && !twisted_ && !reads_;
  if (!moves && !thrown())
    throw std::invalid_argument("the acceleration of the centre of mass is not constant");
  free_ = !reads_ && !twisted_ && !slowed_ && thrust_.isZero(S(0));
  if (!(mass_ > S(0)) || !(moments_.minCoeff() > S(0)) || !model_.armature.isZero(S(0)))
    throw SingularInertia(model_.names[1], 1);
  I_inverse_ = inverse(J);
  if (!I_inverse_.allFinite()) throw SingularInertia(model_.names[1], 1);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    euler_[i] = (moments_[j] - moments_[k]) / moments_[i];
  }
  X_.fill(SE3<S>::Identity()), V_.fill(Motion<S>::Zero()), A_.fill(Motion<S>::Zero());
}

/// A lone body whose translation has a closed form.
template <Scalar S>
using ThrownBody = LoneBody<S, false>;

}  // namespace liecheck::scene
