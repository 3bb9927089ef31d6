#pragma once
// SE(2): poses in the plane, stored as q = [x y, cos sin] [4, m and 1], with increments delta = (u_x, u_y [m], omega
// [rad]) [3] in the axes of the moving body. It is the configuration space of the planar joint (joints/planar.hpp),
// which has integrate, difference and their derivatives. (cos, sin) of any finite norm but zero stand for their angle.
//
//   exp(delta) = (V(omega) (u_x, u_y), cos omega, sin omega),  V(omega) = [sin omega, cos omega - 1; 1 - cos omega,
//   sin omega] / omega;  log is its inverse with |omega| <= pi
//
// Source: Sola, Deray & Atchuthan 2018, appendix A.

#include <liecheck/multibody/joints/planar.hpp>

namespace liecheck::se2 {

/// exp(delta). Error 2 eps of the rotation, 4 eps of |p|.
template <Scalar S>
Vector4<S> exp(const Vector3<S>& delta) {
  return Planar<S>::integrate(Planar<S>::neutral(), delta);
}
/// delta with exp(delta) = q and |omega| <= pi. Error 3 eps of omega, 5 eps of |(u_x, u_y)|.
template <Scalar S>
Vector3<S> log(const Vector4<S>& q) {
  return Planar<S>::difference(Planar<S>::neutral(), q);
}
/// T_AC = T_AB T_BC: p = p_AB + R_AB p_BC, and the sum of the angles, with |(cos, sin)| = 1. Error 3 eps of the
/// rotation, 4 eps of |p_AB| + |p_BC|. Throws std::invalid_argument if a pair (cos, sin) is zero.
template <Scalar S>
Vector4<S> compose(const Vector4<S>& AB, const Vector4<S>& BC) {
  using Vector2 = Eigen::Matrix<S, 2, 1>;
  const Vector2 a = normalizedUnit<S, 2>(Vector2(AB.template tail<2>())),
                b = normalizedUnit<S, 2>(Vector2(BC.template tail<2>())),
                r = normalizedUnit<S, 2>(Vector2(a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]));
  return Vector4<S>(AB[0] + (a[0] * BC[0] - a[1] * BC[1]), AB[1] + (a[1] * BC[0] + a[0] * BC[1]), r[0], r[1]);
}

}  // namespace liecheck::se2
