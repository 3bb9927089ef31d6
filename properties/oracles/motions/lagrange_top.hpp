#pragma once
// Lagrange's top: a symmetric body with a fixed point O on its axis z and the centre of mass at a height
// c > 0 on this axis. Gravity is along -z of the world. theta is the angle between the two z axes, and
// u = cos theta. The transverse moment I_t is about O. omega_z of the body and L_z in the world are constant:
//
//   a = I_z omega_z / I_t,  b = L_z / I_t,  beta = 2 m g c / I_t,  alpha = |omega_xy|^2 + beta u0
//   u'^2 = f(u) = (1 - u^2)(alpha - beta u) - (b - a u)^2,  roots u1 <= u2 <= 1 < u3
//   u = u1 + (u2 - u1) sn^2 s,  s = lambda t + s0,  lambda = sqrt(beta (u3 - u1)) / 2,
//   k^2 = (u2 - u1)/(u3 - u1)
//   phi' = (b - a u)/(1 - u^2) = [(b - a)/(1 - u) + (b + a)/(1 + u)] / 2    (precession about the world's z)
//   psi' = omega_z - u phi'   (spin)
// Each fraction gives an integral of the third kind, as 1 -+ u = (1 -+ u1)(1 - n sn^2),
// n = +-(u2 - u1)/(1 -+ u1). Steady precession has u1 = u2. A sleeping top has u = 1 at all times. Whittaker
// (1937), section 71; Goldstein, section 5.7.

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

template <class T = Real>
class LagrangeTop {
 public:
  /// transverse: I_t about O; axial: I_z [kg m^2]; torque: m g c > 0 [N m]. Throws std::domain_error if the
  /// axis passes through the vertical (b = +-a) without staying there: the precession is then undefined.
  LagrangeTop(const T& transverse, const T& axial, const T& torque, const AttitudeState<T>& initial);

  AttitudeState<T> at(const T& t) const;

  /// The smallest and the largest cos theta.
  const T& lowest() const { return u1_; }
  const T& highest() const { return u2_; }

 private:
  /// int_0^s ds / (1 - sign u)
  T fraction(int sign, const T& am) const;
  void solve_cubic(const T& alpha, const T& beta, const T& u0, const T& rate);

  AttitudeState<T> initial_;
  bool sleeping_ = false;
  T a_, b_, u1_, u2_, u3_, k_, lambda_, s0_, upper0_, lower0_, spin_, phi0_, psi0_;
};

}  // namespace liecheck::oracles
