#pragma once
// Closed forms in the half angle, at any precision. At 100 digits they give the values of the oracles, which
// compare them with a second formula. At 50 digits their derivatives give the condition numbers.
//
// With theta = ||phi||, n = phi / theta, s = sin(theta/2), c = cos(theta/2):
//   exp     Q = (s n, c),   p = a + (2 s c / theta) (rho - a) + (2 s^2 / theta) n x rho,
//           a = n (phi.rho) / theta
//   log     theta = 2 atan2(||v||, |w|),   rho = p - phi x p / 2 + (1 - theta c / (2 s)) n x (n x p)
//   J_l     J = I + c2 [phi] + c3 [phi]^2,   c_k(theta^2) = sum_j (-theta^2)^j / (2j + k)!,
//           the dual number phi + e rho in place of phi gives the coupling block
//           C = c2 [rho] + c3 ([phi][rho] + [rho][phi])
//             + (phi.rho) ((2 c4 - c3) [phi] + (3 c5 - c4) [phi]^2)
//   J_l^-1  J = I - [phi]/2 + g [phi]^2,   g(theta^2) = (1 - theta c / (2 s)) / theta^2,
//           C = -[rho]/2 + g ([phi][rho] + [rho][phi]) + 2 g' (phi.rho) [phi]^2
//           for theta < 1, J_l is inverted by cofactors, or in balls g = (c3 - 2 c4) / (2 c2)
//
// At 100 digits each block has 90 correct digits relative to its norm, down to theta = 0. If terms of size
// one cancel, the absolute error is one rounding. For theta < 1 the c_k come from their series. At an angle
// of 10^n or at a distance d = 10^-n from 2 pi k, 2 n digits are lost (at theta = 1e8, C has 98 - 16 digits).
// tests/properties/enclosure_test.cpp requires errors below 1e-98 (theta / d)^2.
//
// Domain: exp for every finite angle; the Jacobians for theta <= 1e24. Beyond theta = 2^42 at 50 digits and
// 2^83 at 100 digits, exp reduces theta modulo 2 pi with as many bits as necessary.
//
// Sources: Rodrigues 1840; Sola, Deray, Atchuthan 2018 (arXiv 1812.01537), appendices B and D, rewritten;
// Barfoot 2017, eq. 7.86 (C).

#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

/// A pose; Q is unit.
template <class T>
struct UnitPose {
  Quaternion<T> Q;
  Vec3<T> p;
};

/// theta = 2 pi k + reduced with |reduced| <= pi; s = sin(theta/2), c = cos(theta/2); n is the unit axis, or
/// zero if theta is zero.
template <class T>
struct HalfAngle {
  T theta, reduced, s, c;
  Vec3<T> n;
  bool large = false;  ///< whether theta was reduced; otherwise `reduced` equals theta
  T inverse{};         ///< 1 / theta; only in ball arithmetic, for theta > 0
  /// x / theta. Ball arithmetic multiplies by `inverse`, with a third of the cost and one more rounding.
  T over_theta(const T& x) const {
    if constexpr (BallNumber<T>)
      return x * inverse;
    else
      return x / theta;
  }
};

/// [[J, C], [0, J]]
template <class T>
struct JacobianBlocks {
  Mat3<T> J, C;
};

/// T0^-1 T1 as p and a quaternion Q that is not normalised. p1_minus_p0 is in the parent axes.
template <class T>
struct RelativePose {
  Quaternion<T> Q;
  Vec3<T> p, p1_minus_p0;
};

/// theta = ||phi||.
template <class T>
HalfAngle<T> half_angle(const Vec3<T>& phi, const T& theta);
template <class T>
HalfAngle<T> half_angle(const Vec3<T>& phi) {
  return half_angle(phi, norm(phi));
}

/// theta = ||phi||.
template <class T>
UnitPose<T> closed_exp(const Vec6<T>& xi, const T& theta);
template <class T>
UnitPose<T> closed_exp(const Vec6<T>& xi) {
  return closed_exp(xi, norm(tail3(xi)));
}

/// log of the pose (Q / ||Q||, p): (rho, phi) with ||phi|| <= pi. With `as_signed` Q is never replaced by -Q:
/// theta/2 in [0, pi] is the angle of Q itself, so that the result is continuous at theta = pi.
template <class T>
Vec6<T> closed_log(const Quaternion<T>& Q, const Vec3<T>& p, bool as_signed = false);

/// T0 exp(delta), where q0 = (p, Q) is the pose (Q / ||Q||, p).
template <class T>
UnitPose<T> closed_integrate(const Vec7<T>& q0, const Vec6<T>& delta);

template <class T>
RelativePose<T> relative_pose(const Vec7<T>& q0, const Vec7<T>& q1);

template <class T>
Vec6<T> closed_difference(const Vec7<T>& q0, const Vec7<T>& q1);

template <class T>
JacobianBlocks<T> closed_left_jacobian(const Vec6<T>& xi);

/// Accurate relative to its norm, also near theta = 2 pi k, where the norm grows without bound.
template <class T>
JacobianBlocks<T> closed_left_jacobian_inverse(const Vec6<T>& xi);

}  // namespace liecheck::oracles
