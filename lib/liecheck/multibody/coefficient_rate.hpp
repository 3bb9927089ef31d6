#pragma once
// The stored numbers of a free-flyer's configuration q = [p; x y z w] [7] as they change with its body-fixed velocity
// V = (u [m/s], omega [rad/s]):
//
//   q_dot = N(q) V:   p_dot = R(Q) u,   Q_dot = 1/2 Q (omega, 0)
//   V = N(q)^+ q_dot: u = R(Q)^T p_dot, omega = 2 (Q* Q_dot)_xyz / |Q|^2
//
// N is integrateCoeffWiseJacobianSE3 (se3_configuration.hpp), N^+ = (N^T N)^-1 N^T its pseudo-inverse: N^+ N = I, and
// a part of Q_dot along Q, which only changes the norm, is ignored. R(Q) is that of Q/|Q|, Q of any finite norm but
// zero. Source: Sola 2017 (arXiv 1711.02508), eqs. 197-201; Featherstone 2008, eq. 4.13.

#include <liecheck/spatial/motion.hpp>
#include <liecheck/spatial/so3.hpp>

namespace liecheck {

/// q_dot [7, m/s and 1/s]. Error 1 eps of |u|, and 3 eps of |Q_dot|. Throws std::invalid_argument if Q = 0.
template <Scalar S>
Vector7<S> coefficientRate(const Vector7<S>& q, const Motion<S>& V) {
  const SO3<S> Q(Vector4<S>(q.template tail<4>()));
  Vector7<S> q_dot;
  q_dot << Q.act(V.linear()), (Q * SO3<S>(Vector3<S>(V.angular() / S(2)), S(0))).to_vector();
  return q_dot;
}

/// V of q_dot [7]. Error 1 eps of |p_dot|, and 5 eps of 2 |Q_dot|/|Q|. Throws std::invalid_argument if Q = 0.
template <Scalar S>
Motion<S> velocityOfCoefficientRate(const Vector7<S>& q, const Vector7<S>& q_dot) {
  const SO3<S> Q(Vector4<S>(q.template tail<4>())), rate(Vector4<S>(q_dot.template tail<4>()));
  const Vector3<S> u = Q.actInv(Vector3<S>(q_dot.template head<3>()));
  return Motion<S>(u, Vector3<S>((Q.inverse() * rate).vec() * (S(2) / Q.squaredNorm())));
}

}  // namespace liecheck
