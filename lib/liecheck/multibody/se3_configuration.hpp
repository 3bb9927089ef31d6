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

/// Q0 Q1 [x y z w] of two quaternions of norm about 1, in twice the digits.
template <Scalar S, Precision P>
struct Product {
  CutSum<S, 1, P> x, y, z, w;
  [[gnu::always_inline]] Product(const Vector4<S>& a, const Vector4<S>& b) {
    using C = Cut<S, 1, P>;
    const C ax(a[0]), ay(a[1]), az(a[2]), aw(a[3]), bx(b[0]), by(b[1]), bz(b[2]), bw(b[3]);
    const C ax_(-ax), ay_(-ay), az_(-az);
    x.add_product(aw, bx).add_product(ax, bw).add_product(ay, bz).add_product(az_, by);
    y.add_product(aw, by).add_product(ay, bw).add_product(az, bx).add_product(ax_, bz);
    z.add_product(aw, bz).add_product(az, bw).add_product(ax, by).add_product(ay_, bx);
    w.add_product(aw, bw).add_product(ax_, bx).add_product(ay_, by).add_product(az_, bz);
  }
  Vector4<S> value() const { return Vector4<S>(x.value(), y.value(), z.value(), w.value()); }
  /// Of norm 1 up to 3/8 of the squared defect, each number rounded once.
  [[gnu::always_inline]] Vector4<S> normalized() const {
    const S x1 = x.value(), y1 = y.value(), z1 = z.value(), w1 = w.value();
    const S norm = mul_add(x1, x1, S(y1 * y1)) + mul_add(z1, z1, S(w1 * w1)), step = (S(1) - norm) / S(2);
    const auto entry = [&step](const CutSum<S, 1, P>& q) { return q.high + mul_add(step, q.high, q.low); };
    return Vector4<S>(entry(x), entry(y), entry(z), entry(w));
  }
};

/// D = Q1 - s Q0 and vec(Q0* D), s = sgn(Q0 . Q1).
template <Scalar S, Precision P>
std::pair<Vector4<S>, Vector3<S>> nearRotation(const Vector4<S>& Q0, const Vector4<S>& Q1, const S& turn) {
  const auto step = [&](int i) { return mul_add(turn, Q1[i], S(-Q0[i])); };
  const Vector4<S> D(step(0), step(1), step(2), step(3));
  const auto entry = [&](int i, int j, int k) {
    return CompensatedSum<S, P>()
        .add_product(Q0[3], D[i])
        .add_product(S(-Q0[i]), D[3])
        .add_product(S(-Q0[j]), D[k])
        .add_product(Q0[k], D[j])
        .value();
  };
  return {D, Vector3<S>(entry(0, 1, 2), entry(1, 2, 0), entry(2, 0, 1))};
}
template <Scalar S>
[[gnu::noinline]] Vector3<S> nearest(const Vector4<S>& Q0, const Vector4<S>& Q1, const S& turn) {
  return nearRotation<S, Precision::standard>(Q0, Q1, turn).second;
}

/// Q0* Q1 up to sign and up to the factor |Q0||Q1|, its scalar part >= 0 and its vector part accurate
/// relative to itself however near the two rotations are.
///
/// Near poses: with D = Q1 - s Q0, s = sgn(Q0 . Q1), vec(Q0* Q1) = vec(Q0* D) because vec(Q0* Q0) = 0 exactly, and
/// the subtraction is exact in all but small numbers; its products are summed in twice the digits, because the
/// difference of the norms may make D much longer than vec. Fast precision takes that way at any distance, and
/// sums in twice the digits where D is much longer.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline SO3<S> relativeRotation(const Vector4<S>& Q0, const Vector4<S>& Q1) {
  const Vector4<S> inverse(-Q0[0], -Q0[1], -Q0[2], Q0[3]);
  const Product<S, P> product(inverse, Q1);
  S w = product.w.value();
  // Near half a turn the sign of w decides the axis.
  if constexpr (!side_by_side<S>)
    if (absolute<S>(w) < eps<S>() * (P == Precision::fast ? S(16) : S(1) / S(16)))
      w = exact_dot<S, 4>(Q0, Q1);
  const S turn = sign<S>(w);
  if constexpr (P == Precision::fast) {
    const auto [D, v] = nearRotation<S, P>(Q0, Q1, turn);
    if (S(4) * dot<S>(v, v) < mul_add(D[3], D[3], mul_add(D[0], D[0], mul_add(D[1], D[1], S(D[2] * D[2])))))
      return SO3<S>(nearest<S>(Q0, Q1, turn), absolute<S>(w));
    return SO3<S>(v, absolute<S>(w));
  } else {
    const Vector3<S> v(turn * product.x.value(), turn * product.y.value(), turn * product.z.value());
    if constexpr (!side_by_side<S>)
      if (dot<S>(v, v) < S(2048) * eps<S>()) return SO3<S>(nearest<S>(Q0, Q1, turn), absolute<S>(w));
    return SO3<S>(v, absolute<S>(w));
  }
}

}  // namespace se3_configuration_detail

/// T exp(delta) as [p; x y z w]; Q1 . Q0 >= 0: the quaternion nearer to the one it came from. Pose q [7; m],
/// delta [6; m, rad].
/// Error: rotation 2 eps, translation 4 eps of max(|p1|, |p0|, |rho|), up to half a turn; beyond, the excess
/// rule. Norm: ||Q1|^2 - 1| <= 3 eps + 3/4 d^2; the rotation is that of Q0/|Q0| whatever d.
template <Scalar S, Precision P = Precision::standard>
Vector7<S> integrateSE3(const Vector7<S>& q, const Vector6<S>& delta) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [](const auto& a, const auto& b) { return integrateSE3<DoubleDouble<S>, Precision::fast>(a, b); },
        [&] { return integrateSE3<S>(q, delta); }, q, delta);
  const RotationCoefficients<S, Vector3<S>, P> k(Vector3<S>(delta[3], delta[4], delta[5]));
  const SO3<S> Q0(Vector4<S>(q[3], q[4], q[5], q[6]));
  // Q0 . Q1 = |Q0|^2 cos(theta/2).
  const S turn = sign<S>(k.cosine_half), sine = turn * k.sine_half;
  const Vector4<S> Q_01(sine * k.axis[0], sine * k.axis[1], sine * k.axis[2], turn * k.cosine_half);
  const Vector3<S> step =
      Q0.template act<P>(exp_log_detail::arc(k, Vector3<S>(delta[0], delta[1], delta[2])));
  const Vector4<S> Q1 = se3_configuration_detail::Product<S, P>(Q0.to_vector(), Q_01).normalized();
  Vector7<S> result;
  for (int i = 0; i < 3; ++i) result[i] = q[i] + step[i];
  for (int i = 0; i < 4; ++i) result[3 + i] = Q1[i];
  return result;
}

/// (rho, phi) = log(T0^-1 T1) [6; m, rad], |phi| <= pi, the same for Q and -Q; at exactly half a turn either
/// sign. Error 2 eps of |phi|, and 4 eps of max(|rho|, |p1 - p0|), at any distance; it does not depend on
/// |Q0|, |Q1|.
template <Scalar S, Precision P = Precision::standard>
Vector6<S> differenceSE3(const Vector7<S>& q0, const Vector7<S>& q1) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [](const auto& a, const auto& b) { return differenceSE3<DoubleDouble<S>, Precision::fast>(a, b); },
        [&] { return differenceSE3<S>(q0, q1); }, q0, q1);
  const Vector4<S> Q0(q0[3], q0[4], q0[5], q0[6]), Q1(q1[3], q1[4], q1[5], q1[6]);
  const exp_log_detail::RotationLogarithm<S, P> log(se3_configuration_detail::relativeRotation<S, P>(Q0, Q1));
  const Vector3<S> p_01(q1[0] - q0[0], q1[1] - q0[1], q1[2] - q0[2]);
  const Vector3<S> rho = log.arc(SO3<S>(Q0).template actInv<P>(p_01));
  Vector6<S> delta;
  for (int i = 0; i < 3; ++i) delta[i] = rho[i], delta[3 + i] = log.phi[i];
  return delta;
}

/// How integrate follows q (ARG0: Ad(exp(-delta))) or delta (ARG1: the right Jacobian of exp). 6 x 6; neither
/// depends on q. Error 6 eps of each 3 x 3 block up to half a turn; beyond, the excess rule.
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> dIntegrateSE3([[maybe_unused]] const Vector7<S>& q, const Vector6<S>& delta,
                         ArgumentPosition argument) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [=](const auto& a, const auto& b) {
          return dIntegrateSE3<DoubleDouble<S>, Precision::fast>(a, b, argument);
        },
        [&] { return dIntegrateSE3<S>(q, delta, argument); }, q, delta);
  const Motion<S> xi(delta);
  return argument == ArgumentPosition::ARG0 ? exp6<S, P>(-xi).toActionMatrix() : rightJacobian<S, P>(xi);
}

/// How difference follows q0 (ARG0: -J_l^-1) or q1 (ARG1: J_r^-1). 6 x 6. At exactly half a turn: of the
/// branch that differenceSE3 returns. Error 6 eps of each 3 x 3 block, that of difference included.
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> dDifferenceSE3(const Vector7<S>& q0, const Vector7<S>& q1, ArgumentPosition argument) {
  if constexpr (P == Precision::tight)
    return tight_detail::rounded<S>(
        [=](const auto& a, const auto& b) {
          return dDifferenceSE3<DoubleDouble<S>, Precision::fast>(a, b, argument);
        },
        [&] { return dDifferenceSE3<S>(q0, q1, argument); }, q0, q1);
  const Motion<S> xi(differenceSE3<S, P>(q0, q1));
  if (argument == ArgumentPosition::ARG0) return -leftJacobianInverse<S, P>(xi);
  return rightJacobianInverse<S, P>(xi);
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
