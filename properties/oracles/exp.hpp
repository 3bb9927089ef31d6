#pragma once
// exp of a twist xi = (rho, phi) [m, rad]:  exp [[phi], rho; 0, 0] = [R, p; 0, 1].
//
// Value: Rodrigues' closed form over half angles at 100 digits. Confirmed by scaling and squaring of the
// power series of the 4x4 matrix at 50 digits, at 100 where 50 do not reach (theta > 2^20, or p near zero
// because theta is near 2 pi k).
//
// Domain: every finite xi. Beyond theta = 2^80 both formulas reduce theta modulo 2 pi by the same function, at two
// precisions.
//
// Error: R - I relative to min(1, theta), p relative to ||p||, the vector part of Q relative to itself for
// theta <= pi: each below 1e-41 as confirmed, 1e-50 (the rounding of the result) as computed.
//
// Sources: Rodrigues 1840; Lynch, Park 2017, eqs. 3.51 and 3.88; Higham 2008, section 10.3.

#include <oracles/agreement.hpp>
#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

template <class T>
struct ExpValue {
  Quaternion<T> Q;  ///< (sin(theta/2) n, cos(theta/2)): continuous in xi, negative w from theta = pi to 3 pi
  Vec3<T> p;
  T theta;
  bool resolved = false;
};
struct ExpResult : ExpValue<Real> {
  Mat3<> R;
};

ExpResult exp_se3(const Vec6<Real>& xi);

/// p is zero.
ExpResult exp_so3(const Vec3<Real>& phi);

}  // namespace liecheck::oracles
