#pragma once
// The free-flyer's configuration space: poses stored as q = [p; x y z w], shape 7, with increments
// delta = (rho [m], phi [rad]) in the axes of the moving body, shape 6.
//
//   integrate(q, delta)  = T exp(delta)          Q1 = Q0 exp(phi/2),  p1 = p0 + R(Q0) J(phi) rho
//   difference(q0, q1)   = log(T0^-1 T1)         phi = log(Q0* Q1),   rho = J^-1(phi) R(Q0)^T (p1 - p0)
//   d integrate          ARG0 Ad(exp(-delta))    ARG1  J_r(delta)
//   d difference         ARG0 -J_l^-1(delta)     ARG1  J_r^-1(delta)
//
// Tangent vectors of both sides are body-fixed: the Jacobians are 6 x 6 and say how the body-fixed increment
// of the result follows that of the argument (Sola, Deray & Atchuthan 2018, eqs. 41 and 46).
//
// Domain: finite q with ||Q|^2 - 1| <= d. The rotation meant is Q/|Q|; results depend on d as each function
// says. Configurations from outside enter through checkedConfiguration of configuration.hpp.

#include <liecheck/multibody/argument_position.hpp>
#include <liecheck/scalar/compensated.hpp>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/jacobians.hpp>

namespace liecheck {

namespace se3_configuration_detail {

/// Q (3 - |Q|^2) / 2: |Q| = 1 up to 3/8 (|Q|^2 - 1)^2. One Newton step of 1/sqrt: it holds a norm that is
/// known to be 1 up to rounding, and repairs nothing. Shape 2 (cos, sin) or 4 (quaternion).
template <Scalar S, int N>
Eigen::Matrix<S, N, 1> firstOrderNormalize(const Eigen::Matrix<S, N, 1>& u) {
  return u * ((S(3) - u.squaredNorm()) / S(2));
}

/// Q0 Q1 [x y z w], each number rounded once.
template <Scalar S>
Vector4<S> product(const Vector4<S>& a, const Vector4<S>& b) {
  Vector4<S> q;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = CompensatedSum<S>()
               .add_product(a[3], b[i])
               .add_product(a[i], b[3])
               .add_product(a[j], b[k])
               .add_product(S(-a[k]), b[j])
               .value();
  }
  q[3] = CompensatedSum<S>()
             .add_product(a[3], b[3])
             .add_product(S(-a[0]), b[0])
             .add_product(S(-a[1]), b[1])
             .add_product(S(-a[2]), b[2])
             .value();
  return q;
}

/// Q0* Q1 up to sign and up to the factor |Q0||Q1|, its scalar part >= 0 and its vector part accurate
/// relative to itself however near the two rotations are.
///
/// With D = Q1 - s Q0, s = sgn(Q0 . Q1): vec(Q0* Q1) = vec(Q0* D), because vec(Q0* Q0) = 0 exactly. D carries
/// one rounding (none for neighbours), so the vector part errs by 2 eps |D|, and |D| <= sqrt(2) |vec| for
/// unit quaternions. Only the difference of their norms can make D much longer than that: poses a few ulp
/// apart. There the products are summed in twice the digits.
template <Scalar S>
SO3<S> relativeRotation(const Vector4<S>& Q0, const Vector4<S>& Q1) {
  S w = Q0.dot(Q1);
  // Near half a turn the sign of w decides the axis, and its products cancel.
  if (w * w < S(256) * eps<S>() * eps<S>() * Q0.squaredNorm() * Q1.squaredNorm()) w = exact_dot<S, 4>(Q0, Q1);
  Vector4<S> D = Q1;
  if (w < S(0)) {
    D = -D;
    w = -w;
  }
  D -= Q0;
  const Vector3<S> v0 = Q0.template head<3>(), dv = D.template head<3>();
  Vector3<S> v = (Q0[3] * dv - D[3] * v0) - cross<S>(v0, dv);
  if (S(4) * v.squaredNorm() < D.squaredNorm()) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      v[i] = CompensatedSum<S>()
                 .add_product(Q0[3], dv[i])
                 .add_product(S(-v0[i]), D[3])
                 .add_product(S(-v0[j]), dv[k])
                 .add_product(v0[k], dv[j])
                 .value();
    }
  }
  return SO3<S>(v, w);
}

}  // namespace se3_configuration_detail

/// T exp(delta) as [p; x y z w]; Q1 . Q0 >= 0: the quaternion nearer to the one it came from. Pose q [7; m],
/// delta [6; m, rad].
/// Error: rotation 4 eps, translation 4 eps of max(|p1|, |p0|, |rho|), up to half a turn; beyond, the excess
/// rule. Norm: ||Q1|^2 - 1| <= 3 eps + 3/4 d^2; the rotation is that of Q0/|Q0| whatever d.
template <Scalar S>
Vector7<S> integrateSE3(const Vector7<S>& q, const Vector6<S>& delta) {
  const RotationCoefficients<S, Vector3<S>> k(delta.template tail<3>());
  const SO3<S> Q0(Vector4<S>(q.template tail<4>()));
  // Q0 . Q1 = |Q0|^2 cos(theta/2).
  const S sign = k.cosine_half < S(0) ? S(-1) : S(1);
  const SO3<S> Q_01((sign * k.sine_half) * k.axis, sign * k.cosine_half);
  Vector7<S> result;
  result.template head<3>() =
      q.template head<3>() + Q0.act(exp_log_detail::arc<S>(k, delta.template head<3>()));
  result.template tail<4>() = se3_configuration_detail::firstOrderNormalize<S, 4>(
      se3_configuration_detail::product<S>(Q0.to_vector(), Q_01.to_vector()));
  return result;
}

/// (rho, phi) = log(T0^-1 T1) [6; m, rad], |phi| <= pi, the same for Q and -Q; at exactly half a turn either
/// sign. Error 4 eps of |phi|, and 4 eps of max(|rho|, |p1 - p0|), at any distance; it does not depend on
/// |Q0|, |Q1|.
template <Scalar S>
Vector6<S> differenceSE3(const Vector7<S>& q0, const Vector7<S>& q1) {
  const Vector4<S> Q0 = q0.template tail<4>(), Q1 = q1.template tail<4>();
  const exp_log_detail::RotationLogarithm<S> log(se3_configuration_detail::relativeRotation<S>(Q0, Q1));
  const Vector3<S> p_01 = q1.template head<3>() - q0.template head<3>();
  Vector6<S> delta;
  delta << log.arc(SO3<S>(Q0).actInv(p_01)), log.phi;
  return delta;
}

/// How integrate follows q (ARG0: Ad(exp(-delta))) or delta (ARG1: the right Jacobian of exp). 6 x 6; neither
/// depends on q. Error 6 eps of each 3 x 3 block up to half a turn; beyond, the excess rule.
template <Scalar S>
Matrix6<S> dIntegrateSE3(const Vector7<S>& /*q*/, const Vector6<S>& delta, ArgumentPosition argument) {
  const Motion<S> xi(delta);
  return argument == ArgumentPosition::ARG0 ? exp6<S>(-xi).toActionMatrix() : rightJacobian<S>(xi);
}

/// How difference follows q0 (ARG0: -J_l^-1) or q1 (ARG1: J_r^-1). 6 x 6. At exactly half a turn: of the
/// branch that differenceSE3 returns. Error 10 eps of each 3 x 3 block, that of difference included.
template <Scalar S>
Matrix6<S> dDifferenceSE3(const Vector7<S>& q0, const Vector7<S>& q1, ArgumentPosition argument) {
  const Motion<S> xi(differenceSE3<S>(q0, q1));
  if (argument == ArgumentPosition::ARG0) return -leftJacobianInverse<S>(xi);
  return rightJacobianInverse<S>(xi);
}

/// The derivative of the seven stored numbers by a body-fixed increment, at zero increment, 7 x 6:
/// [R, 0; 0, 1/2 (w I + [v])] over [0, -1/2 v^T], R of Q/|Q|, the rest of the stored Q. Error 2 eps.
template <Scalar S>
Eigen::Matrix<S, 7, 6> integrateCoeffWiseJacobianSE3(const Vector7<S>& q) {
  const SO3<S> Q(Vector4<S>(q.template tail<4>()));
  const Vector3<S> v = Q.vec() / S(2);
  Eigen::Matrix<S, 7, 6> J = Eigen::Matrix<S, 7, 6>::Zero();
  J.template topLeftCorner<3, 3>() = Q.matrix();
  J.template block<3, 3>(3, 3) = skew<S>(v);
  J.template block<3, 3>(3, 3).diagonal().setConstant(Q.w() / S(2));
  J.template block<1, 3>(6, 3) = -v.transpose();
  return J;
}

}  // namespace liecheck
