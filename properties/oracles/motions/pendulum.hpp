#pragma once
// The pendulum: theta'' = -w^2 sin theta, w^2 = m g c / I_O, theta measured from the stable equilibrium.
//
//   k^2 = sin^2(theta0/2) + (theta0' / 2w)^2, the energy / the energy of the unstable equilibrium
//   k < 1, swings:  sin(theta/2) = k sn(wt + s | k),    theta' = 2 w k cn
//   k > 1, rotates: theta/2 = +-am(k wt + s | 1/k),     theta' = +-2 w k dn
//   k = 1:          sn = tanh, cn = 1/cosh
// Whittaker (1937), section 44.

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

template <class T = Real>
struct Pendulum {
  T w;  ///< angular frequency of small oscillations [rad/s], > 0
  CoordinateState<T> initial;

  CoordinateState<T> at(const T& t) const;
};

}  // namespace liecheck::oracles
