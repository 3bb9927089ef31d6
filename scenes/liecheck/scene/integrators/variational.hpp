#pragma once
// Variational, symplectic integrator of a lone rigid body. It stores the spatial momentum, which is constant
// for a free body.
//
//   L_d(R0, R1) = phi^T I_C phi / (2 h),  phi = log(R0^T R1)
//   h R0^T L = J_r^-1(phi) I_C phi,   R1 = R0 exp(phi),   c1 = c0 + h P/m        (Newton's method for phi)
//   v1 from I_C omega1 = R1^T L, m u_C = R1^T P;  forces: L += h/2 n, P += h/2 f before and after (Verlet)
//
// Order 2, symmetric. (Moser & Veselov 1991; Lee, Leok & McClamroch 2005; Bou-Rabee & Marsden 2009, sec. 4.)
// L is the angular momentum about the centre of mass, P the linear momentum, both in the world's axes;
// begin() computes them from the state. Velocity-dependent forces at the end of the step are implicit.

#include <liecheck/scene/integrators/method.hpp>
#include <liecheck/scene/lone_body.hpp>

namespace liecheck::scene {

template <Scalar S>
class Variational final : public Method<LoneBody<S>> {
 public:
  using Body = LoneBody<S>;
  static constexpr MethodInfo info{
      .name = "variational",
      .order = 2,
      .equation = "h R0^T L = J_r^-1(phi) I phi, R1 = R0 exp(phi), L and P constant",
      .source = "Moser & Veselov 1991; Bou-Rabee & Marsden 2009",
      .preserves_energy = true,
      .preserves_momentum = true,
      .lone_body_only = true};
  const MethodInfo& what() const override { return info; }
  MethodCounts counts() const override { return counts_; }
  using Memory = typename Method<LoneBody<S>>::Memory;
  std::optional<Memory> memory() const override {
    Memory all;
    for (const auto* x : {&L_, &P_, &L_low_, &P_low_}) all.insert(all.end(), {(*x)[0], (*x)[1], (*x)[2]});
    return all;
  }
  void recall(const Memory& all) override {
    std::size_t at = 0;
    for (auto* x : {&L_, &P_, &L_low_, &P_low_})
      for (int i = 0; i < 3; ++i) (*x)[i] = all.at(at++);
  }
  void begin(Body& body, const State<Body>& state) override {
    const SO3<S> Q = rotationOf(state.q);
    L_ = Q.act(Vector3<S>(body.inertia() * Vector3<S>(state.v.template tail<3>())));
    P_ = body.mass() * state.v.template head<3>();
    L_low_.setZero(), P_low_.setZero();
  }
  void step(Body& body, State<Body>& state, const S& h) override {
    const State<Body> start = state;
    const Momentum before{L_, P_, L_low_, P_low_};
    try {
      advance(body, state, h);
    } catch (const StepFailed&) {
      state = start, restore(before);
      throw;
    }
    ++counts_.steps;
  }

 private:
  static constexpr int limit = 50;
  struct Momentum {
    Vector3<S> L, P, L_low, P_low;
  };
  void advance(Body& body, State<Body>& state, const S& h) {
    const bool free = body.forceFree();
    const S half = h / S(2);
    if (!free) kick(body, state.t, state.q, state.v, half);
    checkFinite(L_, P_);
    const Vector3<S> target = h * inBody(state, L_);
    const Vector3<S> phi = solve(body.inertia(), body.inertiaInverse(), target);
    accumulateRotation<S>(state.q.template tail<4>(), state.q_low.template tail<3>(),
                          quaternion::exp3<S>(phi));
    for (int i = 0; i < 3; ++i) accumulate<S>(state.q[i], state.q_low[i], S(h * P_[i] / body.mass()));
    setVelocity(body, state);
    if (!free) {
      const Momentum drifted{L_, P_, L_low_, P_low_};
      Vector6<S> last;
      for (int k = 0;; ++k) {
        last = state.v;
        restore(drifted);
        kick(body, S(state.t + h), state.q, last, half);
        checkFinite(L_, P_);
        setVelocity(body, state);
        const S change = (state.v - last).cwiseAbs().maxCoeff();
        if (!(change > S(4) * eps<S>() * state.v.cwiseAbs().maxCoeff())) break;
        if (k == limit)
          throw StepFailed("variational: the velocity after the step did not converge: take a smaller step");
      }
    }
  }
  void restore(const Momentum& m) { L_ = m.L, P_ = m.P, L_low_ = m.L_low, P_low_ = m.P_low; }
  static SO3<S> rotationOf(const Vector7<S>& q) { return SO3<S>(Vector4<S>(q[3], q[4], q[5], q[6])); }
  /// R^T x for R = R(Q) exp(q_low).
  static Vector3<S> inBody(const State<Body>& state, const Vector3<S>& x) {
    const Vector3<S> y = rotationOf(state.q).actInv(x);
    return y - liecheck::cross<S>(Vector3<S>(state.q_low.template tail<3>()), y);
  }
  void setVelocity(const Body& body, State<Body>& state) const {
    const Vector3<S> omega = product<S>(body.inertiaInverse(), inBody(state, L_));
    state.v << P_ / body.mass(), omega;
    state.v_low.setZero();
  }
  void kick(Body& body, const S& t, const Vector7<S>& q, const Vector6<S>& v, const S& h) {
    body.load(t, q, v);
    const Vector3<S> f = body.force(v) + body.mass() * body.model().gravity;
    const Vector3<S> n = rotationOf(q).act(body.moment(v));
    for (int i = 0; i < 3; ++i)
      accumulate<S>(P_[i], P_low_[i], S(h * f[i])), accumulate<S>(L_[i], L_low_[i], S(h * n[i]));
  }
  /// Solves J_r^-1(phi) I phi = target by Newton's method with the Jacobian I + ([phi] I - [I phi])/2, until
  /// the correction is a rounding error.
  Vector3<S> solve(const Matrix3<S>& I, const Matrix3<S>& I_inverse, const Vector3<S>& target) {
    Vector3<S> phi = I_inverse * target;
    S before = std::numeric_limits<S>::max();
    for (int k = 0; k < limit; ++k) {
      ++counts_.iterations;
      const Vector3<S> rest = tangentRate<S>(phi, product<S>(I, phi)) - target;
      const Matrix3<S> slope = I + (skew<S>(phi) * I - skew<S>(Vector3<S>(I * phi))) / S(2);
      const Vector3<S> a = slope.row(0), b = slope.row(1), c = slope.row(2);
      const Vector3<S> bc = liecheck::cross<S>(b, c), ca = liecheck::cross<S>(c, a),
                       ab = liecheck::cross<S>(a, b);
      const Vector3<S> correction = (rest[0] * bc + rest[1] * ca + rest[2] * ab) / S(a.dot(bc));
      phi -= correction;
      const S size = correction.cwiseAbs().maxCoeff();
      if (!finite<S>(size)) break;
      if (size == S(0) || (size <= S(16) * eps<S>() * phi.cwiseAbs().maxCoeff() && !(size < before)))
        return phi;
      before = size;
    }
    throw StepFailed(
        "variational: the rotation did not converge: take a smaller step (the rotation must be below pi)");
  }

  Vector3<S> L_, P_, L_low_, P_low_;
  MethodCounts counts_;
};

}  // namespace liecheck::scene
