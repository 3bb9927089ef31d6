#pragma once
// A spherical joint: q = [x y z w], v = omega [3, rad/s] in the child's axes. nq = 4, nv = 3. It is a
// free-flyer without translation. Formulas and error bounds: se3_configuration.hpp.

#include <liecheck/multibody/joints/free_flyer.hpp>

namespace liecheck {

template <Scalar S>
struct Spherical {
  static constexpr int nq = 4, nv = 3, unit_begin = 0, columns = 3;
  using Configuration = Vector4<S>;
  using Tangent = Vector3<S>;
  using Jacobian = Matrix3<S>;
  using CoefficientJacobian = Eigen::Matrix<S, 4, 3>;
  using Subspace = Eigen::Matrix<S, 6, 3>;

  std::string shortname() const { return "JointModelSpherical"; }

  static Configuration neutral() { return Configuration::Unit(3); }
  static Configuration normalized(const Configuration& Q) { return normalizedUnit<S, 4>(Q); }
  static S normDefect(const Configuration& Q) { return Q.squaredNorm() - S(1); }

  static Configuration integrate(const Configuration& Q, const Tangent& delta) {
    return integrateSE3<S>(pose(Q), twist(delta)).template tail<4>();
  }
  static Tangent difference(const Configuration& Q0, const Configuration& Q1) {
    return differenceSE3<S>(pose(Q0), pose(Q1)).template tail<3>();
  }
  /// angle <= budget [rad]. Q and -Q are the same.
  static bool isSame(const Configuration& Q0, const Configuration& Q1, const S& budget) {
    return multibody_detail::norm(difference(Q0, Q1)) <= budget;
  }

  static Jacobian dIntegrate(const Configuration& Q, const Tangent& delta, ArgumentPosition argument) {
    return dIntegrateSE3<S>(pose(Q), twist(delta), argument).template bottomRightCorner<3, 3>();
  }
  static Jacobian dDifference(const Configuration& Q0, const Configuration& Q1, ArgumentPosition argument) {
    return dDifferenceSE3<S>(pose(Q0), pose(Q1), argument).template bottomRightCorner<3, 3>();
  }
  static CoefficientJacobian integrateCoeffWiseJacobian(const Configuration& Q) {
    return integrateCoeffWiseJacobianSE3<S>(pose(Q)).template bottomRightCorner<4, 3>();
  }

  /// X_PJ (R(Q), 0).
  static SE3<S> transform(const SE3<S>& X_PJ, const Configuration& Q) {
    return SE3<S>(Matrix3<S>(X_PJ.rotation() * SO3<S>(nearUnit<S, 4>(Q)).matrix()), X_PJ.translation());
  }
  /// [0; I].
  static Subspace subspace() {
    Subspace s;
    s << Matrix3<S>::Zero(), Matrix3<S>::Identity();
    return s;
  }

 private:
  static Vector7<S> pose(const Configuration& Q) {
    Vector7<S> q;
    q << Vector3<S>::Zero(), Q;
    return q;
  }
  static Vector6<S> twist(const Tangent& phi) {
    Vector6<S> xi;
    xi << Vector3<S>::Zero(), phi;
    return xi;
  }
};

}  // namespace liecheck
