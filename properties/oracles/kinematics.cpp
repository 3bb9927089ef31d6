#include <oracles/kinematics.hpp>

#include <oracles/closed_forms.hpp>

namespace liecheck::oracles {
namespace {

using T = Real100;

Quaternion<T> attitude(const Vec7<>& q) {
  return normalized(quaternion_of(cast<T>(q)));
}

/// (integrate(q, t v) - integrate(q, -t v)) / (2 t) with q's position at the origin.
struct Difference {
  Vec3<T> p_dot;
  Quaternion<T> Q_dot;
  Mat3<T> R_dot;
};
Difference difference_quotient(const Quaternion<T>& Q, const Vec6<T>& v) {
  const T w = norm(tail3(v));
  const T t = ldexp(T(1), -110) / (w == 0 ? T(1) : w), by_2t = 1 / (2 * t);
  const Vec7<T> q{{T(0), T(0), T(0), Q[0], Q[1], Q[2], Q[3]}};
  const UnitPose<T> a = closed_integrate(q, t * v), b = closed_integrate(q, T(-t) * v);
  return {by_2t * (a.p - b.p), by_2t * (a.Q - b.Q), by_2t * (rotation_matrix(a.Q) - rotation_matrix(b.Q))};
}

}  // namespace

RateResult configuration_rate(const Vec7<>& q, const Vec6<>& v) {
  const Quaternion<T> Q = attitude(q);
  const Vec6<T> v100 = cast<T>(v);
  const Vec3<T> w = tail3(v100);
  const Mat3<T> R = rotation_matrix(Q);
  const Vec3<T> p_dot = R * head3(v100);
  const Quaternion<T> Q_dot = T(T(1) / 2) * quaternion_product(Q, Quaternion<T>{{w[0], w[1], w[2], T(0)}});
  const Mat3<T> R_dot = R * hat(w);
  const Difference d = difference_quotient(Q, v100);
  return {cast<Real>(p_dot), cast<Real>(Q_dot), cast<Real>(R_dot),
          agree(d.p_dot, p_dot) && agree(d.Q_dot, Q_dot) && agree(d.R_dot, R_dot)};
}

CoefficientJacobianResult integrate_coefficient_jacobian(const Vec7<>& q) {
  const Quaternion<T> Q = attitude(q);
  const Mat3<T> R = rotation_matrix(Q);
  Mat<7, 6, T> J = zeros<7, 6, T>();
  const Mat3<T> V = hat(head3(Q));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      J(i, j) = R(i, j);
      J(3 + i, 3 + j) = (V(i, j) + (i == j ? Q[3] : T(0))) / 2;
      J(6, 3 + j) = -Q[j] / 2;
    }
  bool resolved = true;
  for (int j = 0; j < 6; ++j) {
    Vec6<T> e = zero_vector<6, T>();
    e[j] = 1;
    const Difference d = difference_quotient(Q, e);
    const Vec3<T> p{{J(0, j), J(1, j), J(2, j)}};
    const Quaternion<T> Q_column{{J(3, j), J(4, j), J(5, j), J(6, j)}};
    resolved = resolved && agree(d.p_dot, p) && agree(d.Q_dot, Q_column);
  }
  return {cast<Real>(J), resolved};
}

}  // namespace liecheck::oracles
