#pragma once
// Commutator-free method of order 4: it uses five exponentials of sums of stages, and no J_r^-1.
//
//   k1 = h v(q0),  k2 = h v(q0 e^(k1/2)),  k3 = h v(q0 e^(k2/2)),  k4 = h v(q0 e^(k1/2) e^(k3 - k1/2))
//   q1 = q0 exp((3 k1 + 2 k2 + 2 k3 - k4)/12) exp((-k1 + 2 k2 + 2 k3 + 3 k4)/12)
//
// The velocity v follows the classical Runge-Kutta method.

#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

template <System Sys>
class CommutatorFree4 final : public Method<Sys> {
 public:
  using S = typename Sys::Scalar;
  static constexpr MethodInfo info{.name = "cf4",
                                   .order = 4,
                                   .evaluations = 4,
                                   .equation = "q1 = q0 exp((3k1+2k2+2k3-k4)/12) exp((-k1+2k2+2k3+3k4)/12)",
                                   .source = "Celledoni, Marthinsen & Owren 2003, sec. 4"};
  const MethodInfo& what() const override { return info; }
  void begin(Sys&, const State<Sys>& state) override {
    q2_ = q_ = state.q;
    a1_ = a2_ = a3_ = a4_ = v2_ = v3_ = v4_ = delta_ = dv_ = state.v;
  }
  void step(Sys& system, State<Sys>& state, const S& h) override {
    const S half = h / S(2), twelfth = h / S(12), middle = state.t + half;
    system.acceleration(state.t, state.q, state.v, a1_);
    v2_ = state.v + half * a1_;
    const bool reads = system.readsConfiguration();
    delta_ = half * state.v;
    if (reads) system.integrate(state.q, delta_, q2_);
    system.acceleration(middle, q2_, v2_, a2_);
    v3_ = state.v + half * a2_;
    delta_ = half * v2_;
    if (reads) system.integrate(state.q, delta_, q_);
    system.acceleration(middle, q_, v3_, a3_);
    v4_ = state.v + h * a3_;
    delta_ = h * v3_ - half * state.v;
    if (reads) system.integrate(q2_, delta_, q_);
    system.acceleration(S(state.t + h), q_, v4_, a4_);
    delta_ = twelfth * (S(3) * state.v + S(2) * (v2_ + v3_) - v4_);
    dv_ = twelfth * (S(2) * (v2_ + v3_) - state.v + S(3) * v4_);
    a1_ = (h / S(6)) * (a1_ + S(2) * (a2_ + a3_) + a4_);
    checkFinite(delta_, a1_);
    advance(system, state, delta_);
    advance(system, state, dv_, a1_);
  }

 private:
  typename Sys::Configuration q2_, q_;
  typename Sys::Tangent a1_, a2_, a3_, a4_, v2_, v3_, v4_, delta_, dv_;
};

}  // namespace liecheck::scene
