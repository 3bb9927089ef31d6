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
  const SE3<S> X = exp6<S>(Motion<S>(part(xi, 0), part(xi, 2))),
               Y = exp6<S>(Motion<S>(part(xi, 1), part(xi, 2)));
  return {X.rotation(), X.translation(), Y.translation()};
}
/// (rho, nu, phi) of X, |phi| <= pi. Error 3 eps of phi, 4 eps of rho and of nu.
template <Scalar S>
Vector9<S> log9(const ExtendedPose<S>& X) {
  const Motion<S> x = log6<S>(SE3<S>(X.R, X.p)), y = log6<S>(SE3<S>(X.R, X.v));
  return (Vector9<S>() << x.linear(), y.linear(), x.angular()).finished();
}
/// The left Jacobian [9 x 9] of exp9: [[J, 0, C(rho, phi)], [0, J, C(nu, phi)], [0, 0, J]], with the bounds of that of SE(3).
template <Scalar S>
Matrix9<S> leftJacobian(const Vector9<S>& xi) {
  using extended_pose_detail::part;
  const Matrix6<S> x = leftJacobian<S>(Motion<S>(part(xi, 0), part(xi, 2))),
                   y = leftJacobian<S>(Motion<S>(part(xi, 1), part(xi, 2)));
  return extended_pose_detail::blocks<S>(x.template topLeftCorner<3, 3>(), x.template topRightCorner<3, 3>(),
                                         y.template topRightCorner<3, 3>());
}
template <Scalar S>
Matrix9<S> rightJacobian(const Vector9<S>& xi) {
  return leftJacobian<S>(Vector9<S>(-xi));
}
/// Ad_X [9 x 9]: X exp(xi) X^-1 = exp(Ad_X xi). Error 2 eps.
template <Scalar S>
Matrix9<S> adjoint(const ExtendedPose<S>& X) {
  return extended_pose_detail::blocks<S>(X.R, Matrix3<S>(skew<S>(X.p) * X.R), Matrix3<S>(skew<S>(X.v) * X.R));
}

}  // namespace liecheck
