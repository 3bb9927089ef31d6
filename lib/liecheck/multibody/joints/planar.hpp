#pragma once
// A planar joint: translations and rotations in the x y plane of the parent. q = [x y, cos sin] of the angle,
// v = (u_x, u_y, omega_z) in the child's axes [m/s, rad/s]. nq = 4, nv = 3. The configuration space is SE(2),
// a subgroup of SE(3). Formulas and bounds are those of exp_log.hpp and jacobians.hpp. (cos, sin) may have any
// norm, as in continuous.hpp.

#include <liecheck/multibody/joints/continuous.hpp>
#include <liecheck/multibody/norm.hpp>

namespace liecheck {

template <Scalar S>
struct Planar {
  static constexpr int nq = 4, nv = 3, unit_begin = 2, columns = 3;
  using Configuration = Vector4<S>;
  using Tangent = Vector3<S>;
  using Jacobian = Matrix3<S>;
  using CoefficientJacobian = Eigen::Matrix<S, 4, 3>;
  using Subspace = Eigen::Matrix<S, 6, 3>;

  std::string shortname() const { return "JointModelPlanar"; }

  static Configuration neutral() { return Configuration::Unit(2); }
  static Configuration normalized(const Configuration& q) {
    Configuration result = q;
    result.template tail<2>() = Continuous<S>::normalized(q.template tail<2>());
    return result;
  }
  static S normDefect(const Configuration& q) { return q.template tail<2>().squaredNorm() - S(1); }

  /// p1 = p0 + R J(omega) (u_x, u_y), angle1 = angle0 + omega.
  static Configuration integrate(const Configuration& q, const Tangent& delta) {
    const S bound = absolute<S>(delta[0]) + absolute<S>(delta[1]);
    if (SO3<S>::splittable(bound)) [[likely]]
      return integrateWithin(q, delta);
    return integrateFar(q, delta);
  }
  /// omega in [-pi, pi], (u_x, u_y) = J^-1(omega) R^T (p1 - p0).
  static Tangent difference(const Configuration& q0, const Configuration& q1) {
    const S bound = absolute<S>(S(q1[0] - q0[0])) + absolute<S>(S(q1[1] - q0[1]));
    if (SO3<S>::splittable(bound)) [[likely]]
      return differenceWithin(q0, q1);
    return differenceFar(q0, q1);
  }
  /// angle <= budget [rad] and |p1 - p0| <= budget max(1 m, |p0|, |p1|).
  static bool isSame(const Configuration& q0, const Configuration& q1, const S& budget) {
    return multibody_detail::samePosition<Vector2>(q0.template head<2>(), q1.template head<2>(), budget) &&
           Continuous<S>::isSame(q0.template tail<2>(), q1.template tail<2>(), budget);
  }

  static Jacobian dIntegrate(const Configuration&, const Tangent& delta, ArgumentPosition argument) {
    return inPlane(dIntegrateSE3<S>(Vector7<S>::Unit(6), inSpace(delta), argument));
  }
  static Jacobian dDifference(const Configuration& q0, const Configuration& q1, ArgumentPosition argument) {
    const Motion<S> xi(inSpace(difference(q0, q1)));
    return inPlane(argument == ArgumentPosition::ARG0 ? Matrix6<S>(-leftJacobianInverse<S>(xi))
                                                      : rightJacobianInverse<S>(xi));
  }
  /// [R 0; 0 (-sin, cos)], where R is the rotation by the angle of u/|u| and (cos, sin) = u as stored.
  static CoefficientJacobian integrateCoeffWiseJacobian(const Configuration& q) {
    const Vector2 u = unit(q);
    CoefficientJacobian J = CoefficientJacobian::Zero();
    J.template topLeftCorner<2, 2>() << u[0], -u[1], u[1], u[0];
    J.template bottomRightCorner<2, 1>() << -q[3], q[2];
    return J;
  }

  /// X_PJ (R(z, angle), (x, y, 0)).
  static SE3<S> transform(const SE3<S>& X_PJ, const Configuration& q) {
    const Vector2 u = unit(q);
    return SE3<S>(Axis<S>::Z().rotated(X_PJ.rotation(), u[0], u[1]), X_PJ.act(Vector3<S>(q[0], q[1], S(0))));
  }
  /// Columns u_x, u_y and omega_z of the identity.
  static Subspace subspace() {
    Subspace s = Subspace::Zero();
    s(0, 0) = s(1, 1) = s(5, 2) = S(1);
    return s;
  }

 private:
  using Vector2 = Eigen::Matrix<S, 2, 1>;
  /// (cos, sin)/|(cos, sin)|.
  static Vector2 unit(const Configuration& q) {
    return firstOrderNormalized<S, 2>(nearUnit<S, 2>(q.template tail<2>()));
  }
  /// For translations whose products do not overflow (SO3::splittable).
  static Configuration integrateWithin(const Configuration& q, const Tangent& delta) {
    const Vector3<S> phi(S(0), S(0), delta[2]), rho(delta[0], delta[1], S(0)),
        arc = with_coefficients<S, Precision::standard>(
            phi, [&rho](const auto&k) { return exp_log_detail::arc(k, rho); });
    const Vector2 u = unit(q);
    Configuration result;
    result << q[0] + (u[0] * arc[0] - u[1] * arc[1]), q[1] + (u[1] * arc[0] + u[0] * arc[1]),
        Continuous<S>::integrate(q.template tail<2>(), Vector1<S>(delta[2]));
    return result;
  }
  static Tangent differenceWithin(const Configuration& q0, const Configuration& q1) {
    const S omega = Continuous<S>::difference(q0.template tail<2>(), q1.template tail<2>())[0];
    const Vector2 u = unit(q0);
    const S dx = q1[0] - q0[0], dy = q1[1] - q0[1];
    // omega may be pi rounded up. Its rotation has a w below 0, or -0, and the logarithm would be that of -pi.
    const SO3<S> turn = quaternion::exp3<S>(Vector3<S>(S(0), S(0), omega));
    const SO3<S> Q(turn.vec(), S(0) < turn.w() ? turn.w() : S(0));
    const Vector3<S> rho = exp_log_detail::RotationLogarithm<S>(Q, Q.normExcessDoubleWord())
                               .arc(Vector3<S>(u[0] * dx + u[1] * dy, u[0] * dy - u[1] * dx, S(0)));
    return Tangent(rho[0], rho[1], omega);
  }
  /// Larger translations are scaled down first.
  [[gnu::noinline, gnu::cold]] static Configuration integrateFar(const Configuration& q, Tangent delta) {
    delta.template head<2>() *= SO3<S>::scale_down();
    Configuration result = q;
    result.template head<2>().setZero();
    result = integrateWithin(result, delta);
    for (int i = 0; i < 2; ++i) result[i] = q[i] + result[i] / SO3<S>::scale_down();
    return result;
  }
  [[gnu::noinline, gnu::cold]] static Tangent differenceFar(Configuration q0, Configuration q1) {
    q0.template head<2>() *= SO3<S>::scale_down();
    q1.template head<2>() *= SO3<S>::scale_down();
    Tangent result = differenceWithin(q0, q1);
    result.template head<2>() /= SO3<S>::scale_down();
    return result;
  }
  static Vector6<S> inSpace(const Tangent& d) {
    return (Vector6<S>() << d[0], d[1], S(0), S(0), S(0), d[2]).finished();
  }
  static Jacobian inPlane(const Matrix6<S>& J) {
    return (Jacobian() << J(0, 0), J(0, 1), J(0, 5), J(1, 0), J(1, 1), J(1, 5), J(5, 0), J(5, 1), J(5, 5))
        .finished();
  }
};

}  // namespace liecheck
