#pragma once
// Gauss collocation on the group: the implicit Runge-Kutta method with s Gauss points for the increment and
// the velocity (implicit_stages.hpp). Order 2 s (Butcher 1964, Implicit Runge-Kutta processes; Hairer, Lubich &
// Wanner 2006, II.1.3). With s = 1 it is the implicit midpoint rule on the group.

#include <liecheck/scene/integrators/implicit_stages.hpp>

namespace liecheck::scene {

/// The properties of the method with s Gauss points.
template <int s>
inline constexpr MethodInfo collocation_info{};
/// The implicit midpoint rule on the group. Its increment h v_m / 2 is parallel to v_m, so that J_r^-1 of the
/// increment leaves v_m unchanged:
///   v_m = v0 + h/2 a(q0 exp(h v_m/2), v_m),   q1 = q0 exp(h v_m),   v1 = 2 v_m - v0
/// The rule is symmetric: a step of -h undoes a step of h. Therefore the energy of a reversible motion does
/// not drift.
template <>
inline constexpr MethodInfo collocation_info<1>{
    .name = "implicit_midpoint",
    .order = 2,
    .equation = "v_m = v0 + h/2 a(q0 exp(h v_m/2), v_m), q1 = q0 exp(h v_m)",
    .source = "Hairer, Lubich & Wanner 2006, II.1.3",
    .increments = true,
    .preserves_energy = true};
template <>
inline constexpr MethodInfo collocation_info<3>{
    .name = "gauss6",
    .order = 6,
    .equation = "collocation of (delta, v) at 3 Gauss points, q1 = q0 exp(delta)",
    .source = "Butcher 1964, Implicit Runge-Kutta processes; Munthe-Kaas 1999",
    .increments = true};
template <>
inline constexpr MethodInfo collocation_info<6>{
    .name = "gauss12",
    .order = 12,
    .equation = "collocation of (delta, v) at 6 Gauss points, q1 = q0 exp(delta)",
    .source = "Butcher 1964, Implicit Runge-Kutta processes; Munthe-Kaas 1999",
    .increments = true};

template <System Sys, int s>
class Collocation final : public Method<Sys> {
 public:
  using S = typename Sys::Scalar;
  const MethodInfo& what() const override { return collocation_info<s>; }
  MethodCounts counts() const override { return {steps_, 0, stages_.iterations()}; }
  using Memory = typename Method<Sys>::Memory;
  std::optional<Memory> memory() const override { return stages_.memory(); }
  void recall(const Memory& all) override { stages_.recall(all); }
  void begin(Sys&, const State<Sys>& state) override { stages_.begin(state), delta_ = dv_ = state.v; }
  void step(Sys& system, State<Sys>& state, const S& h) override {
    static const auto g = CollocationPoints<S>::gauss(s);
    if (!stages_.solve(system, state, h, g))
      throw StepFailed(std::string(collocation_info<s>.name) + " did not converge " + stages_.failure() +
                       ": take a smaller step");
    stages_.sum(g.b, h, delta_, dv_);
    checkFinite(delta_, dv_);
    advance(system, state, delta_, dv_);
    stages_.accept(h);
    ++steps_;
  }

 private:
  ImplicitStages<Sys, s> stages_;
  typename Sys::Tangent delta_, dv_;
  long steps_ = 0;
};

template <System Sys>
using ImplicitMidpoint = Collocation<Sys, 1>;
template <System Sys>
using Gauss6 = Collocation<Sys, 3>;
template <System Sys>
using Gauss12 = Collocation<Sys, 6>;

}  // namespace liecheck::scene
