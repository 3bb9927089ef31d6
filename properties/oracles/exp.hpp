#pragma once
// exp of a twist xi = (rho, phi) [m, rad]:  exp [[phi], rho; 0, 0] = [R, p; 0, 1].
//
// Value: Rodrigues' closed form in half angles at 100 digits. Second formula: the power series of the 4x4
// matrix with scaling and squaring, at 50 digits. It uses 100 digits if 50 are too few (theta > 2^20, or p
// near zero because theta is near 2 pi k).
//
// Domain: every finite xi. Beyond theta = 2^80 both formulas use one function to reduce theta modulo 2 pi,
// but at different precisions.
//
// Errors: of R - I relative to min(1, theta), of p relative to ||p||, and for theta <= pi of the vector part
// of Q relative to its norm. Each is 1e-50, the rounding of the result; the second formula confirms 1e-41.
//
// Sources: Rodrigues 1840; Lynch, Park 2017, eqs. 3.51 and 3.88; Higham 2008, section 10.3.

#include <oracles/agreement.hpp>
#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

template <class T>
struct ExpValue {
  Quaternion<T> Q;  ///< (sin(theta/2) n, cos(theta/2)): continuous in xi, w < 0 for pi < theta < 3 pi
  Vec3<T> p;
  T theta;
  bool resolved = false;
};
struct ExpResult : ExpValue<Real> {
  Mat3<> R;
};

ExpResult exp_se3(const Vec6<Real>& xi);

/// exp of (0, phi): the result has p = 0.
ExpResult exp_so3(const Vec3<Real>& phi);

}  // namespace liecheck::oracles
