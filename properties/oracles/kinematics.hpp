#pragma once
// The time derivative of a free-flyer configuration q = (p, Q) with body velocity v = (u, w) [m/s, rad/s]:
//   p_dot = R u,   R_dot = R [w],   Q_dot = Q (w, 0) / 2,   with Q normalised and R its matrix.
//
// Value: these products at 100 digits. Second formula: central differences of integrate(q, t v) at t = 0 with
// ||w|| t = 2^-110, at 100 digits (truncation error 2^-220, rounding error 2^-220; see jacobians.hpp).
//
// Domain: all finite q with Q != 0, all finite v. Error: below 1e-41 relative to each norm.
//
// Source: Sola 2017 (arXiv 1711.02508), section 4.

#include <oracles/agreement.hpp>
#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

template <class T>
struct RateValue {
  Vec3<T> p_dot;
  Quaternion<T> Q_dot;
  Mat3<T> R_dot;
  bool resolved = false;
};
using RateResult = RateValue<Real>;

RateResult configuration_rate(const Vec7<>& q, const Vec6<>& v);

template <class T>
struct CoefficientJacobianValue {
  Mat<7, 6, T> value;
  bool resolved = false;
};
using CoefficientJacobianResult = CoefficientJacobianValue<Real>;

/// d integrate(q, delta) / d delta at delta = 0: [[R, 0], [0, (Qw I + [Qxyz]) / 2], [0, -Qxyz^T / 2]].
CoefficientJacobianResult integrate_coefficient_jacobian(const Vec7<>& q);

}  // namespace liecheck::oracles
