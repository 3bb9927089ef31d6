#pragma once
// System of one free rigid body, by the Newton-Euler equations. q = [p; x y z w], v = (u, omega) in the
// body's axes at its origin. With the centre of mass c and the inertia I_C about c:
//
//   u_C = u + omega x c
//   omega_dot = I_C^-1 (n - c x f - omega x I_C omega)        diagonal I_C: (I_j - I_k)/I_i omega_j omega_k
//   u_dot     = f/m - omega x u_C + R^T g - omega_dot x c     derivative of u in the body's axes
//
// Error of omega_dot: 4 eps times the sum of its terms' absolute values; 3 eps relative if I_C is diagonal
// and no force acts.

#include <array>
#include <liecheck/algorithms/crba.hpp>
#include <liecheck/scene/accumulate.hpp>
#include <liecheck/scene/effects/effect.hpp>
#include <liecheck/scene/pieces.hpp>
#include <liecheck/scene/system.hpp>
#include <liecheck/scene/tangent_rate.hpp>

namespace liecheck::scene {

template <Scalar S>
class LoneBody {
 public:
  using Scalar = S;
  using Configuration = Vector7<S>;
  using Tangent = Vector6<S>;

  /// True if the model is one free-flyer at the world's origin and nothing else.
  static bool fits(const Model<S>& model) {
    return model.njoints == 2 && std::holds_alternative<FreeFlyer<S>>(model.joints[1]) &&
           model.jointPlacements[1].rotation().isIdentity(S(0)) &&
           model.jointPlacements[1].translation().isZero(S(0));
  }

  /// Throws SingularInertia if the mass or a moment is 0 or an effect sets an armature, and
  /// std::invalid_argument if the model does not fit.
  explicit LoneBody(const Model<S>& robot, Effects<S> effects = {});

  static constexpr int nq() { return 7; }
  static constexpr int nv() { return 6; }
  const Model<S>& model() const { return model_; }
  const Effects<S>& effects() const { return effects_; }  ///< without the effects that act on the model
  Kinematics needs() const { return needs_; }
  Pieces<S>& pieces() { return pieces_; }
  Switches<S>& switches() { return switches_; }
  /// True if no force and no gravity acts. Momentum is then conserved.
  bool forceFree() const { return effects_.empty() && !heavy_; }

  bool readsConfiguration() const { return !forceFree(); }

  [[gnu::always_inline]] void acceleration(const S& t, const Configuration& q, const Tangent& v, Tangent& a) {
    if (plain_) return plainEquations(v, a);
    if (!effects_.empty()) force_ = force(t, q, v);
    equations(q, v, a);
  }
  void load(const S& t, const Configuration& q, const Tangent& v) { force_ = force(t, q, v); }
  /// Computes v_dot with the force that the last acceleration() or load() computed.
  [[gnu::noinline]] void equations(const Configuration& q, const Tangent& v, Tangent& a) const {
    if (plain_) return plainEquations(v, a);
    const Vector3<S> omega(v[3], v[4], v[5]);
    Vector3<S> u_C(v[0], v[1], v[2]);
    if (!centred_) u_C += liecheck::cross<S>(omega, c_);
    const Vector3<S> turning = liecheck::cross<S>(omega, u_C);
    Vector3<S> linear(-turning[0], -turning[1], -turning[2]), angular;
    if (diagonal_)
      angular = euler(omega);
    else
      angular = product<S>(I_inverse_, liecheck::cross<S>(product<S>(I_, omega), omega));
    if (heavy_) linear += rotationOf(q).actInv(model_.gravity);
    if (!effects_.empty()) {
      linear += force_.linear() / mass_;
      angular +=
          product<S>(I_inverse_, Vector3<S>(force_.angular() - liecheck::cross<S>(c_, force_.linear())));
    }
    if (!centred_) linear -= liecheck::cross<S>(angular, c_);
    for (int i = 0; i < 3; ++i) a[i] = linear[i], a[3 + i] = angular[i];
  }

  void integrate(const Configuration& q, const Tangent& delta, Configuration& result) const {
    result = integrateSE3<S>(q, delta);
  }
  void accumulate(Configuration& q, Tangent& low, const Tangent& delta) const {
    accumulateSE3<S>(q, low, delta);
  }
  void tangentRate(const Tangent& delta, const Tangent& v, Tangent& rate) const {
    rate = scene::tangentRate<S>(delta, v);
  }
  void coefficientRate(const Configuration& q, const Tangent& v, Configuration& rate) const {
    rate = integrateCoeffWiseJacobianSE3<S>(q) * v;
  }
  void normalize(Configuration& q) const { q = FreeFlyer<S>::normalized(q); }

  /// The sum of all forces except gravity, at the origin, in the body's axes [N, N m].
  [[gnu::noinline]] Force<S> force(const S& t, const Configuration& q, const Tangent& v) {
    const Now<S> now = here(t, q, v, needs_);
    switches_.restart();
    tau_.setZero();
    f_.fill(Force<S>::Zero());
    for (const auto& e : effects_) e->add(now, {{tau_.data(), 6}, f_});
    return f_[1] + Force<S>(tau_);
  }
  /// The state that effects and observers read, valid until the next call. Give a = v_dot for accelerations.
  Now<S> here(const S& t, const Configuration& q, const Tangent& v, Kinematics kinematics,
              const Tangent* a = nullptr) {
    if (kinematics != Kinematics::None) X_[1] = SE3<S>(rotationOf(q), Vector3<S>(q[0], q[1], q[2]));
    if (kinematics >= Kinematics::Velocities) V_[1] = Motion<S>(v);
    if (a) A_[1] = Motion<S>(*a);
    return {t, pieces_.at(t), {q.data(), 7}, {v.data(), 6}, X_, V_, A_, &switches_};
  }

  const S& mass() const { return mass_; }
  const Vector3<S>& lever() const { return c_; }    ///< p_BoBcm_B [m]
  const Matrix3<S>& inertia() const { return I_; }  ///< I_C [kg m^2]
  const Matrix3<S>& inertiaInverse() const { return I_inverse_; }

 private:
  [[gnu::always_inline]] Vector3<S> euler(const Vector3<S>& omega) const {
    return Vector3<S>(euler_[0] * (omega[1] * omega[2]), euler_[1] * (omega[2] * omega[0]),
                      euler_[2] * (omega[0] * omega[1]));
  }
  /// The equations for a diagonal inertia, c = 0 and no force.
  [[gnu::always_inline]] void plainEquations(const Tangent& v, Tangent& a) const {
    const Vector3<S> omega(v[3], v[4], v[5]), angular = euler(omega);
    const Vector3<S> turning = liecheck::cross<S>(omega, Vector3<S>(v[0], v[1], v[2]));
    for (int i = 0; i < 3; ++i) a[i] = -turning[i], a[3 + i] = angular[i];
  }
  static SO3<S> rotationOf(const Configuration& q) { return SO3<S>(Vector4<S>(q[3], q[4], q[5], q[6])); }
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
  bool diagonal_, centred_, heavy_, plain_;
  std::array<SE3<S>, 2> X_;
  std::array<Motion<S>, 2> V_, A_;
  std::array<Force<S>, 2> f_;
  Force<S> force_ = Force<S>::Zero();
  Vector6<S> tau_;
};

template <Scalar S>
LoneBody<S>::LoneBody(const Model<S>& robot, Effects<S> effects) : model_(robot) {
  if (!fits(robot)) throw std::invalid_argument("a lone body is one free-flyer at the world's origin");
  model_.gravity.setZero(), model_.armature.setZero();
  for (const auto& e : effects) {
    e->prepare(model_);
    if (e->acts() == Acts::OnModel) continue;
    if (e->needs() > needs_) needs_ = e->needs();
    pieces_.add(e->events());
    effects_.push_back(e);
  }
  const Inertia<S>& I = model_.inertias[1];
  const Matrix3<S>& J = I.inertia();
  mass_ = I.mass(), c_ = I.lever(), I_ = J;
  moments_ = J.diagonal();
  diagonal_ = J(0, 1) == S(0) && J(0, 2) == S(0) && J(1, 2) == S(0);
  centred_ = c_.isZero(S(0));
  heavy_ = !model_.gravity.isZero(S(0));
  plain_ = diagonal_ && centred_ && forceFree();
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

}  // namespace liecheck::scene
