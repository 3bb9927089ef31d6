#pragma once
// Motions of one coordinate.

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

/// The damped spring m q'' + d q' + k (q - q_rest) = f: underdamped, critically damped and overdamped.
///
///   delta = d / 2m,  D = k/m - delta^2:  x = e^(-delta t) (x0 C + (v0 + delta x0) S),  q = x + q_rest + f/k
///   C, S = cos wt, sin(wt)/w for D = w^2 > 0;  1, t for D = 0;  cosh wt, sinh(wt)/w for D = -w^2 < 0
template <class T = Real>
struct DampedSpring {
  T mass, damping, stiffness;  ///< [kg, N s/m, N/m] or [kg m^2, N m s, N m]; stiffness > 0
  T rest;                      ///< q_rest: q at which the spring is unstretched
  T force;                     ///< constant [N] or [N m]
  CoordinateState<T> initial;

  CoordinateState<T> at(const T& t) const {
    const T delta = damping / (2 * mass), D = stiffness / mass - delta * delta;
    const T centre = rest + force / stiffness, x0 = initial.q - centre, v0 = initial.v;
    T C(1), S = t;
    if (D > 0) {
      const T w = sqrt(D);
      sin_cos(T(w * t), S, C);
      S /= w;
    } else if (D < 0) {
      const T w = sqrt(T(-D));
      C = cosh(T(w * t));
      S = sinh(T(w * t)) / w;
    }
    const T decay = exp(T(-delta * t)), b = v0 + delta * x0;
    const T x = decay * (x0 * C + b * S);
    return {centre + x, decay * (b * C - D * x0 * S) - delta * x};
  }
};

/// The pendulum: theta'' = -w^2 sin theta, w^2 = m g c / I_O, theta measured from the stable equilibrium.
///
///   k^2 = sin^2(theta0/2) + (theta0' / 2w)^2, the energy / the energy of the unstable equilibrium
///   k < 1, swings:  sin(theta/2) = k sn(wt + s | k),    theta' = 2 w k cn
///   k > 1, rotates: theta/2 = +-am(k wt + s | 1/k),     theta' = +-2 w k dn
///   k = 1:          sn = tanh, cn = 1/cosh
/// Whittaker (1937), section 44.
template <class T = Real>
struct Pendulum {
  T w;  ///< angular frequency of small oscillations [rad/s], > 0
  CoordinateState<T> initial;

  CoordinateState<T> at(const T& t) const;
};

}  // namespace liecheck::oracles
