#pragma once
// The free-flyer's configuration space: poses stored as q = [p; x y z w], shape 7, with increments
// delta = (rho [m], phi [rad]) in the axes of the moving body, shape 6.
//
//   integrate(q, delta)  = T exp(delta)          Q1 = Q0 exp(phi/2),  p1 = p0 + R(Q0) J(phi) rho
//   difference(q0, q1)   = log(T0^-1 T1)         phi = log(Q0* Q1),   rho = J^-1(phi) R(Q0)^T (p1 - p0)
//   d integrate          ARG0 Ad(exp(-delta))    ARG1  J_r(delta)
//   d difference         ARG0 -J_l^-1(delta)     ARG1  J_r^-1(delta)
//
// The derivatives are 6 x 6. They map a body-fixed increment of the argument to the increment of the result,
// which is body-fixed too (Sola, Deray & Atchuthan 2018, eqs. 41 and 46).
//
// Domain: finite q with Q != 0 of any norm. Q represents the rotation of Q/|Q|. Error bounds are those for
// ||Q|^2 - 1| <= 8 eps; each function states what another norm costs. Q = 0 is refused. Check input with
// checkedConfiguration of configuration.hpp.

#include <liecheck/multibody/argument_position.hpp>
#include <liecheck/multibody/unit_vector.hpp>
#include <liecheck/scalar/compensated.hpp>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/jacobians.hpp>

namespace liecheck {

namespace se3_configuration_detail {

template <Scalar S>
[[gnu::always_inline]] inline Vector4<S> quaternionOf(const Vector7<S>& q) {
  return Vector4<S>(q[3], q[4], q[5], q[6]);
}

/// (1 + a)(1 + b) - 1.
template <Scalar S>
[[gnu::always_inline]] inline S product_excess(const S& a, const S& b) {
  return mul_add(a, b, S(a + b));
}

/// Q0 Q1 [x y z w] of two quaternions of norm about 1, in double words.
template <Scalar S, Precision P>
struct Product {
  SplitDot<Quad<S>, 1, P> sum;
  [[gnu::always_inline]] Product(const Quad<S>& a, const Quad<S>& q) {
    const LeftFactor<S, P> p(a);
    sum = by_lane<S, P>([&](auto l) __attribute__((always_inline)) {
      return empty_sum<P>(l, q)
          .add_product(at(l, p.w_x), split_lanes<P, 0, 1, 2, 0>(l, q))
          .add_product(at(l, p.self), split_lanes<P, 3, 3, 3, 3>(l, q))
          .add_product(at(l, p.y), split_lanes<P, 2, 0, 1, 1>(l, q))
          .add_product(-at(l, p.z), split_lanes<P, 1, 2, 0, 2>(l, q));
    });
  }
  /// The product, normalised up to 3/8 excess^2, excess = |Q0|^2 |Q1|^2 - 1. Each number is rounded once.
  [[gnu::always_inline]] Vector4<S> normalized(const S& excess) const {
    const Quad<S> q = sum.high + mul_add(Quad<S>(excess / S(-2)), sum.high, sum.low());
    return Vector4<S>(q.v[0], q.v[1], q.v[2], q.v[3]);
  }
};

/// D = s Q1 - Q0 and v = vec(Q0* D), s = +-1, where Q0 and Q1 are the quaternions of q0 and q1.
template <Scalar S>
struct NearRotation {
  Vector4<S> D;
  Vector3<S> v;
};
template <Scalar S, Precision P>
NearRotation<S> nearRotation(const Vector7<S>& q0, const Vector7<S>& q1, const S& s) {
  const auto step = [&](int i) { return mul_add(s, q1[3 + i], S(-q0[3 + i])); };
  const Vector4<S> D(step(0), step(1), step(2), step(3));
  const auto entry = [&](int i, int j, int k) {
    return CompensatedSum<S, P>()
        .add_product(q0[6], D[i])
        .add_product(S(-q0[3 + i]), D[3])
        .add_product(S(-q0[3 + j]), D[k])
        .add_product(q0[3 + k], D[j])
        .value();
  };
  return {D, Vector3<S>(entry(0, 1, 2), entry(1, 2, 0), entry(2, 0, 1))};
}
/// v = vec(Q0* D). If |v| < |D|/2, fast precision uses compensated sums too.
template <Scalar S, Precision P>
[[gnu::noinline]] Vector3<S> nearRotationVector(const Vector7<S>& q0, const Vector7<S>& q1, const S& s) {
  const auto [D, v] = nearRotation<S, P>(q0, q1, s);
  if constexpr (P == Precision::fast)
    if (S(4) * dot<S>(v, v) < mul_add(D[3], D[3], mul_add(D[0], D[0], mul_add(D[1], D[1], S(D[2] * D[2])))))
      return nearRotation<S, Precision::standard>(q0, q1, s).v;
  return v;
}

/// log(Q0* Q1), from the product in double words. The vector part of the product has full relative accuracy,
/// even if the two rotations are close.
///
/// For close rotations let s = sgn(Q0 . Q1) and D = s Q1 - Q0. Then s vec(Q0* Q1) = vec(Q0* D), because
/// vec(Q0* Q0) = 0. The subtraction D is exact except in components that are small. The products of Q0* D are
/// summed with compensation, because D is much longer than vec(Q0* D) if the norms of Q0 and Q1 differ. Fast
/// precision uses this form for |v| < 1/8, and compensates only if |v| < |D|/2.
/// excess0 and excess1 are |Q0|^2 - 1 and |Q1|^2 - 1.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline exp_log_detail::RotationLogarithm<S, P> relativeLogarithm(const Vector7<S>& q0,
                                                                                        const Vector7<S>& q1,
                                                                                        const S& excess0,
                                                                                        const S& excess1) {
  const SO3<S> Q0(quaternionOf(q0)), Q1(quaternionOf(q1));
  const auto sum = Product<S, P>(Q0.conjugate(), Q1.numbers()).sum;
  const Quad<S> Q = sum.value(), Q_low = sum.rounding_error(Q);
  DoubleWord<S> w(Q.v[3], Q_low.v[3]);
  // Near theta = pi the sign of w decides the sign of the axis, so w is computed exactly.
  if constexpr (!side_by_side<S>)
    if (absolute<S>(w.high) < eps<S>() * (P == Precision::fast ? S(16) : S(1) / S(16)))
      w = DoubleWord<S>(exact_dot<S, 4>(q0.template tail<4>(), q1.template tail<4>()));
  const S s = sign<S>(w.high);
  const S excess = product_excess<S>(excess0, excess1);
  const auto vector_part = [&s](const Quad<S>& q) { return each<S>([&](int i) { return S(s * q.v[i]); }); };
  Vector3<S> v = vector_part(Q), v_low = vector_part(Q_low);
  if constexpr (!side_by_side<S>)
    if (dot<S>(v, v) < (P == Precision::fast ? S(1) / S(64) : S(2048) * eps<S>()))
      v = nearRotationVector<S, P>(q0, q1, s), v_low = Vector3<S>::Zero();
  return exp_log_detail::RotationLogarithm<S, P>(v, v_low, DoubleWord<S>(absolute<S>(w.high), S(s * w.low)),
                                                 DoubleWord<S>(excess));
}

/// integrateSE3 and differenceSE3 for translations that can be split into high and low parts without overflow
/// (SO3::splittable). integrateFar and differenceFar scale larger translations down first, integrateOffUnit
/// and differenceOffUnit change the norm of quaternions first.
template <Scalar S, Precision P>
Vector7<S> integrateOffUnit(const Vector7<S>& q, const Vector6<S>& delta);
template <Scalar S, Precision P>
Vector6<S> differenceOffUnit(Vector7<S> q0, Vector7<S> q1);

template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector7<S> integrate(const Vector7<S>& q, const Vector6<S>& delta) {
  const SO3<S> Q0(quaternionOf(q));
  const S excess0 = Q0.template normExcess<P>();
  if constexpr (!side_by_side<S>)
    if (!unit_vector_detail::firstOrderSuffices<S>(excess0)) [[unlikely]]
      return integrateOffUnit<S, P>(q, delta);
  const Vector3<S> phi(delta[3], delta[4], delta[5]);
  return with_coefficients<S, P>(
      phi, [&q, &delta, &Q0, &excess0 ](const auto& k) __attribute__((always_inline)) {
        const Vector3<S> rho(delta[0], delta[1], delta[2]);
        // Q0 . Q1 = |Q0|^2 cos(theta/2).
        const S s = sign<S>(k.cosine_half), sine = s * k.sine_half;
        const S x = sine * k.axis[0], y = sine * k.axis[1], z = sine * k.axis[2], w = s * k.cosine_half;
        const Vector3<S> step = Q0.template actWithin<P>(exp_log_detail::arc(k, rho), norm1<S>(rho));
        const S excess = mul_add(w, w, S(-1)) + mul_add(x, x, mul_add(y, y, S(z * z)));
        const Vector4<S> Q1 =
            Product<S, P>(Q0.numbers(), Quad<S>(x, y, z, w)).normalized(product_excess<S>(excess0, excess));
        Vector7<S> result;
        // Written without loops for speed; see difference below.
        result[0] = q[0] + step[0], result[1] = q[1] + step[1], result[2] = q[2] + step[2];
        result[3] = Q1[0], result[4] = Q1[1], result[5] = Q1[2], result[6] = Q1[3];
        return result;
      });
}
template <Scalar S, Precision P>
[[gnu::noinline, gnu::cold]] Vector7<S> integrateOffUnit(const Vector7<S>& q, const Vector6<S>& delta) {
  const Vector4<S> Q = normalizedUnit<S, 4>(quaternionOf(q));
  Vector7<S> unit;
  for (int i = 0; i < 7; ++i) unit[i] = i < 3 ? q[i] : Q[i - 3];
  return finite<S>(Q[0]) ? integrate<S, P>(unit, delta) : Vector7<S>(unit * Q[0]);
}
template <Scalar S, Precision P>
[[gnu::noinline, gnu::cold]] Vector7<S> integrateFar(Vector7<S> q, Vector6<S> delta) {
  const Vector3<S> p0 = q.template head<3>();
  q.template head<3>().setZero();
  delta.template head<3>() *= SO3<S>::scale_down();
  Vector7<S> result = integrate<S, P>(q, delta);
  for (int i = 0; i < 3; ++i) result[i] = p0[i] + result[i] / SO3<S>::scale_down();
  return result;
}
template <Scalar S, Precision P>
[[gnu::always_inline]] inline S normExcessOf(const Vector7<S>& q) {
  return SO3<S>(quaternionOf(q)).template normExcess<P>();
}
/// Q0 is the quaternion of q0, of norm 1. The quaternions in q0 and q1 may have any norms about 1.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector6<S> difference(const Vector7<S>& q0, const Vector7<S>& q1,
                                                    const SO3<S>& Q0, const S& excess0, const S& excess1) {
  const auto log = relativeLogarithm<S, P>(q0, q1, excess0, excess1);
  const Quad<S> p0 = Quad<S>(q0[0], q0[1], q0[2], S(0)), p1 = Quad<S>(q1[0], q1[1], q1[2], S(0)),
                p_01 = p1 - p0;
  const S bound = absolute<S>(p_01.v[0]) + absolute<S>(p_01.v[1]) + absolute<S>(p_01.v[2]);
  const Vector3<S> p = [&]() __attribute__((always_inline)) {
    if constexpr (P == Precision::fast || !one_register<S>) return Q0.template actInvWithin<P>(p_01, bound);
    // two_sum(p1, -p0) in one register.
    const Quad<S> minus_p0 = p_01 - p1, low = (p1 - (p_01 - minus_p0)) - (p0 + minus_p0);
    return Q0.template actInvWithin<P>(p_01, bound, low);
  }
  ();
  const Vector3<S> rho = log.arc(p);
  Vector6<S> delta;
  // Written without a loop. The compiler would vectorise a loop and load rho in wide registers right after
  // storing it number by number, which stalls (failed store forwarding).
  delta[0] = rho[0], delta[3] = log.phi[0];
  delta[1] = rho[1], delta[4] = log.phi[1];
  delta[2] = rho[2], delta[5] = log.phi[2];
  return delta;
}
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector6<S> difference(const Vector7<S>& q0, const Vector7<S>& q1) {
  const S excess0 = normExcessOf<S, P>(q0), excess1 = normExcessOf<S, P>(q1);
  using unit_vector_detail::firstOrderSuffices;
  if constexpr (!side_by_side<S>)
    if (!firstOrderSuffices<S>(excess0) || !firstOrderSuffices<S>(excess1)) [[unlikely]]
      return differenceOffUnit<S, P>(q0, q1);
  return difference<S, P>(q0, q1, SO3<S>(quaternionOf(q0)), excess0, excess1);
}
/// The quaternions are scaled by powers of two. That rounds nothing, so that the rotation between near ones
/// keeps its digits. The translation is rotated by a normalised one.
template <Scalar S, Precision P>
[[gnu::noinline, gnu::cold]] Vector6<S> differenceOffUnit(Vector7<S> q0, Vector7<S> q1) {
  const SO3<S> Q0(normalizedUnit<S, 4>(quaternionOf(q0)));
  for (Vector7<S>* q : {&q0, &q1}) {
    const Vector4<S> Q = unit_vector_detail::scaledByPowerOfTwo<S, 4>(quaternionOf(*q));
    for (int i = 0; i < 4; ++i) (*q)[3 + i] = Q[i];
  }
  return difference<S, P>(q0, q1, Q0, normExcessOf<S, P>(q0), normExcessOf<S, P>(q1));
}
template <Scalar S, Precision P>
[[gnu::noinline, gnu::cold]] Vector6<S> differenceFar(Vector7<S> q0, Vector7<S> q1) {
  q0.template head<3>() *= SO3<S>::scale_down();
  q1.template head<3>() *= SO3<S>::scale_down();
  Vector6<S> result = difference<S, P>(q0, q1);
  result.template head<3>() /= SO3<S>::scale_down();
  return result;
}

}  // namespace se3_configuration_detail

/// T exp(delta) as [p; x y z w]. The sign of Q1 is such that Q1 . Q0 >= 0. Pose q [7; m], delta [6; m, rad].
/// Error for |phi| <= pi: rotation 2 eps, translation 4 eps of max(|p1|, |p0|, |rho|). For larger |phi| these
/// bounds are multiplied by the condition number (excess rule, docs/measuring.md). ||Q1|^2 - 1| <= 3 eps.
/// Q0 is normalised first if ||Q0|^2 - 1| > sqrt(eps)/2, which adds 2 eps to the error of the rotation. Throws
/// std::invalid_argument if Q0 = 0.
template <Scalar S, Precision P = Precision::standard>
Vector7<S> integrateSE3(const Vector7<S>& q, const Vector6<S>& delta) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector7<T>& x, const Vector6<T>& d)
          __attribute__((always_inline)) {
            if constexpr (Q != Precision::fast && !side_by_side<T>)
              if (!SO3<T>::splittable(norm1<T>(Vector3<T>(d[0], d[1], d[2])))) [[unlikely]]
                return se3_configuration_detail::integrateFar<T, Q>(x, d);
            return se3_configuration_detail::integrate<T, Q>(x, d);
          },
      q, delta);
}

/// (rho, phi) = log(T0^-1 T1) [6; m, rad], |phi| <= pi, the same for Q and -Q. At |phi| = pi the axis has
/// either sign. Error 2 eps of |phi|, and 4 eps of max(|rho|, |p1 - p0|), for any |p1 - p0|, |Q0|, |Q1|.
/// Throws std::invalid_argument if Q0 or Q1 is 0.
template <Scalar S, Precision P = Precision::standard>
Vector6<S> differenceSE3(const Vector7<S>& q0, const Vector7<S>& q1) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector7<T>& a,
                                const Vector7<T>& b) __attribute__((always_inline)) {
        if constexpr (Q != Precision::fast && !side_by_side<T>)
          if (!SO3<T>::splittable(norm1<T>(Vector3<T>(b[0] - a[0], b[1] - a[1], b[2] - a[2])))) [[unlikely]]
            return se3_configuration_detail::differenceFar<T, Q>(a, b);
        return se3_configuration_detail::difference<T, Q>(a, b);
      },
      q0, q1);
}

/// The derivative of integrate with respect to q (ARG0: Ad(exp(-delta))) or delta (ARG1: J_r(delta)) [6 x 6];
/// neither depends on q. Error 6 eps of each 3 x 3 block for |phi| <= pi. For larger |phi| this bound is
/// multiplied by the condition number (excess rule, docs/measuring.md).
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> dIntegrateSE3(const Vector7<S>&, const Vector6<S>& delta, ArgumentPosition argument) {
  return evaluate<S, P>(
      [argument]<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector6<T>& d)
          __attribute__((always_inline)) {
            if (argument == ArgumentPosition::ARG1) return rightJacobian<T, Q>(Motion<T>(d));
            const auto minus = [&d](int first) __attribute__((always_inline)) {
              return each<T>([&d, first](int i) { return T(-d[first + i]); });
            };
            return exp_log_detail::with_pose<T, Q>(
                minus(0), minus(3),
                [](const SE3<T>& X) __attribute__((always_inline)) { return X.toActionMatrix(); });
          },
      delta);
}

/// The derivative of difference with respect to q0 (ARG0: -J_l^-1) or q1 (ARG1: J_r^-1) [6 x 6]. At
/// |phi| = pi it is the derivative on the branch that differenceSE3 returns. Error, including that of
/// difference: 4.2 eps of a rotation block, 7.5 eps of the coupling block.
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> dDifferenceSE3(const Vector7<S>& q0, const Vector7<S>& q1, ArgumentPosition argument) {
  return evaluate<S, P>(
      [argument]<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector7<T>& a, const Vector7<T>& b)
          __attribute__((always_inline)) {
            const Motion<T> xi(differenceSE3<T, Q>(a, b));
            if (argument == ArgumentPosition::ARG0) return Matrix6<T>(-leftJacobianInverse<T, Q>(xi));
            return rightJacobianInverse<T, Q>(xi);
          },
      q0, q1);
}

/// The derivative [7 x 6] of the seven stored numbers with respect to a body-fixed increment at zero:
/// [R, 0; 0, 1/2 (w I + [v]); 0, -1/2 v^T], with R of Q/|Q|, and v and w of the stored Q. Error 2 eps. Throws
/// std::invalid_argument if Q = 0.
template <Scalar S>
Eigen::Matrix<S, 7, 6> integrateCoeffWiseJacobianSE3(const Vector7<S>& q) {
  const SO3<S> Q(Vector4<S>(q.template tail<4>()));
  const Vector3<S> v = Q.vec() / S(2);
  Eigen::Matrix<S, 7, 6> J = Eigen::Matrix<S, 7, 6>::Zero();
  J.template topLeftCorner<3, 3>() = SO3<S>(nearUnit<S, 4>(Q.to_vector())).matrix();
  J.template block<3, 3>(3, 3) = skew<S>(v);
  J.template block<3, 3>(3, 3).diagonal().setConstant(Q.w() / S(2));
  J.template block<1, 3>(6, 3) = -v.transpose();
  return J;
}

}  // namespace liecheck
