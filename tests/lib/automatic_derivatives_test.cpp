// Derivatives by automatic differentiation of the library's templated operations, with the Jets of Ceres, beside the
// exact Jacobians: at 0, at pi, at zero increments, at -Q, and at both sides of each place where a formula changes.

#include <ceres/jet.h>
#include <gtest/gtest.h>
#include <liecheck/multibody/se3_configuration.hpp>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/jacobians.hpp>
#include <numbers>

// What the library asks of a scalar and Jets lack.
namespace ceres {
template <class T, int N>
Jet<T, N> operator/(const Jet<T, N>& a, int b) {
  return a / T(b);
}
template <class T, int N>
Jet<T, N> fabs(const Jet<T, N>& a) {
  return abs(a);
}
template <class T, int N>
Jet<T, N> ldexp(const Jet<T, N>& a, int e) {
  return a * Jet<T, N>(std::ldexp(T(1), e));
}
template <class T, int N>
Jet<T, N> frexp(const Jet<T, N>& a, int* e) {
  const T f = std::frexp(a.a, e);
  return Jet<T, N>(f, a.v * std::ldexp(T(1), -*e));
}
}  // namespace ceres

namespace liecheck {
namespace {

using S = ceres::Jet<double, 6>;
using V3 = Vector3<double>;
using V4 = Vector4<double>;
using V6 = Vector6<double>;
using V7 = Vector7<double>;
using M3 = Matrix3<double>;
using M6 = Matrix6<double>;
using Rows = Eigen::MatrixXd;

/// The numbers x with the derivatives J, one row for each number.
template <int N>
Eigen::Matrix<S, N, 1> seeded(const Eigen::Matrix<double, N, 1>& x, const Rows& J) {
  Eigen::Matrix<S, N, 1> y;
  for (int i = 0; i < N; ++i) {
    V6 d = V6::Zero();
    for (int k = 0; k < J.cols(); ++k) d[k] = J(i, k);
    y[i] = S(x[i], d);
  }
  return y;
}
Matrix3<S> seeded_matrix(const M3& R, const Rows& J) {
  Matrix3<S> X;
  const auto y = seeded<9>(R.transpose().reshaped(), J);
  for (int i = 0; i < 9; ++i) X(i / 3, i % 3) = y[i];
  return X;
}
/// The derivatives of a vector or matrix, one row for each number, row by row; only the first columns.
template <int R, int C>
Rows derivatives(const Eigen::Matrix<S, R, C>& y, int columns = 6) {
  Rows J(R * C, columns);
  for (int i = 0; i < R * C; ++i) {
    EXPECT_TRUE(std::isfinite(y(i / C, i % C).a));
    J.row(i) = y(i / C, i % C).v.head(columns).transpose();
  }
  return J;
}
M3 hat(const V3& a) {
  M3 m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}
/// The derivative of Q exp(d) at d = 0.
Rows turning(const V4& Q) {
  Rows N(4, 3);
  N << Q[3] * M3::Identity() + hat(Q.head<3>()), -Q.head<3>().transpose();
  return N / 2;
}
/// The derivative of R exp([d]) at d = 0, row by row.
Rows turning(const M3& R) {
  Rows N(9, 3);
  for (int k = 0; k < 3; ++k) N.col(k) = (R * hat(V3::Unit(k))).transpose().reshaped();
  return N;
}
V4 quaternion_of(const V3& phi) {
  return quaternion::exp3<double>(phi).to_vector();
}

/// Rotation vectors at both sides of every place where a formula changes, about two axes: 0, and from `least`
/// to `most`.
std::vector<V3> vectors(double most, double least = 0) {
  std::vector<double> angles = {0,    5e-324, 1e-310, 1e-200, 1e-155, 1e-100, 1e-20, 1e-10, 1.5e-8,
                                1e-5, 1e-3,   0.1,    1,      1.57,   2,      3,     3.14};
  const double pi = std::numbers::pi;
  for (int k = -40; k <= 40; ++k) angles.push_back(pi * (1 + k * 0x1p-52));
  for (const double t : {3.2, 5.0, 2 * pi - 1e-6, 20.0}) angles.push_back(t);
  std::vector<V3> all;
  for (const double t : angles)
    if (t <= most && (t == 0 || t >= least))
      for (const V3& axis : {V3(0, 0, 1), V3(V3(2, -1, 2) / 3)}) all.push_back(t * axis);
  return all;
}

// Below this angle theta^2 underflows. There the quotient by theta^2 in log6, and in difference, has a derivative
// that is not a number.
constexpr double not_underflowing = 1e-100;

/// A is finite, and |A - B| <= limit |B|, in eps: the limit of the profile `careful`.
void near(const Rows& A, const Rows& B, const char* what, const V3& phi) {
  constexpr double limit = 64;
  EXPECT_TRUE(A.allFinite()) << what << " at " << phi.transpose() << "\n" << A;
  EXPECT_LE((A - B).norm() / std::max(B.norm(), 1e-280) / 0x1p-52, limit)
      << what << " at " << phi.transpose() << "\n"
      << A << "\n\n"
      << B;
}

TEST(AutomaticDerivatives, OfExp3AreTheRightJacobian) {
  for (const V3& phi : vectors(1e3)) {
    const auto x = seeded<3>(phi, M3::Identity());
    const M3 J = rightJacobian<double>(phi), R = exp3<double>(phi);
    near(derivatives(Vector4<S>(quaternion::exp3<S>(x).to_vector()), 3), turning(quaternion_of(phi)) * J,
         "quaternion", phi);
    near(derivatives(Matrix3<S>(exp3<S>(x)), 3), turning(R) * J, "matrix", phi);
  }
}

TEST(AutomaticDerivatives, OfLog3AreTheInverseRightJacobian) {
  for (const V3& phi : vectors(std::numbers::pi))
    for (const double sign : {1., -1.}) {
      const V4 Q = sign * quaternion_of(phi);
      const V3 log = quaternion::log3<double>(SO3<double>(Q));
      const auto y = seeded<4>(Q, turning(Q));
      near(derivatives(Vector3<S>(quaternion::log3<S>(SO3<S>(y))), 3), rightJacobianInverse<double>(log),
           sign > 0 ? "of Q" : "of -Q", log);
      const M3 R = exp3<double>(phi);
      const Matrix3<S> X = seeded_matrix(R, turning(R));
      near(derivatives(Vector3<S>(log3<S>(X)), 3), rightJacobianInverse<double>(log3<double>(R)), "of R",
           log3<double>(R));
    }
}

TEST(AutomaticDerivatives, OfExp6AndLog6AreTheJacobiansOfPoses) {
  const V3 rho(0.3, -2, 0.7);
  for (const V3& phi : vectors(std::numbers::pi, not_underflowing)) {
    V6 xi;
    xi << rho, phi;
    const Motion<double> m(xi);
    const M6 J = rightJacobian<double>(m);
    const SE3<double> T = exp6<double>(m);
    const SE3<S> X = exp6<S>(Motion<S>(seeded<6>(xi, M6::Identity())));
    near(derivatives(Vector3<S>(X.translation())), T.rotation() * J.topRows(3), "p of exp6", phi);
    near(derivatives(Matrix3<S>(X.rotation())), turning(T.rotation()) * J.bottomRows(3), "R of exp6", phi);

    Rows of_R = Rows::Zero(9, 6), of_p = Rows::Zero(3, 6);
    of_R.rightCols(3) = turning(T.rotation()), of_p.leftCols(3) = T.rotation();
    const SE3<S> Y(seeded_matrix(T.rotation(), of_R), seeded<3>(T.translation(), of_p));
    const Motion<double> log = log6<double>(T);
    near(derivatives(Vector6<S>(log6<S>(Y).to_vector())), rightJacobianInverse<double>(log), "log6", phi);
  }
}

/// The derivative of the configuration x by its tangent at 0.
Rows tangent(const V7& x) {
  Rows N = Rows::Zero(7, 6);
  N.topLeftCorner<3, 3>() = SO3<double>(V4(x.tail<4>())).matrix();
  N.bottomRightCorner<4, 3>() = turning(V4(x.tail<4>()));
  return N;
}

TEST(AutomaticDerivatives, OfIntegrateAndDifferenceAreTheirDerivatives) {
  using enum ArgumentPosition;
  const V3 rho(0.3, -2, 0.7);
  for (const V3& phi : vectors(3, not_underflowing))
    for (const V3& start : {V3(0, 0, 0), V3(0.5, 1, -0.3), V3(0, 0, std::numbers::pi)})
      for (const double sign : {1., -1.}) {
        V7 q;
        q << 1, 2, 3, sign * quaternion_of(start);
        V6 d;
        d << rho * phi.norm(), phi;
        const V7 q1 = integrateSE3<double>(q, d);
        const Rows none = Rows::Zero(7, 6), one = Rows::Identity(6, 6), no_d = Rows::Zero(6, 6);
        const V6 by = differenceSE3<double>(q, q1);
        near(derivatives(Vector7<S>(integrateSE3<S>(seeded<7>(q, none), seeded<6>(d, one)))),
             tangent(q1) * dIntegrateSE3<double>(q, d, ARG1), "integrate by d", phi);
        near(derivatives(Vector7<S>(integrateSE3<S>(seeded<7>(q, tangent(q)), seeded<6>(d, no_d)))),
             tangent(q1) * dIntegrateSE3<double>(q, d, ARG0), "integrate by q", phi);
        near(derivatives(Vector6<S>(differenceSE3<S>(seeded<7>(q, none), seeded<7>(q1, tangent(q1))))),
             dDifferenceSE3<double>(q, q1, ARG1), "difference by q1", V3(by.tail<3>()));
        near(derivatives(Vector6<S>(differenceSE3<S>(seeded<7>(q, tangent(q)), seeded<7>(q1, none)))),
             dDifferenceSE3<double>(q, q1, ARG0), "difference by q0", V3(by.tail<3>()));
      }
}

// The coupling block of the Jacobian of SE(3) is the derivative of that of SO(3) along rho.
TEST(AutomaticDerivatives, OfJacobiansAlongRhoAreTheCouplingBlocks) {
  const V3 rho(0.3, -2, 0.7);
  for (const V3& phi : vectors(std::numbers::pi)) {
    V6 xi;
    xi << rho, phi;
    const auto x = seeded<3>(phi, rho);
    const Motion<double> m(xi);
    const auto along = [](const Matrix3<S>& J) -> Rows { return derivatives(J, 1); };
    const auto coupling = [](const M6& J) -> Rows {
      return M3(J.topRightCorner<3, 3>()).transpose().reshaped();
    };
    near(along(leftJacobian<S>(x)), coupling(leftJacobian<double>(m)), "left", phi);
    near(along(rightJacobian<S>(x)), coupling(rightJacobian<double>(m)), "right", phi);
    near(along(leftJacobianInverse<S>(x)), coupling(leftJacobianInverse<double>(m)), "left inverse", phi);
    near(along(rightJacobianInverse<S>(x)), coupling(rightJacobianInverse<double>(m)), "right inverse", phi);
  }
}

}  // namespace
}  // namespace liecheck
