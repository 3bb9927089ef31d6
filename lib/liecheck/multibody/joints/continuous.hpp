#pragma once
// A continuous joint: an unlimited rotation about an axis. q = (cos, sin), v [rad/s]. nq = 2, nv = 1.
//
//   integrate(u, a) = (c cos a - s sin a, s cos a + c sin a)
//   difference(u0, u1) = atan2(u0 x u1, u0 . u1)
//
// Domain: finite u != 0 of any norm; u represents the angle of u/|u|. Error bounds are those for
// ||u|^2 - 1| <= 8 eps; normalising other vectors adds 2 eps to them.

#include <liecheck/multibody/joints/revolute.hpp>
#include <liecheck/multibody/se3_configuration.hpp>

namespace liecheck {

template <Scalar S>
struct Continuous {
  static constexpr int nq = 2, nv = 1, unit_begin = 0, columns = 1;
  using Configuration = Eigen::Matrix<S, 2, 1>;
  using Tangent = Eigen::Matrix<S, 1, 1>;
  using Jacobian = Eigen::Matrix<S, 1, 1>;
  using CoefficientJacobian = Eigen::Matrix<S, 2, 1>;
  using Subspace = Vector6<S>;

  Axis<S> axis;
  explicit Continuous(const Axis<S>& unit_axis) : axis(unit_axis) {}
  explicit Continuous(const Vector3<S>& direction) : axis(direction) {}

  std::string shortname() const {
    return axis.shortname("JointModelRUB", "JointModelRevoluteUnboundedUnaligned");
  }

  static Configuration neutral() { return Configuration(S(1), S(0)); }
  static Configuration normalized(const Configuration& u) { return normalizedUnit<S, 2>(u); }
  static S normDefect(const Configuration& u) { return u.squaredNorm() - S(1); }

  /// Absolute error of the angle 2 eps for any delta; error of the norm 3 eps.
  static Configuration integrate(const Configuration& u0, const Tangent& delta) {
    using std::cos, std::sin;
    const S c = cos(delta[0]), s = sin(delta[0]);
    const Configuration u = nearUnit<S, 2>(u0);
    return firstOrderNormalized<S, 2>(Configuration(u[0] * c - u[1] * s, u[1] * c + u[0] * s));
  }

  /// The angle from u0 to u1 in [-pi, pi]; for opposite u0 and u1 it is pi or -pi. Relative error 3 eps for
  /// any angle: u0 x u1 is computed as u0 x (u1 - u0), by compensated summation if that cancels too.
  static Tangent difference(const Configuration& q0, const Configuration& q1) {
    using std::atan2;
    const Configuration u0 = atUnitScale<S, 2>(q0), u1 = atUnitScale<S, 2>(q1), d = u1 - u0;
    S sine = u0[0] * d[1] - u0[1] * d[0];
    if (S(4) * sine * sine < d.squaredNorm())
      sine = CompensatedSum<S>().add_product(u0[0], d[1]).add_product(S(-u0[1]), d[0]).value();
    return Tangent(S(atan2(sine, S(u0.dot(u1)))));
  }

  /// |difference| <= budget.
  static bool isSame(const Configuration& u0, const Configuration& u1, const S& budget) {
    return absolute<S>(difference(u0, u1)[0]) <= budget;
  }

  static Jacobian dIntegrate(const Configuration&, const Tangent&, ArgumentPosition) {
    return Jacobian::Identity();
  }
  static Jacobian dDifference(const Configuration&, const Configuration&, ArgumentPosition argument) {
    return Jacobian(argument == ArgumentPosition::ARG0 ? S(-1) : S(1));
  }
  /// d(cos, sin)/d angle = (-sin, cos), of the stored numbers.
  static CoefficientJacobian integrateCoeffWiseJacobian(const Configuration& u) {
    return CoefficientJacobian(-u[1], u[0]);
  }

  /// X_PJ (R(axis, angle), 0). Error 4 eps.
  [[gnu::always_inline]] SE3<S> transform(const SE3<S>& X_PJ, const Configuration& q) const {
    const Configuration u = firstOrderNormalized<S, 2>(nearUnit<S, 2>(q));
    return SE3<S>(axis.rotated(X_PJ.rotation(), u[0], u[1]), X_PJ.translation());
  }
  /// (0, axis).
  Subspace subspace() const { return Revolute<S>(axis).subspace(); }

  template <Scalar T>
  Continuous<T> cast() const {
    return Continuous<T>(axis.template cast<T>());
  }
};

}  // namespace liecheck
