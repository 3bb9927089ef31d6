#pragma once
// Exponential and logarithm of SO(3) and SE(3).
//
//   R = exp [phi],  p = J(phi) rho = c1 rho + c2 phi x rho + c3 phi (phi . rho),  J = I + c2 [phi] + c3 [phi]^2
//   (Murray, Li & Sastry 1994, eq. 2.36), with the Stumpff coefficients of stumpff.hpp.
//
// Domain: every finite rotation vector and every rotation. Up to half a turn the stated bounds are absolute
// for rotations and relative for vectors, down to subnormal angles; beyond half a turn they are multiplied by
// the condition number (excess rule). exp has no branch below pi. log returns |phi| <= pi; at exactly pi
// either sign of the axis.

#include <liecheck/scalar/stumpff.hpp>
#include <liecheck/spatial/motion.hpp>
#include <liecheck/spatial/se3.hpp>
#include <liecheck/spatial/so3.hpp>

namespace liecheck {

namespace exp_log_detail {

/// a . b and a x b, each number rounded once (CompensatedSum), or plainly where splitting the factors overflows.
template <Scalar S>
std::pair<S, Vector3<S>> products(const Vector3<S>& a, const Vector3<S>& b) {
  CompensatedSum<S> dot;
  Vector3<S> c;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    dot.add_product(a[i], b[i]);
    c[i] = CompensatedSum<S>().add_product(a[j], b[k]).add_product(S(-a[k]), b[j]).value();
  }
  const S d = dot.value();
  if (!finite(d) || !c.allFinite()) return {a.dot(b), cross<S>(a, b)};
  return {d, c};
}

/// a x + b y + c z, each number rounded once, or plainly where splitting overflows.
template <Scalar S>
Vector3<S> combination(const S& a, const Vector3<S>& x, const S& b, const Vector3<S>& y, const S& c,
                       const Vector3<S>& z) {
  Vector3<S> sum;
  for (int i = 0; i < 3; ++i)
    sum[i] = CompensatedSum<S>().add_product(a, x[i]).add_product(b, y[i]).add_product(c, z[i]).value();
  if (!sum.allFinite()) return a * x + (b * y + c * z);
  return sum;
}

/// J(phi) rho from the coefficients. Error 3 eps of the result up to half a turn.
template <Scalar S>
Vector3<S> arc(const RotationCoefficients<S, Vector3<S>>& k, const Vector3<S>& rho) {
  const auto [along, across] = products<S>(k.axis, rho);
  return combination<S>(k.k1, rho, k.k2, across, k.k3 * along, k.axis);
}

/// A rotation vector phi = k v, and what J^-1(phi) needs, from a quaternion (v, w) of any scale.
template <Scalar S>
struct RotationLogarithm {
  Vector3<S> v, phi;
  LogarithmCoefficients<S> c;

  explicit RotationLogarithm(const SO3<S>& Q)
      : v(Q.w() < S(0) ? Vector3<S>(-Q.vec()) : Q.vec()), c(v.squaredNorm(), absolute(Q.w())) {
    phi = c.angle_over_sine * v;
  }

  /// rho = J^-1(phi) p = alpha p - 1/2 phi x p + (1 - alpha) n (n . p), alpha = (theta/2) cot(theta/2), n = v/|v|.
  /// The same rounded alpha stands in both places, so along the axis its error cancels. Error 2.5 eps |rho|,
  /// that of phi included.
  Vector3<S> arc(const Vector3<S>& p) const {
    const auto [along, across] = products<S>(v, p);
    return combination<S>(c.alpha, p, c.along * along, v, -c.angle_over_sine / S(2), across);
  }
};

}  // namespace exp_log_detail

namespace quaternion {

/// Q = (sin(theta/2) n, cos(theta/2)) of a rotation vector phi [3, rad]. Rotation error 2 eps.
template <Scalar S>
SO3<S> exp3(const Vector3<S>& phi) {
  const RotationCoefficients<S, Vector3<S>> k(phi);
  return SO3<S>(k.sine_half * k.axis, k.cosine_half);
}

/// phi [3, rad] = 2 atan2(|v|, |w|)/|v| sgn(w) v, |phi| <= pi. It does not depend on |Q|. Error 3 eps relative.
template <Scalar S>
Vector3<S> log3(const SO3<S>& Q) {
  return exp_log_detail::RotationLogarithm<S>(Q).phi;
}

/// (p, Q) = exp(xi), [p; x y z w], shape 7. Rotation 2 eps, translation 4 eps.
template <Scalar S>
Vector7<S> exp6(const Motion<S>& xi) {
  const RotationCoefficients<S, Vector3<S>> k(xi.angular());
  Vector7<S> q;
  q << exp_log_detail::arc<S>(k, xi.linear()), k.sine_half * k.axis, k.cosine_half;
  return q;
}

/// log of (p, Q) [p; x y z w]. Error 4 eps of each block.
template <Scalar S>
Motion<S> log6(const Vector7<S>& q) {
  const exp_log_detail::RotationLogarithm<S> l(SO3<S>(Vector4<S>(q.template tail<4>())));
  return {l.arc(q.template head<3>()), l.phi};
}

}  // namespace quaternion

/// R = exp [phi], 3 x 3, phi [3, rad]. Rotation error 3 eps.
template <Scalar S>
Matrix3<S> exp3(const Vector3<S>& phi) {
  return quaternion::exp3<S>(phi).matrix();
}

/// phi [3, rad] of the rotation nearest to R, for |R^T R - I| <= 8 eps. Error 3 eps relative.
template <Scalar S>
Vector3<S> log3(const Matrix3<S>& R) {
  return quaternion::log3<S>(SO3<S>::fromMatrix(R));
}

/// T = exp(xi), xi = (rho [m], phi [rad]). Rotation 3 eps, translation 4 eps.
template <Scalar S>
SE3<S> exp6(const Motion<S>& xi) {
  const RotationCoefficients<S, Vector3<S>> k(xi.angular());
  const SO3<S> Q(k.sine_half * k.axis, k.cosine_half);
  return SE3<S>(Q.matrix(), exp_log_detail::arc<S>(k, xi.linear()));
}

/// xi = log T, the inverse of exp6 for |phi| < pi. Error 4 eps of each block.
template <Scalar S>
Motion<S> log6(const SE3<S>& T) {
  const exp_log_detail::RotationLogarithm<S> l(SO3<S>::fromMatrix(T.rotation()));
  return {l.arc(T.translation()), l.phi};
}

}  // namespace liecheck
