#pragma once
// Semi-implicit Euler with integrate, as in most real-time simulators.
//
//   v1 = v0 + h a(q0, v0),  q1 = integrate(q0, h v1)
//
// Order 1. It is symplectic on a vector space, but with gyroscopic terms of a rotating body the energy
// drifts.

#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

template <System Sys>
class SemiImplicitEuler final : public Method<Sys> {
 public:
  static constexpr MethodInfo info{
      "semi_implicit_euler",      1, 1, false, false, false, false, "v1 = v0 + h a0, q1 = q0 exp(h v1)",
      "Vogelaere 1956; Ruth 1983"};
  const MethodInfo& what() const override { return info; }
  void begin(Sys&, const State<Sys>& state) override { q_ = state.q, a_ = delta_ = state.v; }
  void step(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) override {
    system.acceleration(state.t, state.q, state.v, a_);
    a_ *= h;
    delta_ = h * (state.v + a_);
    checkFinite(delta_, a_);
    state.v += a_;
    system.integrate(state.q, delta_, q_);
    state.q = q_;
  }

 private:
  typename Sys::Configuration q_;
  typename Sys::Tangent a_, delta_;
};

}  // namespace liecheck::scene
