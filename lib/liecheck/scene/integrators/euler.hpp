#pragma once
// Explicit Euler with integrate, the simplest simulator.
//
//   q1 = integrate(q0, h v0),  v1 = v0 + h a(q0, v0)
//
// Order 1; energy grows.

#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

template <System Sys>
class Euler final : public Method<Sys> {
 public:
  static constexpr MethodInfo info{
      "euler", 1, 1, false, false, false, false, "q1 = q0 exp(h v0), v1 = v0 + h a0", "Euler 1768"};
  const MethodInfo& what() const override { return info; }
  void begin(Sys&, const State<Sys>& state) override { q_ = state.q, a_ = delta_ = state.v; }
  void step(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) override {
    system.acceleration(state.t, state.q, state.v, a_);
    delta_ = h * state.v, a_ *= h;
    checkFinite(delta_, a_);
    system.integrate(state.q, delta_, q_);
    state.q = q_, state.v += a_;
  }

 private:
  typename Sys::Configuration q_;
  typename Sys::Tangent a_, delta_;
};

}  // namespace liecheck::scene
