#pragma once
// The damped spring m q'' + d q' + k (q - q_rest) = f: underdamped, critically damped and overdamped.
//
//   delta = d / 2m,  D = k/m - delta^2:   x = e^(-delta t) (x0 C + (v0 + delta x0) S),   q = x + q_rest + f/k
//   C, S = cos wt, sin(wt)/w for D = w^2 > 0;  1, t for D = 0;  cosh wt, sinh(wt)/w for D = -w^2 < 0

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

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

}  // namespace liecheck::oracles
