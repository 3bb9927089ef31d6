#pragma once
// Jacobians of the exponential of SO(3) and SE(3), left and right, and their inverses.
//
//   exp(xi + d) = exp(J_l(xi) d) exp(xi) + O(d^2) = exp(xi) exp(J_r(xi) d) + O(d^2),   J_r(xi) = J_l(-xi)
//
//   SO(3)  J_l(phi)    = I + c2 [phi] + c3 [phi]^2                         J_l^-1 = I - 1/2 [phi] + d [phi]^2
//   SE(3)  J_l(rho, phi) = [ J_l(phi)  Q ]      Q = dJ_l along rho
//                          [ 0   J_l(phi)]        = c2 [rho] + c3 ([phi][rho] + [rho][phi])
//                                                   - g (phi . rho) [phi] - h (phi . rho) [phi]^2
//          J_l^-1 = [ J_l^-1(phi)  Qi ; 0  J_l^-1(phi) ],
//                  Qi = dJ_l^-1 along rho = -1/2 [rho] + d ([phi][rho] + [rho][phi]) + d2 (phi . rho) [phi]^2
//
// with g = c3 - 2 c4, h = c4 - 3 c5; stumpff.hpp defines d and d2. The coupling block is the directional
// derivative of the rotation block along rho, because (phi + e rho) with e^2 = 0 is the twist as a dual
// vector. (Barfoot & Furgale 2014, eq. 102, is the same Q written with nested products.)
//
// Error of each 3 x 3 block: 6 eps of its Frobenius norm for |phi| <= pi; beyond pi the excess rule applies.

#include <liecheck/scalar/stumpff.hpp>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/motion.hpp>

namespace liecheck {

namespace jacobian_detail {

/// [t] + [a][u] + [u][a], computed with [a][u] + [u][a] = a u^T + u a^T - 2 (a . u) I.
template <Scalar S>
[[gnu::always_inline]] inline Matrix3<S> skew_and_symmetric(const Vector3<S>& t, const Vector3<S>& a,
                                                            const Vector3<S>& u) {
  const S xx = a[0] * u[0], yy = a[1] * u[1], zz = a[2] * u[2];
  const S xy = mul_add(a[0], u[1], S(a[1] * u[0])), yz = mul_add(a[1], u[2], S(a[2] * u[1])),
          zx = mul_add(a[2], u[0], S(a[0] * u[2]));
  return rows<S>(S(-2) * (yy + zz), xy - t[2], zx + t[1], xy + t[2], S(-2) * (xx + zz), yz - t[0], zx - t[1],
                 yz + t[0], S(-2) * (xx + yy));
}

/// Coefficients of the blocks of J_l or J_l^-1, for the axis a = phi / t of RotationCoefficients.
template <Scalar S, Precision P>
struct BlockCoefficients {
  Vector3<S> axis;
  S b1, b2;          // block    I + b1 [a] + b2 [a]^2
  S r0, r1, r2, r3;  // coupling r0 [rho] + r1 ([a][rho] + [rho][a]) + (a . rho)(r2 [a] + r3 [a]^2)

  [[gnu::always_inline]] static BlockCoefficients of(const RotationCoefficients<S, Vector3<S>, P>& k) {
    BlockCoefficients b;
    b.axis = k.axis;
    b.b1 = k.k2;
    b.b2 = k.k3;
    if (k.within_pi)
      b.r0 = k.k2, b.r1 = k.k3;
    else
      b.r0 = k.k2 / k.theta, b.r1 = k.k3 / k.theta;
    b.r2 = k.slope2;
    b.r3 = k.slope3;
    return b;
  }

  [[gnu::always_inline]] static BlockCoefficients inverse(const Vector3<S>& phi, const S& x) {
    const InverseCoefficient<S> c(x);
    BlockCoefficients b;
    b.axis = phi;
    b.b1 = b.r0 = S(-1) / S(2);
    b.b2 = b.r1 = c.d;
    b.r2 = S(0);
    b.r3 = c.d2;
    return b;
  }
  static BlockCoefficients inverseBeyondPi(const Vector3<S>& phi, const S& x) {
    const auto k = stumpff_detail::beyond_pi<S>(stumpff_detail::large_angle<S>(phi, x));
    const S cot = k.cosine_half / k.sine_half;
    BlockCoefficients b;
    b.axis = phi / k.theta;
    b.b1 = -k.theta / S(2);
    b.b2 = S(1) - k.theta / S(2) * cot;
    b.r0 = S(-1) / S(2);
    b.r1 = b.b2 / k.theta;
    b.r2 = S(0);
    // 2 d' theta^3, where d = (1 - (theta/2) cot(theta/2)) / theta^2.
    b.r3 = k.theta / S(4) / (k.sine_half * k.sine_half) + cot / S(2) - S(2) / k.theta;
    return b;
  }

  /// The blocks of J_r, which are those of J_l at -phi and -rho.
  [[gnu::always_inline]] BlockCoefficients right() const {
    BlockCoefficients b = *this;
    b.b1 = -b1, b.r0 = -r0, b.r2 = -r2;
    return b;
  }
  [[gnu::always_inline]] Matrix3<S> block() const { return exp_log_detail::quadratic<S>(axis, b1, b2); }
  /// r1 ([a][rho] + [rho][a]) + r3 (a . rho) [a]^2 = [a][u] + [u][a], u = r1 rho + r3 (a . rho) / 2 a.
  [[gnu::always_inline]] Matrix3<S> coupling(const Vector3<S>& rho) const {
    const S along = dot<S>(axis, rho), a2 = r2 * along, a3 = r3 * along / S(2);
    return skew_and_symmetric<S>(each<S>([&](int i) { return mul_add(r0, rho[i], S(a2 * axis[i])); }), axis,
                                 each<S>([&](int i) { return mul_add(r1, rho[i], S(a3 * axis[i])); }));
  }
  [[gnu::always_inline]] Matrix6<S> matrix(const Vector3<S>& rho) const {
    Matrix6<S> J;
    J.template topLeftCorner<3, 3>() = block();
    J.template topRightCorner<3, 3>() = coupling(rho);
    J.template bottomLeftCorner<3, 3>().setZero();
    J.template bottomRightCorner<3, 3>() = J.template topLeftCorner<3, 3>();
    return J;
  }
};

/// Returns f(coefficients of J_l(phi)).
template <Scalar S, Precision P, class F>
[[gnu::always_inline]] inline auto with_left_jacobian(const Vector3<S>& phi, F f) {
  return with_coefficients<S, P>(
      phi, [&f](const auto& k) __attribute__((always_inline)) { return f(BlockCoefficients<S, P>::of(k)); });
}
/// Returns f(coefficients of J_l^-1(phi)). The rare case |phi| > pi is compiled as a separate function.
template <Scalar S, Precision P, class F>
[[gnu::noinline, gnu::cold]] auto with_left_inverse_beyond_pi(const Vector3<S>& phi, const S& x, F f) {
  return f(BlockCoefficients<S, P>::inverseBeyondPi(phi, x));
}
template <Scalar S, Precision P, class F>
[[gnu::always_inline]] inline auto with_left_inverse(const Vector3<S>& phi, F f) {
  const S x = squared_angle<S, Precision::fast>(phi).high;
  if constexpr (!side_by_side<S>)
    if (!within_pi(x)) [[unlikely]]
      return with_left_inverse_beyond_pi<S, P>(each<S>([&phi](int i) { return phi[i]; }), x, f);
  return f(BlockCoefficients<S, P>::inverse(phi, x));
}

}  // namespace jacobian_detail

/// J_l(phi) [3 x 3], phi [3, rad].
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> leftJacobian(const Vector3<S>& phi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector3<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_jacobian<T, Q>(
            x, [](const auto& b) __attribute__((always_inline)) { return b.block(); });
      },
      phi);
}
/// J_r(phi) = J_l(-phi) [3 x 3].
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> rightJacobian(const Vector3<S>& phi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector3<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_jacobian<T, Q>(
            x, [](const auto& b) __attribute__((always_inline)) { return b.right().block(); });
      },
      phi);
}
/// J_l^-1(phi) [3 x 3]. Singular at |phi| = 2 pi k, k >= 1.
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> leftJacobianInverse(const Vector3<S>& phi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector3<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_inverse<T, Q>(
            x, [](const auto& b) __attribute__((always_inline)) { return b.block(); });
      },
      phi);
}
/// J_r^-1(phi) = J_l^-1(-phi) [3 x 3].
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> rightJacobianInverse(const Vector3<S>& phi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Vector3<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_inverse<T, Q>(
            x, [](const auto& b) __attribute__((always_inline)) { return b.right().block(); });
      },
      phi);
}

/// J_l(xi) [6 x 6], xi = (rho [m], phi [rad]).
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> leftJacobian(const Motion<S>& xi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Motion<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_jacobian<T, Q>(
            x.angular(), [&x](const auto& b) __attribute__((always_inline)) { return b.matrix(x.linear()); });
      },
      xi);
}
/// J_r(xi) = J_l(-xi) [6 x 6].
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> rightJacobian(const Motion<S>& xi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Motion<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_jacobian<T, Q>(
            x.angular(), [&x](const auto& b)
                             __attribute__((always_inline)) { return b.right().matrix(x.linear()); });
      },
      xi);
}
/// J_l^-1(xi) [6 x 6]. Singular at |phi| = 2 pi k, k >= 1.
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> leftJacobianInverse(const Motion<S>& xi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Motion<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_inverse<T, Q>(
            x.angular(), [&x](const auto& b) __attribute__((always_inline)) { return b.matrix(x.linear()); });
      },
      xi);
}
/// J_r^-1(xi) = J_l^-1(-xi) [6 x 6].
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> rightJacobianInverse(const Motion<S>& xi) {
  return evaluate<S, P>(
      []<Scalar T, Precision Q>(Arithmetic<T, Q>, const Motion<T>& x) __attribute__((always_inline)) {
        return jacobian_detail::with_left_inverse<T, Q>(
            x.angular(), [&x](const auto& b)
                             __attribute__((always_inline)) { return b.right().matrix(x.linear()); });
      },
      xi);
}

/// Pinocchio's names: Jexp is J_r, and Jlog is J_r^-1 at the logarithm.
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> Jexp3(const Vector3<S>& phi) {
  return rightJacobian<S, P>(phi);
}
template <Scalar S, Precision P = Precision::standard>
Matrix3<S> Jlog3(const Matrix3<S>& R) {
  return evaluate<S, P, Precision::standard>(
      []<Scalar U, Precision Q>(Arithmetic<U, Q>, const Matrix3<U>& x)
          __attribute__((always_inline)) { return rightJacobianInverse<U, Q>(log3<U, Q>(x)); },
      R);
}
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> Jexp6(const Motion<S>& xi) {
  return rightJacobian<S, P>(xi);
}
template <Scalar S, Precision P = Precision::standard>
Matrix6<S> Jlog6(const SE3<S>& T) {
  return evaluate<S, P, Precision::standard>(
      []<Scalar U, Precision Q>(Arithmetic<U, Q>, const SE3<U>& x)
          __attribute__((always_inline)) { return rightJacobianInverse<U, Q>(log6<U, Q>(x)); },
      T);
}

}  // namespace liecheck
