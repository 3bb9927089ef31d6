#pragma once
// A free-flyer is a body that moves freely: q = [p; x y z w], v = (u, omega) in the body's axes. nq = 7,
// nv = 6. Formulas and error bounds: se3_configuration.hpp.

#include <liecheck/multibody/norm.hpp>
#include <liecheck/multibody/se3_configuration.hpp>
#include <string>

namespace liecheck {

template <Scalar S>
struct FreeFlyer {
  static constexpr int nq = 7, nv = 6, unit_begin = 3, columns = 6;
  using Configuration = Vector7<S>;
  using Tangent = Vector6<S>;
  using Jacobian = Matrix6<S>;
  using CoefficientJacobian = Eigen::Matrix<S, 7, 6>;
  using Subspace = Matrix6<S>;

  std::string shortname() const { return "JointModelFreeFlyer"; }

  static Configuration neutral() { return Configuration::Unit(6); }
  static Configuration normalized(const Configuration& q) {
    Configuration result = q;
    result.template tail<4>() = normalizedUnit<S, 4>(q.template tail<4>());
    return result;
  }
  static S normDefect(const Configuration& q) { return q.template tail<4>().squaredNorm() - S(1); }

  static Configuration integrate(const Configuration& q, const Tangent& delta) {
    return integrateSE3<S>(q, delta);
  }
  static Tangent difference(const Configuration& q0, const Configuration& q1) {
    return differenceSE3<S>(q0, q1);
  }

  /// angle <= budget [rad] and |p1 - p0| <= budget max(1 m, |p0|, |p1|). Q and -Q are the same.
  static bool isSame(const Configuration& q0, const Configuration& q1, const S& budget) {
    using multibody_detail::samePosition;
    if (!samePosition<Vector3<S>>(q0.template head<3>(), q1.template head<3>(), budget)) return false;
    return multibody_detail::norm(Vector3<S>(difference(q0, q1).template tail<3>())) <= budget;
  }

  static Jacobian dIntegrate(const Configuration& q, const Tangent& delta, ArgumentPosition argument) {
    return dIntegrateSE3<S>(q, delta, argument);
  }
  static Jacobian dDifference(const Configuration& q0, const Configuration& q1, ArgumentPosition argument) {
    return dDifferenceSE3<S>(q0, q1, argument);
  }
  static CoefficientJacobian integrateCoeffWiseJacobian(const Configuration& q) {
    return integrateCoeffWiseJacobianSE3<S>(q);
  }

  /// X_PJ (R(Q), p).
  static SE3<S> transform(const SE3<S>& X_PJ, const Configuration& q) {
    return X_PJ * SE3<S>(SO3<S>(nearUnit<S, 4>(q.template tail<4>())), q.template head<3>());
  }
  static Subspace subspace() { return Subspace::Identity(); }
};

}  // namespace liecheck
