#pragma once
// Exponential and logarithm of SO(3) and SE(3).
//
//   R = exp [phi], p = J(phi) rho = c1 rho + c2 phi x rho + c3 phi (phi . rho), J = I + c2 [phi] + c3 [phi]^2
//   (Murray, Li & Sastry 1994, eq. 2.36). The coefficients and their series near 0 are in scalar/stumpff.hpp.
//
// Domain: every finite rotation vector and every rotation. For |phi| <= pi the stated bounds are absolute for
// rotations and relative for vectors, down to subnormal angles. Beyond pi they are multiplied by the
// condition number (excess rule, docs/measuring.md). log returns |phi| <= pi; at pi the axis has either sign.

#include <liecheck/scalar/stumpff.hpp>
#include <liecheck/spatial/evaluate.hpp>
#include <liecheck/spatial/motion.hpp>
#include <liecheck/spatial/se3.hpp>
#include <liecheck/spatial/so3.hpp>

namespace liecheck {

namespace exp_log_detail {

/// J(phi) rho, given the coefficients k of phi. Error 3.5 eps of the result for |phi| <= pi.
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

/// exp [phi] = I + k1 [a] + k2 [a]^2. For |phi| > pi, a is a rounded unit vector, so the quaternion is used.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Matrix3<S> matrix(const RotationCoefficients<S, Vector3<S>, P>& k) {
  if (!k.within_pi)
    return SO3<S>(each<S>([&k](int i) { return k.sine_half * k.axis[i]; }), k.cosine_half).matrix();
  return quadratic<S>(k.axis, k.k1, k.k2);
}

/// Returns f(exp(rho, phi)).
template <Scalar S, Precision P, class F>
[[gnu::always_inline]] inline auto with_pose(const Vector3<S>& rho, const Vector3<S>& phi, F f) {
  return with_coefficients<S, P>(
      phi, [&rho, &f ](const auto& k)
               __attribute__((always_inline)) { return f(SE3<S>(matrix(k), arc(k, rho))); });
}

/// Computes phi = angle_over_sine v and the coefficients of J^-1(phi) from a quaternion (v, w) of any norm.
template <Scalar S, Precision P = Precision::standard>
struct RotationLogarithm {
  Vector3<S> v, phi;
  LogarithmCoefficients<S> c;

  /// |Q|^2 = 1 + excess.
  [[gnu::always_inline]] RotationLogarithm(const SO3<S>& Q, const DoubleWord<S>& excess)
      : v(vector_part(Q, Q.to_vector())), c(dot<S>(v, v), absolute<S>(Q.w()), excess) {
    phi = each<S>([&](int i) { return mul_add(c.ratio.high, v[i], S(c.ratio.low * v[i])); });
  }
  [[gnu::always_inline]] explicit RotationLogarithm(const typename SO3<S>::DoubleWords& Q)
      : RotationLogarithm(Q, Q.high.template normExcessDoubleWord<P>()) {}
  /// The quaternion is v = sine + sine_low, w = cosine >= 0, with |Q|^2 = 1 + excess.
  [[gnu::always_inline]] RotationLogarithm(const Vector3<S>& sine, const Vector3<S>& sine_low,
                                           const DoubleWord<S>& cosine, const DoubleWord<S>& excess)
      : RotationLogarithm(sine, sine_low, LogarithmCoefficients<S>(dot<S>(sine, sine), cosine, excess)) {}
  [[gnu::always_inline]] RotationLogarithm(const Vector3<S>& sine, const Vector3<S>& sine_low,
                                           const LogarithmCoefficients<S>& coefficients)
      : v(sine), c(coefficients) {
    phi = each<S>([&](int i) {
      return mul_add(c.ratio.high, v[i], mul_add(c.ratio.low, v[i], S(c.ratio.high * sine_low[i])));
    });
  }

  /// rho = J^-1(phi) p = p - 1/2 phi x p + (1 - alpha) n x (n x p), with alpha = (theta/2) cot(theta/2) and
  /// n = v/|v|. The part of p along the axis is unchanged. Error 3 eps |rho|, including the error of phi.
  [[gnu::always_inline]] Vector3<S> arc(const Vector3<S>& p) const {
    // phi is replaced by ratio v, with the unrounded ratio.
    const Vector3<S> v_p = cross<S>(v, p), v_v_p = cross<S>(v, v_p);
    const DoubleWord<S> minus_half(c.ratio.high / S(-2), c.ratio.low / S(-2));
    return each<S>([&](int i) {
      return mul_add(minus_half.high, v_p[i],
                     mul_add(minus_half.low, v_p[i], mul_add(c.along, v_v_p[i], p[i])));
    });
  }

 private:
  [[gnu::always_inline]] RotationLogarithm(const typename SO3<S>::DoubleWords& Q, const DoubleWord<S>& excess)
      : RotationLogarithm(vector_part(Q.high, Q.high.to_vector()), vector_part(Q.high, Q.low),
                          DoubleWord<S>(absolute<S>(Q.high.w()), S(sign<S>(Q.high.w()) * Q.low[3])),
                          DoubleWord<S>(excess.high, S(excess.low + S(2) * Q.high.to_vector().dot(Q.low)))) {}
  /// sgn(w) (q_0, q_1, q_2), where w is the scalar part of Q. This selects Q or -Q such that w >= 0.
  [[gnu::always_inline]] static Vector3<S> vector_part(const SO3<S>& Q, const Vector4<S>& q) {
    return each<S>([&q, s = sign<S>(Q.w())](int i) { return S(s * q[i]); });
  }
};

/// Returns f(logarithm of Q). Scaling of a Q with |Q|^2 out of [1/2, 3/2] is a separate function.
template <Scalar S, Precision P, class F>
[[gnu::noinline, gnu::cold]] auto with_logarithm_off_unit(const SO3<S>& Q, F f) {
  const SO3<S> scaled = Q.atUnitScale();
  return f(RotationLogarithm<S, P>(scaled, scaled.template normExcessDoubleWord<P>()));
}
template <Scalar S, Precision P, class F>
[[gnu::always_inline]] inline auto with_logarithm(const SO3<S>& Q, F f) {
  const auto excess = Q.template normExcessDoubleWord<P>();
  if constexpr (!side_by_side<S>)
    if (!unit_vector_detail::atUnitScale<S>(S(excess.high + excess.low))) [[unlikely]]
      return with_logarithm_off_unit<S, P>(Q, f);
  return f(RotationLogarithm<S, P>(Q, excess));
}

}  // namespace exp_log_detail

namespace quaternion {

/// Q = (sin(theta/2) n, cos(theta/2)) of a rotation vector phi [3, rad]. Rotation error 2 eps.
template <Scalar S, Precision P = Precision::standard>
SO3<S> exp3(const Vector3<S>& phi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector3<T>& x) __attribute__((always_inline)) {
        return with_coefficients<T, Q>(
            x, [](const auto& k) __attribute__((always_inline)) {
              return SO3<T>(each<T>([&k](int i) { return k.sine_half * k.axis[i]; }), k.cosine_half);
            });
      },
      phi);
}

/// phi [3, rad] = 2 atan2(|v|, |w|)/|v| sgn(w) v, |phi| <= pi, for any |Q|. Relative error 2 eps.
template <Scalar S, Precision P = Precision::standard>
Vector3<S> log3(const SO3<S>& Q) {
  return evaluate<S, P>(
      []<Scalar T, Precision R>(Arithmetic<T, R>, const SO3<T>& x) __attribute__((always_inline)) {
        return exp_log_detail::with_logarithm<T, R>(
            x, [](const auto& l) __attribute__((always_inline)) { return l.phi; });
      },
      Q);
}

/// (p, Q) = exp(xi) as [p; x y z w] [7], xi = (rho [m], phi [rad]). Rotation 2 eps, translation 4 eps.
template <Scalar S, Precision P = Precision::standard>
Vector7<S> exp6(const Motion<S>& xi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Motion<T>& x) __attribute__((always_inline)) {
        return with_coefficients<T, Q>(
            x.angular(), [&x](const auto& k) __attribute__((always_inline)) {
              Vector7<T> q;
              q << exp_log_detail::arc(k, x.linear()), k.sine_half * k.axis, k.cosine_half;
              return q;
            });
      },
      xi);
}

/// log of the pose q = [p; x y z w] [7]. Error 2 eps of phi, 4 eps of rho.
template <Scalar S, Precision P = Precision::standard>
Motion<S> log6(const Vector7<S>& q) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector7<T>& x) __attribute__((always_inline)) {
        return exp_log_detail::with_logarithm<T, Q>(
            SO3<T>(Vector4<T>(x.template tail<4>())), [&x](const auto& l) __attribute__((always_inline)) {
              return Motion<T>(l.arc(x.template head<3>()), l.phi);
            });
      },
      q);
}

}  // namespace quaternion

/// R = exp [phi] [3 x 3], phi [3, rad]. Rotation error 2 eps.
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> exp3(const Vector3<S>& phi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector3<T>& x) __attribute__((always_inline)) {
        return with_coefficients<T, Q>(
            x, [](const auto& k) __attribute__((always_inline)) { return exp_log_detail::matrix(k); });
      },
      phi);
}

/// phi [3, rad] of the rotation nearest to R, for |R^T R - I| <= 8 eps. Relative error 3 eps. Fast precision
/// does not orthogonalise R, which adds |R^T R - I| to the error.
template <Scalar S, Precision P = Precision::standard>
Vector3<S> log3(const Matrix3<S>& R) {
  return evaluate<S, P, Precision::standard>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Matrix3<T>& x) __attribute__((always_inline)) {
        return exp_log_detail::RotationLogarithm<T, Q>(SO3<T>::template doubleWordsFromMatrix<Q>(x)).phi;
      },
      R);
}

/// T = exp(xi), xi = (rho [m], phi [rad]). Rotation 2 eps, translation 4 eps.
template <Scalar S, Precision P = Precision::standard>
SE3<S> exp6(const Motion<S>& xi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Motion<T>& x) __attribute__((always_inline)) {
        return exp_log_detail::with_pose<T, Q>(
            x.linear(), x.angular(), [](const SE3<T>& X) __attribute__((always_inline)) { return X; });
      },
      xi);
}

/// xi = log T, inverse of exp6 for |phi| < pi. Error 3 eps of phi, 4 eps of rho. For fast precision see log3.
template <Scalar S, Precision P = Precision::standard>
Motion<S> log6(const SE3<S>& T) {
  return evaluate<S, P, Precision::standard>(
      []<Scalar U, Precision Q>(Arithmetic<U, Q>, const SE3<U>& x) __attribute__((always_inline)) {
        const exp_log_detail::RotationLogarithm<U, Q> l(
            SO3<U>::template doubleWordsFromMatrix<Q>(x.rotation()));
        return Motion<U>(l.arc(x.translation()), l.phi);
      },
      T);
}

}  // namespace liecheck
