#pragma once
// System: configurations on a Lie group, velocities in its tangent space, and accelerations.
//
//   q(t) = integrate(q0, delta),  delta_dot = J_r^-1(delta) v,  v_dot = acceleration(t, q, v)
//
// Integrators use a robot only through this interface. The two systems are LoneBody (fixed sizes) and Tree.

#include <liecheck/spatial/types.hpp>

namespace liecheck::scene {

/// Every function writes into a vector that already has the right size, so that a step does not allocate.
/// - acceleration: v_dot [nv], the law of motion with all effects;
/// - readsConfiguration: whether the acceleration depends on q; if not, the q of a stage is not computed;
/// - integrate: q exp(delta) of every joint;
/// - accumulate: integrate in place, with compensated rounding errors (accumulate.hpp);
/// - tangentRate: J_r^-1(delta) v;
/// - load: evaluates the forces of all effects alone;
/// - pieces: the times at which forces are known to jump, and the piece that applies (pieces.hpp);
/// - switches: the functions of the state that select branches of forces (switches.hpp);
/// - coefficientRate, normalize: rate and normalisation of the stored numbers of q, for quaternion_rk4.
template <class X>
concept System = Scalar<typename X::Scalar> &&
    requires(X& x, const X& c, const typename X::Scalar& t, const typename X::Configuration& q,
             const typename X::Tangent& v, typename X::Configuration& q_out, typename X::Tangent& v_out) {
  { c.nq() } -> std::same_as<int>;
  { c.nv() } -> std::same_as<int>;
  x.acceleration(t, q, v, v_out);
  { c.readsConfiguration() } -> std::same_as<bool>;
  c.integrate(q, v, q_out);
  c.accumulate(q_out, v_out, v);
  c.tangentRate(v, v, v_out);
  x.load(t, q, v);
  x.pieces();
  x.switches();
  c.coefficientRate(q, v, q_out);
  c.normalize(q_out);
};

/// The state at one time: t [s], q [nq], v [nv], and the compensated rounding errors of q and v (zero unless
/// a method accumulates them).
template <class System>
struct State {
  using S = typename System::Scalar;
  S t = S(0);
  typename System::Configuration q;
  typename System::Tangent v, q_low, v_low;

  State(const System& system, const typename System::Configuration& q0, const typename System::Tangent& v0)
      : q(q0), v(v0), q_low(v0), v_low(v0) {
    static_cast<void>(system);
    q_low.setZero(), v_low.setZero();
  }
};

}  // namespace liecheck::scene
