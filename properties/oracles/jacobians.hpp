#pragma once
// Left and right Jacobians of exp, their inverses, and the derivatives of integrate and difference.
//
// To first order exp(xi + d) = exp(J_l d) exp(xi) = exp(xi) exp(J_r d), and J_r(xi) = J_l(-xi). On SE(3) both
// Jacobians are [[J, C], [0, J]], with J of SO(3) and the coupling block C [m], which is linear in rho.
//
// Three formulas:
//   1. closed form in dual numbers at 100 digits (closed_forms.hpp): the value of left_* and right_*;
//   2. phi1(ad xi), or Ad for d_integrate_arg0, by scaling and squaring, 50 or 100 digits: confirms 1 and 3;
//   3. central differences of the definition at 100 digits: the value of d_integrate_*, d_difference_*.
// The inverses have closed forms too, and their product with phi1 confirms them. They are singular at
// theta = 2 pi k and are resolved if |theta - 2 pi k| > 1e-40.
//
// Error of the differences: lengths are scaled so that ||rho|| = 1, and then every third derivative is of
// order one. The error is h^2 + 2^(20 + log2 theta - 334) / h. The step h = 2^-110 gives a truncation error
// of 1e-66, and a rounding error of 1e-61 at theta = 100 and 1e-55 at theta = 1e8.
//
// Domain: theta <= 1e24 (left_*, right_*), <= 1e8 (the differences).
// Error: below 1e-41 relative to the norm of each block.
//
// Sources: Chirikjian 2012, eq. 10.86; Sola, Deray, Atchuthan 2018, appendices B and D; Barfoot 2017,
// eq. 7.86; Iserles et al. 2000, section 2 (phi1 = dexp).

#include <oracles/agreement.hpp>

namespace liecheck::oracles {

template <class T>
struct Jacobian3Value {
  Mat3<T> J;
  bool resolved = false;
};
using Jacobian3Result = Jacobian3Value<Real>;

/// [[J, C], [0, J]]
template <class T>
struct Jacobian6Value {
  Mat3<T> J, C;
  bool resolved = false;

  Mat6<T> matrix() const { return assemble(J, C, zeros<3, 3, T>(), J); }
};
using Jacobian6Result = Jacobian6Value<Real>;

Jacobian3Result left_jacobian_so3(const Vec3<>& phi);
Jacobian3Result left_jacobian_so3_inverse(const Vec3<>& phi);

Jacobian6Result left_jacobian_se3(const Vec6<>& xi);
Jacobian6Result right_jacobian_se3(const Vec6<>& xi);
Jacobian6Result left_jacobian_se3_inverse(const Vec6<>& xi);
Jacobian6Result right_jacobian_se3_inverse(const Vec6<>& xi);

/// ARG0 = d/dh difference(integrate(q, delta), integrate(integrate(q, h e_i), delta)) = Ad(exp(-delta)).
Jacobian6Result d_integrate_arg0(const Vec7<>& q, const Vec6<>& delta);
/// ARG1 = d/dh difference(integrate(q, delta), integrate(q, delta + h e_i)) = J_r(delta).
Jacobian6Result d_integrate_arg1(const Vec7<>& q, const Vec6<>& delta);

/// At theta = pi difference has two values with opposite axes, and each value has a different derivative.
/// `other` selects the derivative of LogResult::other.
enum class Branch { value, other };

/// ARG0 = d/dh difference(integrate(q0, h e_i), q1) = -J_l^-1(delta), on the branch of the central value.
Jacobian6Result d_difference_arg0(const Vec7<>& q0, const Vec7<>& q1, Branch branch = Branch::value);
/// ARG1 = d/dh difference(q0, integrate(q1, h e_i)) = J_r^-1(delta), on the branch of the central value.
Jacobian6Result d_difference_arg1(const Vec7<>& q0, const Vec7<>& q1, Branch branch = Branch::value);

}  // namespace liecheck::oracles
