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
// Domain: finite q with Q != 0 of any norm. Q represents the rotation of Q/|Q|. Error bounds hold for every norm;
// in other scalars than float and double, see so3.hpp. Q = 0 is refused. To refuse quaternions that are off unit,
// call checkedConfiguration of configuration.hpp.

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

/// The quaternion in q.
template <Scalar S, Precision P>
struct Quaternion {
  SplitFactor<Quad<S>, 1, P> split;
  S excess;  ///< |Q|^2 - 1

  [[gnu::always_inline]] explicit Quaternion(const Vector7<S>& q)
      : split(Quad<S>(q[3], q[4], q[5], q[6])), excess(norm_excess(split).high + norm_excess(split).low) {}
  /// Q = high + low.
  [[gnu::always_inline]] Quaternion(const Quad<S>& high, const Quad<S>& low)
      : split(SplitFactor<Quad<S>, 1, P>(high).plus(low)),
        excess(norm_excess(split).high + norm_excess(split).low) {}
  [[gnu::always_inline]] bool firstOrderSuffices() const {
    return unit_vector_detail::firstOrderSuffices<S>(excess);
  }
  /// R x for SIGN = 1, R^T x for SIGN = -1, x + x_low [3, padded] of length <= bound.
  template <int SIGN, class... Low>
  [[gnu::always_inline]] Vector3<S> rotate(const S& bound, const Quad<S>& x, const Low&... x_low) const {
    const Quad<S> sigma(S(bound * SO3<S>::split_factor())),
        r = rotated<P, SIGN>(split, excess, sigma, x, x_low...);
    return Vector3<S>(r.v[0], r.v[1], r.v[2]);
  }
  /// R^T (p1 - p0).
  [[gnu::always_inline]] Vector3<S> rotateBack(const Vector7<S>& q0, const Vector7<S>& q1) const {
    const auto x = two_sum<S>(q1[0], -q0[0]), y = two_sum<S>(q1[1], -q0[1]), z = two_sum<S>(q1[2], -q0[2]);
    const S bound = absolute<S>(x.high) + absolute<S>(y.high) + absolute<S>(z.high);
    if constexpr (P == Precision::fast) return rotate<-1>(bound, Quad<S>(x.high, y.high, z.high, S(0)));
    return rotate<-1>(bound, Quad<S>(x.high, y.high, z.high, S(0)), Quad<S>(x.low, y.low, z.low, S(0)));
  }
};

/// Q0 Q1 [x y z w] of two quaternions of norm about 1, in double words.
template <Scalar S, Precision P>
struct Product {
  SplitDot<Quad<S>, 1, P> sum;
  using Factor = SplitFactor<Quad<S>, 1, P>;
  [[gnu::always_inline]] Product(const Quad<S>& a, const Quad<S>& q) : Product(Factor(a), q) {}
  [[gnu::always_inline]] Product(const Factor& a, const Quad<S>& q) : sum(product<S, P>(a, Factor(q))) {}
  /// The product, normalised up to 3/8 excess^2, excess = |Q0|^2 |Q1|^2 - 1. Each number is rounded once.
  [[gnu::always_inline]] Vector4<S> normalized(const S& excess) const {
    const Quad<S> q = sum.high + mul_add(Quad<S>(excess / S(-2)), sum.value(), sum.low());
    return Vector4<S>(q.v[0], q.v[1], q.v[2], q.v[3]);
  }
};

/// a* b, each number with a relative error of 2 eps, however much cancels.
template <Scalar S>
[[gnu::noinline, gnu::cold]] Vector4<S> exactProduct(Quad<S> a, Quad<S> b) {
  const auto entry = [&](int i, int j, int k) {
    return exact_dot<S, 4>(Vector4<S>(a.v[3], -a.v[i], -a.v[j], a.v[k]),
                           Vector4<S>(b.v[i], b.v[3], b.v[k], b.v[j]));
  };
  return Vector4<S>(entry(0, 1, 2), entry(1, 2, 0), entry(2, 0, 1), exact_dot<S, 4>(a.v, b.v));
}

/// v + v_low.
template <Scalar S>
struct VectorPart {
  Vector3<S> v, v_low;
};
/// The vector part of factor a* b, however much cancels. A subnormal number is rounded once, at the end.
template <Scalar S>
[[gnu::noinline, gnu::cold]] VectorPart<S> exactVectorPart(const Quad<S>& a, const Quad<S>& b, S factor) {
  const S small = eps<S>() * eps<S>();
  const Vector4<S> exact = exactProduct<S>(a, b * Quad<S>(S(1) / small));
  return {each<S>([&](int i) { return S(exact[i] * S(factor * small)); }), Vector3<S>(S(0), S(0), S(0))};
}
/// The vector part of s Q0* Q1, s = sgn(Q0 . Q1), of close rotations. It is that of Q0* D, D = s Q1 - Q0,
/// since that of Q0* Q0 is 0. The subtraction is exact except in components that are small, so the error is 1
/// eps. If the norms differ so much that D is much longer than the vector part, the product is computed
/// exactly.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline VectorPart<S> nearRotation(const Quaternion<S, P>& Q0,
                                                         const Quaternion<S, P>& Q1, const S& s) {
  const Quad<S> D = Quad<S>(s) * Q1.split.value - Q0.split.value;
  const S bound = sum(fabs(D)), least = bound / S(P == Precision::fast ? 8 : 256);
  if constexpr (!side_by_side<S>)
    if (bound < std::numeric_limits<S>::min() / (eps<S>() * eps<S>()) && bound > S(0)) [[unlikely]]
      return exactVectorPart<S>(Q0.split.value, D, S(1));
  const SplitFactor<Quad<S>, 1, P> factor(D, Quad<S>(S(bound * SO3<S>::split_factor())));
  const auto sum = product<S, P, -1>(Q0.split, factor);
  const Quad<S> v = sum.value(), low = sum.rounding_error(v);
  const VectorPart<S> result{Vector3<S>(v.v[0], v.v[1], v.v[2]), Vector3<S>(low.v[0], low.v[1], low.v[2])};
  if constexpr (!side_by_side<S>)
    if (dot<S>(result.v, result.v) < least * least) [[unlikely]]
      return exactVectorPart<S>(Q0.split.value, Q1.split.value, s);
  return result;
}

/// log(Q0* Q1), from the product in double words. The vector part has full relative accuracy, even if the two
/// rotations are close. Then it alone decides, and short series suffice.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline exp_log_detail::RotationLogarithm<S, P> relativeLogarithm(
    const Quaternion<S, P>& Q0, const Quaternion<S, P>& Q1) {
  const S excess = product_excess<S>(Q0.excess, Q1.excess);
  const S cosine = liecheck::sum(Q0.split.value * Q1.split.value);  // known sooner than in double words
  if constexpr (!side_by_side<S>)
    if (absolute<S>(cosine) > S(1) - S(1) / S(1024) && excess * excess < eps<S>() / S(8)) {  // |v| < 1/16
      const auto [v, v_low] = nearRotation<S, P>(Q0, Q1, sign<S>(cosine));
      return exp_log_detail::RotationLogarithm<S, P>(v, v_low,
                                                     LogarithmCoefficients<S>::near(dot<S>(v, v), excess));
    }
  const auto sum = product<S, P, -1>(Q0.split, Q1.split);
  const Quad<S> Q = sum.value(), Q_low = sum.rounding_error(Q);
  DoubleWord<S> w(Q.v[3], Q_low.v[3]);
  // Near theta = pi the sign of w decides the sign of the axis, so w is computed exactly.
  if constexpr (!side_by_side<S>)
    if (absolute<S>(w.high) < eps<S>() * (P == Precision::fast ? S(16) : S(1) / S(16))) [[unlikely]]
      w = DoubleWord<S>(exactProduct<S>(Q0.split.value, Q1.split.value)[3]);
  const S s = sign<S>(w.high);
  Vector3<S> v(s * Q.v[0], s * Q.v[1], s * Q.v[2]), v_low(s * Q_low.v[0], s * Q_low.v[1], s * Q_low.v[2]);
  const S square = dot<S>(v, v), close = P == Precision::fast ? S(1) / S(64) : S(2048) * eps<S>();
  if constexpr (side_by_side<S>) {
    if (const auto lanes = S::less(square, close); S::any(lanes)) {
      const Vector3<S> v_near = nearRotation<S, P>(Q0, Q1, sign<S>(cosine)).v;
      for (int i = 0; i < 3; ++i)
        v[i] = S::select(lanes, v_near[i], v[i]), v_low[i] = S::select(lanes, S(0), v_low[i]);
    }
  } else if (square < close) {  // of quaternions off unit
    v = nearRotation<S, P>(Q0, Q1, sign<S>(cosine)).v, v_low = Vector3<S>(S(0), S(0), S(0));
  }
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

/// Q0 is the quaternion of q with a norm for which firstOrderSuffices.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector7<S> integrate(const Vector7<S>& q, const Vector6<S>& delta,
                                                   const Quaternion<S, P>& Q0) {
  const Vector3<S> phi(delta[3], delta[4], delta[5]);
  return with_coefficients<S, P>(
      phi, [&q, &delta, &Q0 ](const auto& k) __attribute__((always_inline)) {
        const Vector3<S> rho(delta[0], delta[1], delta[2]);
        // Q0 . Q1 = |Q0|^2 cos(theta/2).
        const S s = sign<S>(k.cosine_half), sine = s * k.sine_half;
        const S x = sine * k.axis[0], y = sine * k.axis[1], z = sine * k.axis[2], w = s * k.cosine_half;
        const Vector3<S> arc = exp_log_detail::arc(k, rho),
                         step = Q0.template rotate<1>(norm1<S>(rho), Quad<S>(arc[0], arc[1], arc[2], S(0)));
        const S excess = mul_add(w, w, S(-1)) + mul_add(x, x, mul_add(y, y, S(z * z)));
        const Vector4<S> Q1 =
            Product<S, P>(Q0.split, Quad<S>(x, y, z, w)).normalized(product_excess<S>(Q0.excess, excess));
        Vector7<S> result;
        store_wide(result.data(), S(q[0] + step[0]), S(q[1] + step[1]), S(q[2] + step[2]), Q1[0], Q1[1],
                   Q1[2], Q1[3]);
        return result;
      });
}
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector7<S> integrate(const Vector7<S>& q, const Vector6<S>& delta) {
  const Quaternion<S, P> Q0(q);
  if constexpr (!side_by_side<S>)
    if (!Q0.firstOrderSuffices()) [[unlikely]]
      return integrateOffUnit<S, P>(q, delta);
  return integrate<S, P>(q, delta, Q0);
}
/// The quaternion is scaled by a power of two, which rounds nothing, and by a rounded 1/|Q|, as a double word.
template <Scalar S, Precision P>
[[gnu::noinline, gnu::cold]] Vector7<S> integrateOffUnit(const Vector7<S>& q, const Vector6<S>& delta) {
  using std::sqrt;
  const Vector4<S> Q = unit_vector_detail::scaledByPowerOfTwo<S, 4>(quaternionOf(q));
  const S factor = S(1) / S(sqrt(unit_vector_detail::square<S, 4>(Q)));
  Vector4<S> high, low;
  for (int i = 0; i < 4; ++i) {
    const DoubleWord<S> product = two_prod<S>(Q[i], factor);
    high[i] = product.high, low[i] = product.low;
  }
  return integrate<S, P>(
      q, delta,
      Quaternion<S, P>(Quad<S>(high[0], high[1], high[2], high[3]), Quad<S>(low[0], low[1], low[2], low[3])));
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
/// The quaternions may have any norms with |Q|^2 < 2. `unit` is Q0 with a norm for which firstOrderSuffices.
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector6<S> difference(const Vector7<S>& q0, const Vector7<S>& q1,
                                                    const Quaternion<S, P>& Q0, const Quaternion<S, P>& Q1,
                                                    const Quaternion<S, P>& unit) {
  const auto log = relativeLogarithm(Q0, Q1);
  const Vector3<S> p = unit.rotateBack(q0, q1);
  const Vector3<S> rho = log.arc(p);
  Vector6<S> delta;
  store_wide(delta.data(), rho[0], rho[1], rho[2], log.phi[0], log.phi[1], log.phi[2]);
  return delta;
}
template <Scalar S, Precision P>
[[gnu::always_inline]] inline Vector6<S> difference(const Vector7<S>& q0, const Vector7<S>& q1) {
  const Quaternion<S, P> Q0(q0), Q1(q1);
  if constexpr (!side_by_side<S>)
    if (!Q0.firstOrderSuffices() || !Q1.firstOrderSuffices()) [[unlikely]]
      return differenceOffUnit<S, P>(q0, q1);
  return difference<S, P>(q0, q1, Q0, Q1, Q0);
}
/// The quaternions are scaled by powers of two. That rounds nothing, so that the rotation between near ones
/// keeps its digits. The rest is computed in double words, if S is float or double.
template <Scalar S, Precision P>
[[gnu::noinline, gnu::cold]] Vector6<S> differenceOffUnit(Vector7<S> q0, Vector7<S> q1) {
  for (Vector7<S>* q : {&q0, &q1}) {
    const Vector4<S> Q = unit_vector_detail::scaledByPowerOfTwo<S, 4>(quaternionOf(*q));
    for (int i = 0; i < 4; ++i) (*q)[3 + i] = Q[i];
  }
  using T = std::conditional_t<std::is_floating_point_v<S>, DoubleWord<S>, S>;
  constexpr Precision p = std::is_same_v<T, S> ? P : Precision::fast;
  const Vector7<T> a = q0.template cast<T>(), b = q1.template cast<T>();
  Vector7<T> unit = a;
  unit.template tail<4>() = normalizedUnit<T, 4>(quaternionOf(a));
  return difference<T, p>(a, b, Quaternion<T, p>(a), Quaternion<T, p>(b), Quaternion<T, p>(unit))
      .template cast<S>();
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
/// Throws std::invalid_argument if Q0 = 0.
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

/// T0 exp(t log(T0^-1 T1)) [7; m]: the pose at t in [0, 1] of the screw motion from q0 to q1, computed from the nearer end.
/// If the relative angle is pi, either arc. Error 8 eps of the rotation, 12 eps max(|p|, |p0|, |p1|).
/// Throws std::invalid_argument if Q0 or Q1 is 0.
template <Scalar S>
Vector7<S> interpolateSE3(const Vector7<S>& q0, const Vector7<S>& q1, const S& t);

/// (rho, phi) = log(T0^-1 T1) [6; m, rad], |phi| <= pi, the same for Q and -Q. At |phi| = pi the axis has
/// either sign. Error 2 eps of |phi|, and 4 eps of max(|rho|, |p1 - p0|).
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

template <Scalar S>
Vector7<S> interpolateSE3(const Vector7<S>& q0, const Vector7<S>& q1, const S& t) {
  if (S(1) / S(2) < t) return interpolateSE3<S>(q1, q0, S(S(1) - t));
  return integrateSE3<S>(q0, Vector6<S>(t * differenceSE3<S>(q0, q1)));
}

/// log(T0^-1 T1) of the rotations nearest to the stored matrices, (rho, phi) [m, rad], |phi| <= pi, in the
/// axes of T0's body. The chain log6(T0.actInv(T1)) rounds R0^T R1, so phi has an absolute error of about eps
/// even if it is small. Here everything is computed in double words and rounded once. Error for |R^T R - I|
/// <= 8 eps: 1 eps of |phi|, and 1 eps of max(|rho|, |p1 - p0|). At |phi| = pi the axis has either sign.
template <Scalar S>
Motion<S> difference(const SE3<S>& T0, const SE3<S>& T1) {
  return evaluate<S, Precision::tight, Precision::standard>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const SE3<T>& a, const SE3<T>& b) {
        const auto stored = [](const SE3<T>& X) {
          Vector7<T> q;
          q << X.translation(), SO3<T>::template fromMatrix<Q>(X.rotation()).to_vector();
          return q;
        };
        return Motion<T>(differenceSE3 < T,
                         std::is_same_v<T, S> ? Q : Precision::fast > (stored(a), stored(b)));
      },
      T0, T1);
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
/// difference: 4.2 eps of a rotation block, 7 eps of the coupling block.
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
/// [R, 0; 0, 1/2 (w I + [v]); 0, -1/2 v^T], with R of Q/|Q|, and v and w of the stored Q. Error of each entry
/// 4 eps. Throws std::invalid_argument if Q = 0.
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
