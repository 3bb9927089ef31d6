#pragma once
// SE_2(3): extended poses, a rotation R with a position p and a velocity v in parent axes, as a matrix
// [[R, v, p], [0, I_2]]. Tangents are xi = (rho [m], nu [m/s], phi [rad]), in body axes.
//
//   exp(xi) = (exp [phi], J_l(phi) rho, J_l(phi) nu)           J_l that of SO(3)
//
// Each of the two translations is that of SE(3), with the same phi: the functions and bounds of spatial/exp_log.hpp and
// spatial/jacobians.hpp apply to each. Source: Brossard et al. 2022, Associating uncertainty to extended poses, eqs. 9-21.

#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/jacobians.hpp>

namespace liecheck {

template <class S>
using Vector9 = Eigen::Matrix<S, 9, 1>;
template <class S>
using Matrix9 = Eigen::Matrix<S, 9, 9>;

template <Scalar S>
struct ExtendedPose {
  Matrix3<S> R;
  Vector3<S> p, v;
  /// R row by row, then p and v, shape 15.
  Eigen::Matrix<S, 15, 1> to_vector() const {
    Eigen::Matrix<S, 15, 1> x;
    for (int i = 0; i < 9; ++i) x[i] = R(i / 3, i % 3);
    x << x.template head<9>().eval(), p, v;
    return x;
  }
};

namespace extended_pose_detail {

template <Scalar S>
Vector3<S> part(const Vector9<S>& xi, int i) {
  return xi.template segment<3>(3 * i);
}
/// [[J, 0, A], [0, J, B], [0, 0, J]].
template <Scalar S>
Matrix9<S> blocks(const Matrix3<S>& J, const Matrix3<S>& A, const Matrix3<S>& B) {
  Matrix9<S> m = Matrix9<S>::Zero();
  for (int i = 0; i < 3; ++i) m.template block<3, 3>(3 * i, 3 * i) = J;
  m.template block<3, 3>(0, 6) = A, m.template block<3, 3>(3, 6) = B;
  return m;
}

}  // namespace extended_pose_detail

/// exp(xi). Rotation 2 eps, position and velocity 4 eps.
template <Scalar S>
ExtendedPose<S> exp9(const Vector9<S>& xi) {
  using extended_pose_detail::part;
  const Vector3<S> rho = part(xi, 0), nu = part(xi, 1), phi = part(xi, 2);
  return with_coefficients<S, Precision::standard>(
      phi, [&](const auto& k) __attribute__((always_inline)) {
        return ExtendedPose<S>{exp_log_detail::matrix(k), exp_log_detail::arc(k, rho),
                               exp_log_detail::arc(k, nu)};
      });
}
/// (rho, nu, phi) of X, |phi| <= pi. Error 3 eps of phi, 4 eps of rho and of nu.
template <Scalar S>
Vector9<S> log9(const ExtendedPose<S>& X) {
  const exp_log_detail::RotationLogarithm<S> l(SO3<S>::doubleWordsFromMatrix(X.R));
  const Vector3<S> rho = l.arc(X.p), nu = l.arc(X.v);
  Vector9<S> xi;
  for (int i = 0; i < 3; ++i) xi[i] = rho[i], xi[3 + i] = nu[i], xi[6 + i] = l.phi[i];
  return xi;
}
/// The left Jacobian [9 x 9] of exp9: [[J, 0, C(rho, phi)], [0, J, C(nu, phi)], [0, 0, J]], with the bounds of that of SE(3).
template <Scalar S>
Matrix9<S> leftJacobian(const Vector9<S>& xi) {
  using extended_pose_detail::part;
  const Vector3<S> rho = part(xi, 0), nu = part(xi, 1), phi = part(xi, 2);
  return jacobian_detail::with_left_jacobian<S, Precision::standard>(
      phi, [&](const auto& b) __attribute__((always_inline)) {
        return extended_pose_detail::blocks<S>(b.block(), b.coupling(rho), b.coupling(nu));
      });
}
template <Scalar S>
Matrix9<S> rightJacobian(const Vector9<S>& xi) {
  return leftJacobian<S>(Vector9<S>(-xi));
}
/// Ad_X [9 x 9]: X exp(xi) X^-1 = exp(Ad_X xi). Error 2 eps.
template <Scalar S>
Matrix9<S> adjoint(const ExtendedPose<S>& X) {
  const auto moved = [&X](const Vector3<S>& p) __attribute__((always_inline)) {
    return product<S>(skew<S>(p), X.R);
  };
  return extended_pose_detail::blocks<S>(X.R, moved(X.p), moved(X.v));
}

}  // namespace liecheck
