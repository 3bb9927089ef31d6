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
#include <liecheck/spatial/tight.hpp>

namespace liecheck {

namespace exp_log_detail {

/// J(phi) rho from the coefficients. Error 3.5 eps of the result up to half a turn.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector3<S> arc(const RotationCoefficients<S, Vector3<S>, P>& k,
                                             const Vector3<S>& rho) {
  const Vector3<S> across = cross<S>(k.axis, rho);
  const S along = k.k3 * dot<S>(k.axis, rho);
  return each<S>(
      [&](int i) { return mul_add(k.k1, rho[i], mul_add(k.k2, across[i], S(along * k.axis[i]))); });
}

/// I + b1 [a] + b2 [a]^2.
template <Scalar S>
[[gnu::always_inline]] inline Matrix3<S> quadratic(const Vector3<S>& a, const S& b1, const S& b2) {
  const Vector3<S> s = each<S>([&](int i) { return b1 * a[i]; }),
                   v = each<S>([&](int i) { return b2 * a[i]; });
  const S &x = a[0], &y = a[1], &z = a[2];
  const S xx = v[0] * x, yy = v[1] * y;
  return rows<S>(S(1) - mul_add(v[2], z, yy), mul_add(v[0], y, S(-s[2])), mul_add(v[2], x, s[1]),
                 mul_add(v[0], y, s[2]), S(1) - mul_add(v[2], z, xx), mul_add(v[1], z, S(-s[0])),
                 mul_add(v[2], x, S(-s[1])), mul_add(v[1], z, s[0]), S(1) - (xx + yy));
}

/// exp [phi] = I + k1 [a] + k2 [a]^2 up to half a turn; beyond, where a is a rounded unit vector, by the quaternion.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Matrix3<S> matrix(const RotationCoefficients<S, Vector3<S>, P>& k) {
  if (!k.half_turn)
    return SO3<S>(each<S>([&k](int i) { return k.sine_half * k.axis[i]; }), k.cosine_half).matrix();
  return quadratic<S>(k.axis, k.k1, k.k2);
}

/// f(exp(rho, phi)).
template <Scalar S, Precision P, class F>
[[gnu::always_inline]] inline auto with_pose(const Vector3<S>& rho, const Vector3<S>& phi, F f) {
  return with_coefficients<S, P>(
      phi, [&rho, &f ](const auto& k) __attribute__((always_inline)) {
        return f(SE3<S>(matrix(k), arc(k, rho)));
      });
}

/// A rotation vector phi = k v, and what J^-1(phi) needs, from a quaternion (v, w) of any scale.
template <Scalar S, Precision P = Precision::standard>
struct RotationLogarithm {
  Vector3<S> v, phi;
  LogarithmCoefficients<S> c;

  [[gnu::always_inline]] explicit RotationLogarithm(const SO3<S>& Q)
      : RotationLogarithm(Q, Q.template normExcessParts<P>()) {}
  [[gnu::always_inline]] explicit RotationLogarithm(const typename SO3<S>::Unrounded& Q)
      : RotationLogarithm(Q, Q.Q.template normExcessParts<P>()) {}
  /// From v + v_low, w + w_low with w >= 0, and |Q|^2 = 1 + excess + excess_low.
  [[gnu::always_inline]] RotationLogarithm(const Vector3<S>& sine, const Vector3<S>& sine_low,
                                           const S& cosine, const S& cosine_low, const S& excess,
                                           const S& excess_low = S(0))
      : v(sine), c(dot<S>(v, v), cosine, excess, excess_low, cosine_low) {
    phi =
        each<S>([&](int i) { return mul_add(c.base, v[i], mul_add(c.rest, v[i], S(c.base * sine_low[i]))); });
  }

  /// rho = J^-1(phi) p = p - 1/2 phi x p + (1 - alpha) n x (n x p), alpha = (theta/2) cot(theta/2), n = v/|v|: along the
  /// axis p passes as it is. Error 3 eps |rho|, that of phi included.
  [[gnu::always_inline]] Vector3<S> arc(const Vector3<S>& p) const {
    const Vector3<S> across = cross<S>(v, p), back = cross<S>(v, across);
    return each<S>([&](int i) {
      return mul_add(turn(), across[i], mul_add(turn_low(), across[i], mul_add(c.along, back[i], p[i])));
    });
  }

 private:
  using Parts = std::pair<S, S>;
  [[gnu::always_inline]] RotationLogarithm(const SO3<S>& Q, const Parts& excess)
      : v(half(Q, Q.to_vector())), c(dot<S>(v, v), absolute<S>(Q.w()), excess.first, excess.second) {
    phi = each<S>([&](int i) { return mul_add(c.base, v[i], S(c.rest * v[i])); });
  }
  [[gnu::always_inline]] RotationLogarithm(const typename SO3<S>::Unrounded& Q, const Parts& excess)
      : RotationLogarithm(half(Q.Q, Q.Q.to_vector()), half(Q.Q, Q.low), absolute<S>(Q.Q.w()),
                          S(sign<S>(Q.Q.w()) * Q.low[3]), excess.first,
                          S(excess.second + S(2) * Q.Q.to_vector().dot(Q.low))) {}
  /// Minus half the angle over its sine, as it is before it is rounded.
  S turn() const { return c.base / S(-2); }
  S turn_low() const { return c.rest / S(-2); }
  /// The vector part, of the one of Q and -Q whose scalar part is positive.
  [[gnu::always_inline]] static Vector3<S> half(const SO3<S>& Q, const Vector4<S>& q) {
    return each<S>([&q, turn = sign<S>(Q.w())](int i) { return S(turn * q[i]); });
  }
};

}  // namespace exp_log_detail

namespace quaternion {

/// Q = (sin(theta/2) n, cos(theta/2)) of a rotation vector phi [3, rad]. Rotation error 2 eps.
template <Scalar S, Precision P = Precision::standard>
SO3<S> exp3(const Vector3<S>& phi) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [](const auto& a) { return quaternion::exp3<DoubleDouble<S>, Precision::fast>(a); },
        [&] { return quaternion::exp3<S>(phi); }, phi);
  return with_coefficients<S, P>(
      phi, [](const auto& k) __attribute__((always_inline)) {
        return SO3<S>(each<S>([&k](int i) { return k.sine_half * k.axis[i]; }), k.cosine_half);
      });
}

/// phi [3, rad] = 2 atan2(|v|, |w|)/|v| sgn(w) v, |phi| <= pi. It does not depend on |Q|. Error 2 eps relative.
template <Scalar S, Precision P = Precision::standard>
Vector3<S> log3(const SO3<S>& Q) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [](const auto& a) { return quaternion::log3<DoubleDouble<S>, Precision::fast>(a); },
        [&] { return quaternion::log3<S>(Q); }, Q);
  return exp_log_detail::RotationLogarithm<S, P>(Q).phi;
}

/// (p, Q) = exp(xi), [p; x y z w], shape 7. Rotation 2 eps, translation 4 eps.
template <Scalar S, Precision P = Precision::standard>
Vector7<S> exp6(const Motion<S>& xi) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [](const auto& a) { return quaternion::exp6<DoubleDouble<S>, Precision::fast>(a); },
        [&] { return quaternion::exp6<S>(xi); }, xi);
  return with_coefficients<S, P>(
      xi.angular(), [&xi](const auto& k) __attribute__((always_inline)) {
        Vector7<S> q;
        q << exp_log_detail::arc(k, xi.linear()), k.sine_half * k.axis, k.cosine_half;
        return q;
      });
}

/// log of (p, Q) [p; x y z w]. Error 2 eps of phi, 4 eps of rho.
template <Scalar S, Precision P = Precision::standard>
Motion<S> log6(const Vector7<S>& q) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [](const auto& a) { return quaternion::log6<DoubleDouble<S>, Precision::fast>(a); },
        [&] { return quaternion::log6<S>(q); }, q);
  const exp_log_detail::RotationLogarithm<S, P> l(SO3<S>(Vector4<S>(q.template tail<4>())));
  return {l.arc(q.template head<3>()), l.phi};
}

}  // namespace quaternion

/// R = exp [phi], 3 x 3, phi [3, rad]. Rotation error 2 eps.
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> exp3(const Vector3<S>& phi) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>([](const auto& a) { return exp3<DoubleDouble<S>, Precision::fast>(a); },
                                    [&] { return exp3<S>(phi); }, phi);
  return with_coefficients<S, P>(
      phi, [](const auto& k) __attribute__((always_inline)) { return exp_log_detail::matrix(k); });
}

/// phi [3, rad] of the rotation nearest to R, for |R^T R - I| <= 8 eps. Error 3 eps relative; in
/// fast precision another |R^T R - I|.
template <Scalar S, Precision P = Precision::standard>
Vector3<S> log3(const Matrix3<S>& R) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(  // not fast, which takes R as it is
        [](const auto& a) { return log3<DoubleDouble<S>>(a); }, [&] { return log3<S>(R); }, R);
  return exp_log_detail::RotationLogarithm<S, P>(SO3<S>::template unroundedFromMatrix<P>(R)).phi;
}

/// T = exp(xi), xi = (rho [m], phi [rad]). Rotation 2 eps, translation 4 eps.
template <Scalar S, Precision P = Precision::standard>
SE3<S> exp6(const Motion<S>& xi) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>([](const auto& a) { return exp6<DoubleDouble<S>, Precision::fast>(a); },
                                    [&] { return exp6<S>(xi); }, xi);
  return exp_log_detail::with_pose<S, P>(
      xi.linear(), xi.angular(), [](const SE3<S>& T) __attribute__((always_inline)) { return T; });
}

/// xi = log T, the inverse of exp6 for |phi| < pi. Error 3 eps of phi, 4 eps of rho.
template <Scalar S, Precision P = Precision::standard>
Motion<S> log6(const SE3<S>& T) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(  // not fast, which takes R as it is
        [](const auto& a) { return log6<DoubleDouble<S>>(a); }, [&] { return log6<S>(T); }, T);
  const exp_log_detail::RotationLogarithm<S, P> l(SO3<S>::template unroundedFromMatrix<P>(T.rotation()));
  return {l.arc(T.translation()), l.phi};
}

}  // namespace liecheck
