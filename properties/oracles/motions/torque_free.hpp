#pragma once
// Torque-free bodies whose motion needs no elliptic functions.

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

/// Constant twist: the body rotates about a principal axis, or about any axis if its moments are equal. Then
/// omega x I omega = 0 and R = R0 exp([omega] t).
template <class T>
AttitudeState<T> constant_twist(const AttitudeState<T>& initial, const T& t) {
  return {quaternion_product(initial.Q, rotation_by<T>(t * initial.omega)), initial.omega};
}

/// Two equal principal moments I_t, and the moment I_a about the axis a (unit, in B).
///   omega = L/I_t + (1 - I_a/I_t) (a . omega) a, so that
///   R(t) = exp([L_W / I_t] t) R0 exp([a] Omega t),   Omega = (1 - I_a/I_t) (a . omega0), constant
///   omega(t) = exp(-[a] Omega t) omega0
/// Landau and Lifshitz, Mechanics, section 33 (regular precession).
template <class T = Real>
struct AxisymmetricBody {
  T transverse, axial;  ///< I_t, I_a [kg m^2]
  Vec3<T> axis;         ///< unit, in the axes of B
  AttitudeState<T> initial;

  AttitudeState<T> at(const T& t) const {
    const T spin = dot(axis, initial.omega), rate = (1 - axial / transverse) * spin;
    const Vec3<T> L_over_It = rotate(initial.Q, initial.omega + T((axial / transverse - 1) * spin) * axis);
    const Quaternion<T> about_axis = rotation_by<T>(T(rate * t) * axis);
    return {quaternion_product(rotation_by<T>(t * L_over_It), quaternion_product(initial.Q, about_axis)),
            rotate(about_axis, initial.omega, true)};
  }
};

}  // namespace liecheck::oracles
