#pragma once
// integrate(q, delta) = T exp(delta) and difference(q0, q1) = log(T0^-1 T1) of free-flyer configurations
// q = (p, Q) [m, -], Q stored x y z w and meaning Q / ||Q||.
//
// Values at 100 digits with quaternions, confirmed at 50 with rotation matrices (integrate) and by the square
// roots of log.hpp. The relative quaternion is formed twice: from the minors a_i b_j - a_j b_i of Q0 and Q1,
// and as Q0* (Q1 -+ Q0) / ||.||; products of stored numbers (113 bits at most) are exact in 334 bits, so that
// poses 1e-300 apart keep their relative accuracy.
//
// Domain: every finite q with Q != 0, every finite delta.
//
// Error: p of integrate relative to max(||p||, ||p0||, ||increment||), Q absolutely, rho relative to ||rho||,
// phi to ||phi||: below 1e-41.

#include <oracles/log.hpp>

namespace liecheck::oracles {

template <class T>
struct IntegrateValue {
  Quaternion<T> Q;  ///< Q0 times the continuous quaternion of exp(delta)
  Vec3<T> p;
  T theta;           ///< ||phi|| of the increment
  T increment_norm;  ///< norm of the increment of p
  bool resolved = false;
};
using IntegrateResult = IntegrateValue<Real>;

template <class T>
struct DifferenceValue : LogValue<T> {
  T separation;  ///< ||p1 - p0||, exactly subtracted
};
using DifferenceResult = DifferenceValue<Real>;

IntegrateResult integrate(const Vec7<>& q0, const Vec6<>& delta);
DifferenceResult difference(const Vec7<>& q0, const Vec7<>& q1);

}  // namespace liecheck::oracles
