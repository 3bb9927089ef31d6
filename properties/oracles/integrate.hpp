#pragma once
// integrate(q, delta) = T exp(delta) and difference(q0, q1) = log(T0^-1 T1) for free-flyer configurations
// q = (p, Q) [m, -]. Q is stored as x y z w and stands for Q / ||Q||.
//
// Values: quaternions at 100 digits. Second formula: rotation matrices at 50 digits for poses, and the square
// roots of log.hpp for the logarithm. The relative quaternion is formed from the minors a_i b_j - a_j b_i of
// Q0 and Q1, and a second time as Q0* (Q1 -+ Q0), which has the same vector part. Products of stored numbers
// (at most 113 bits) are exact in 334 bits, so that poses 1e-300 apart keep their relative accuracy.
//
// Domain: every finite q with Q != 0, every finite delta.
//
// Errors are below 1e-41: of p of integrate relative to max(||p||, ||p0||, ||increment||), of Q absolute, and
// of rho and phi relative to their norms.

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
  T separation;  ///< ||p1 - p0||, from the exact difference
};
using DifferenceResult = DifferenceValue<Real>;

IntegrateResult integrate(const Vec7<>& q0, const Vec6<>& delta);
DifferenceResult difference(const Vec7<>& q0, const Vec7<>& q1);

}  // namespace liecheck::oracles
