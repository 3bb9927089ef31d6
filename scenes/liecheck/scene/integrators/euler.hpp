#pragma once
// Euler's method: explicit (in the simplest simulators) or semi-implicit (in most real-time simulators).
//
//   v1 = v0 + h a(q0, v0),  q1 = integrate(q0, h v), v = v0 or v1
//
// Order 1. The energy of the explicit method grows. The semi-implicit method is symplectic on a vector space,
// but with gyroscopic terms of a rotating body its energy drifts.

#include <liecheck/scene/integrators/method.hpp>

namespace liecheck::scene {

template <System Sys, bool semi_implicit = false>
class Euler final : public Method<Sys> {
 public:
  static constexpr MethodInfo info = semi_implicit
                                         ? MethodInfo{.name = "semi_implicit_euler",
                                                      .order = 1,
                                                      .evaluations = 1,
                                                      .equation = "v1 = v0 + h a0, q1 = q0 exp(h v1)",
                                                      .source = "Vogelaere 1956; Ruth 1983"}
                                         : MethodInfo{.name = "euler",
                                                      .order = 1,
                                                      .evaluations = 1,
                                                      .equation = "q1 = q0 exp(h v0), v1 = v0 + h a0",
                                                      .source = "Euler 1768"};
  const MethodInfo& what() const override { return info; }
  void begin(Sys&, const State<Sys>& state) override { q_ = state.q, a_ = delta_ = state.v; }
  void step(Sys& system, State<Sys>& state, const typename Sys::Scalar& h) override {
    system.acceleration(state.t, state.q, state.v, a_);
    a_ *= h;
    if constexpr (semi_implicit)
      delta_ = h * (state.v + a_);
    else
      delta_ = h * state.v;
    checkFinite(delta_, a_);
    system.integrate(state.q, delta_, q_);
    state.q = q_, state.v += a_;
  }

 private:
  typename Sys::Configuration q_;
  typename Sys::Tangent a_, delta_;
};
template <System Sys>
using SemiImplicitEuler = Euler<Sys, true>;

}  // namespace liecheck::scene
