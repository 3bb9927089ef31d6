#pragma once
// The equations of motion that the closed forms solve, for reference solutions and tests:
//   Q' = Q (omega, 0) / 2,   I omega' = (I omega) x omega + n_B

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

/// The time derivative of (x y z w, omega) of a body that rotates about a fixed point or its centre of mass.
/// The constant force force_W [N] acts at at_B [m] from that point.
template <class T = Real>
struct RigidBodyEquations {
  Mat3<T> inertia, inverse_inertia;  ///< about that point [kg m^2]
  Vec3<T> force_W = zero_vector<3, T>(), at_B = zero_vector<3, T>();

  Vec7<T> operator()(const Vec7<T>& y) const {
    const Quaternion<T> Q{{y[0], y[1], y[2], y[3]}};
    const Vec3<T> w{{y[4], y[5], y[6]}};
    const Quaternion<T> rate = quaternion_product(Q, Quaternion<T>{{w[0], w[1], w[2], T(0)}});
    Vec3<T> torque = cross(inertia * w, w);
    if (squared_norm(force_W) != 0) torque = torque + cross(at_B, rotate(Q, force_W, true));
    const Vec3<T> dw = inverse_inertia * torque;
    return {{rate[0] / 2, rate[1] / 2, rate[2] / 2, rate[3] / 2, dw[0], dw[1], dw[2]}};
  }
};

template <class T>
Vec7<T> numbers_of(const AttitudeState<T>& s) {
  return {{s.Q[0], s.Q[1], s.Q[2], s.Q[3], s.omega[0], s.omega[1], s.omega[2]}};
}
template <class T>
AttitudeState<T> state_of(const Vec7<T>& y) {
  return {{{y[0], y[1], y[2], y[3]}}, {{y[4], y[5], y[6]}}};
}

}  // namespace liecheck::oracles
