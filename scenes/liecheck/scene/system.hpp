#pragma once
// System: configurations on a Lie group, velocities in its tangent space, and accelerations.
//
//   q(t) = integrate(q0, delta),  delta_dot = J_r^-1(delta) v,  v_dot = acceleration(t, q, v)
//
// Integrators use a robot only through this interface. The two systems are LoneBody (fixed sizes) and Tree.

#include <liecheck/scene/accumulate.hpp>
#include <utility>

namespace liecheck::scene {

/// Every function writes into a vector that already has the right size, so that a step does not allocate.
/// - acceleration: v_dot [nv], the law of motion with all effects;
/// - readsConfiguration: whether the acceleration depends on q; if not, the q of a stage is not computed;
/// - integrate: q exp(delta) of every joint;
/// - accumulate: integrate in place, with compensated rounding errors (accumulate.hpp);
/// - tangentRate: J_r^-1(delta) v;
/// - load: evaluates the forces of all effects alone;
/// - keep: the forces of the last load(), of this state, serve the next evaluation, if it is of the same state;
/// - pieces: the times at which forces are known to jump, and the piece that applies (pieces.hpp);
/// - switches: the functions of the state that select branches of forces (switches.hpp);
/// - fromModel, toModel: the configuration and velocity of the model as a state of the system, and back;
/// - difference: the increment delta with q1 = q0 exp(delta);
/// - coefficientRate, normalize: rate and normalisation of the stored numbers of q, for quaternion_rk4.
template <class X>
concept System = Scalar<typename X::Scalar> &&
    requires(X& x, const X& c, const typename X::Scalar& t, const typename X::Configuration& q,
             const typename X::Tangent& v, typename X::Configuration& q_out, typename X::Tangent& v_out) {
  { c.nv() } -> std::same_as<int>;
  x.acceleration(t, q, v, v_out);
  { c.readsConfiguration() } -> std::same_as<bool>;
  c.integrate(q, v, q_out);
  c.accumulate(q_out, v_out, v);
  c.tangentRate(v, v, v_out);
  x.load(t, q, v);
  x.keep(t, q, v);
  x.pieces();
  x.switches();
  c.coefficientRate(q, v, q_out);
  c.normalize(q_out);
  { c.difference(q, q) } -> std::convertible_to<typename X::Tangent>;
  typename X::Path;
};

/// The state at one time: t [s], q and v in the coordinates of the system, what the system knows of the motion in closed
/// form, and the compensated rounding errors of q and v (zero unless a method accumulates them).
template <class System>
struct State {
  using S = typename System::Scalar;
  S t = S(0);
  typename System::Configuration q;
  typename System::Tangent v, q_low, v_low;
  [[no_unique_address]] typename System::Path path;
  bool compensated = true;  ///< whether a method sums increments with compensation (accumulate.hpp)

  /// The state of the model, q0 [nq] and v0 [nv], at the time 0.
  State(const System& system, const VectorX<S>& q0, const VectorX<S>& v0) {
    system.fromModel(q0, v0, *this);
    q_low = v_low = v;
    q_low.setZero(), v_low.setZero();
  }
  /// Chooses whether sums are compensated from now on. Plain ones keep no rounding errors of dynamic size.
  void compensate(bool chosen) {
    compensated = chosen;
    if constexpr (System::Tangent::SizeAtCompileTime == Eigen::Dynamic)
      for (auto* low : {&q_low, &v_low}) *low = System::Tangent::Zero(chosen ? v.size() : 0);
  }
};

/// The state at which the forces of a system were last summed, if a step may begin there with the same sums: the end of
/// a step at which event_steps.hpp has looked for events. It serves one evaluation, of exactly this state.
template <class S, class Configuration, class Tangent>
class Kept {
 public:
  void keep(const S& t, const Configuration& q, const Tangent& v) { kept_ = true, t_ = t, q_ = q, v_ = v; }
  void drop() { kept_ = false; }
  bool take(const S& t, const Configuration& q, const Tangent& v) {
    return std::exchange(kept_, false) && t == t_ && q == q_ && v == v_;
  }

 private:
  bool kept_ = false;
  S t_;
  Configuration q_;
  Tangent v_;
};

/// q := q exp(delta), with compensation if the state has it.
template <class Sys>
[[gnu::always_inline]] inline void advance(const Sys& system, State<Sys>& state,
                                           const typename Sys::Tangent& delta) {
  if (state.compensated)
    system.accumulate(state.q, state.q_low, delta);
  else
    system.integrate(state.q, delta, state.q);
}
/// Also v := v + dv.
template <class Sys>
[[gnu::always_inline]] inline void advance(const Sys& system, State<Sys>& state,
                                           const typename Sys::Tangent& delta,
                                           const typename Sys::Tangent& dv) {
  advance(system, state, delta);
  if (state.compensated)
    accumulateAll(state.v, state.v_low, dv);
  else
    state.v += dv;
}

}  // namespace liecheck::scene
