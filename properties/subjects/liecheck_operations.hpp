#pragma once
// liecheck's own library as a subject, in any scalar, without robots. Each source file instantiates it for
// few scalars, because gcc inlines less in a large file.

#include <boost/multiprecision/eigen.hpp>
#include <subjects/liecheck_transforms.hpp>

#include <liecheck/multibody/coefficient_rate.hpp>
#include <liecheck/multibody/se2.hpp>
#include <liecheck/multibody/se3_configuration.hpp>
#include <liecheck/scalar/precision.hpp>
#include <liecheck/spatial/checked_rotation.hpp>
#include <liecheck/spatial/euler.hpp>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/inertia.hpp>
#include <liecheck/spatial/jacobians.hpp>
#include <liecheck/spatial/relative_rotation.hpp>

namespace liecheck::properties {

template <class S, Precision P = Precision::standard>
struct LiecheckOperations : Types<S> {
  using O = TypedOperations<S>;
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;
  using T = Pose<S>;
  using B = Body<S>;
  using Motion = liecheck::Motion<S>;
  using Force = liecheck::Force<S>;

  static TypedSubject<S> make() {
    constexpr bool fast = P == Precision::fast, tight = P == Precision::tight;
    TypedSubject<S> s{fast ? "liecheck:fast" : tight ? "liecheck:tight" : "liecheck", LIECHECK_VERSION, {}};
    add_exp_log_and_jacobians(s.operations);
    add_configurations(s.operations);
    if constexpr (P != Precision::tight) {
      s.operations[op::rotate_point] = [](const V4& Q, const V3& x) -> V3 {
        return SO3<S>(Q).template act<P>(x);
      };
    }
    if constexpr (P == Precision::standard) {
      add_spatial_algebra(s.operations);
      add_normalisation(s.operations);
      add_orientations(s.operations);
      add_planar_poses(s.operations);
      LiecheckTransforms<S>::add(s.operations);
    }
    if constexpr (std::is_floating_point_v<S>) add_any_norm(s.operations);
    return s;
  }

 private:
  static SE3<S> pose(const T& X) { return {X.R, X.p}; }
  static T stored(const SE3<S>& X) { return {X.rotation(), X.translation()}; }
  static Inertia<S> inertia(const B& b) { return {b.mass, b.c, b.I_C}; }
  static B body(const Inertia<S>& I) { return {I.mass(), I.lever(), I.inertia()}; }

  static void add_exp_log_and_jacobians(O& o) {
    o[op::exp3_quaternion] = [](const V3& phi) -> V4 { return quaternion::exp3<S, P>(phi).to_vector(); };
    o[op::exp3_matrix] = [](const V3& phi) -> M3 { return exp3<S, P>(phi); };
    o[op::log3_quaternion] = [](const V4& Q) -> V3 { return quaternion::log3<S, P>(SO3<S>(Q)); };
    o[op::log3_matrix] = [](const M3& R) -> V3 { return log3<S, P>(R); };
    o[op::exp6] = [](const V6& xi) -> T { return stored(exp6<S, P>(Motion(xi))); };
    o[op::log6] = [](const T& X) -> V6 { return log6<S, P>(pose(X)).to_vector(); };
    o[op::left_jacobian3] = [](const V3& phi) -> M3 { return leftJacobian<S, P>(phi); };
    o[op::right_jacobian3] = [](const V3& phi) -> M3 { return rightJacobian<S, P>(phi); };
    o[op::left_jacobian3_inverse] = [](const V3& phi) -> M3 { return leftJacobianInverse<S, P>(phi); };
    o[op::right_jacobian3_inverse] = [](const V3& phi) -> M3 { return rightJacobianInverse<S, P>(phi); };
    o[op::left_jacobian6] = [](const V6& xi) -> M6 { return leftJacobian<S, P>(Motion(xi)); };
    o[op::right_jacobian6] = [](const V6& xi) -> M6 { return rightJacobian<S, P>(Motion(xi)); };
    o[op::left_jacobian6_inverse] = [](const V6& xi) -> M6 { return leftJacobianInverse<S, P>(Motion(xi)); };
    o[op::right_jacobian6_inverse] = [](const V6& xi) -> M6 {
      return rightJacobianInverse<S, P>(Motion(xi));
    };
    if constexpr (std::is_floating_point_v<S> || std::is_same_v<S, float128>) {
      o.check_quaternion = [](const V4& Q) { checkedQuaternion<S>(Q); };
      o.check_rotation = [](const M3& R) { checkedRotation<S>(R); };
    }
  }

  static void add_configurations(O& o) {
    using enum ArgumentPosition;
    o[op::integrate] = [](const V7& q, const V6& d) -> V7 { return integrateSE3<S, P>(q, d); };
    o[op::difference] = [](const V7& q0, const V7& q1) -> V6 { return differenceSE3<S, P>(q0, q1); };
    o[op::d_integrate_arg0] = [](const V7& q, const V6& d) -> M6 { return dIntegrateSE3<S, P>(q, d, ARG0); };
    o[op::d_integrate_arg1] = [](const V7& q, const V6& d) -> M6 { return dIntegrateSE3<S, P>(q, d, ARG1); };
    o[op::d_difference_arg0] = [](const V7& a, const V7& b) -> M6 {
      return dDifferenceSE3<S, P>(a, b, ARG0);
    };
    o[op::d_difference_arg1] = [](const V7& a, const V7& b) -> M6 {
      return dDifferenceSE3<S, P>(a, b, ARG1);
    };
    if constexpr (P == Precision::standard) {
      o[op::integrate_coefficient_jacobian] = [](const V7& q) -> Mat<S, 7, 6> {
        return integrateCoeffWiseJacobianSE3<S>(q);
      };
    }
  }

  static void add_normalisation(O& o) {
    o[op::normalize] = [](const V4& Q) -> V4 { return SO3<S>(Q).normalized().to_vector(); };
    o[op::first_order_normalize] = [](const V4& Q) -> V4 {
      return SO3<S>(Q).firstOrderNormalized().to_vector();
    };
    o[op::matrix_from_quaternion_any_norm] = [](const V4& Q) -> M3 { return SO3<S>(Q).matrix(); };
  }

  /// By comparison, because not every scalar converts to int.
  static EulerOrder euler_order(const S& number) {
    int n = 0;
    while (n < 24 && S(n) < number) ++n;
    return EulerOrder::numbered(n);
  }
  static void add_orientations(O& o) {
    o[op::relative_angle] = [](const V4& a, const V4& b) -> S {
      return relativeAngle<S>(SO3<S>(a), SO3<S>(b));
    };
    o[op::twist_angle] = [](const V4& Q, const V3& axis) -> S { return twistAngle<S>(SO3<S>(Q), axis); };
    o[op::slerp] = [](const V4& a, const V4& b, const S& t) -> V4 {
      return liecheck::slerp<S>(SO3<S>(a), SO3<S>(b), t).to_vector();
    };
    o[op::rotation_between] = [](const V3& a, const V3& b) -> V4 {
      return rotationBetween<S>(a, b).to_vector();
    };
    o[op::euler_to_quaternion] = [](const S& order, const V3& angles) -> V4 {
      return eulerToQuaternion<S>(euler_order(order), angles).to_vector();
    };
    o[op::euler_to_matrix] = [](const S& order, const V3& angles) -> M3 {
      return eulerToMatrix<S>(euler_order(order), angles);
    };
    o[op::euler_from_quaternion] = [](const S& order, const V4& Q) -> V3 {
      return eulerFromQuaternion<S>(euler_order(order), SO3<S>(Q));
    };
    o[op::euler_from_matrix] = [](const S& order, const M3& R) -> V3 {
      return eulerFromMatrix<S>(euler_order(order), R);
    };
    o[op::velocity_to_rate] = [](const V7& q, const V6& V) -> V7 { return coefficientRate<S>(q, Motion(V)); };
    o[op::rate_to_velocity] = [](const V7& q, const V7& q_dot) -> V6 {
      return velocityOfCoefficientRate<S>(q, q_dot).to_vector();
    };
  }
  static void add_planar_poses(O& o) {
    o[op::se2_exp] = [](const V3& delta) -> V4 { return se2::exp<S>(delta); };
    o[op::se2_log] = [](const V4& q) -> V3 { return se2::log<S>(q); };
    o[op::se2_compose] = [](const V4& a, const V4& b) -> V4 { return se2::compose<S>(a, b); };
    o[op::se2_integrate] = [](const V4& q, const V3& delta) -> V4 { return Planar<S>::integrate(q, delta); };
    o[op::se2_difference] = [](const V4& a, const V4& b) -> V3 { return Planar<S>::difference(a, b); };
  }

  /// In float and double, the library promises the same for quaternions of any norm.
  static void add_any_norm(O& o) {
    o[op::rotate_point_any_norm] = o[op::rotate_point];
    o[op::log3_any_norm] = o[op::log3_quaternion];
    o[op::integrate_any_norm] = o[op::integrate];
    o[op::difference_any_norm] = o[op::difference];
    o[op::d_difference_any_norm] = o[op::d_difference_arg1];
  }

  /// These operations have no fast or tight variant.
  static void add_spatial_algebra(O& o) {
    o[op::compose] = [](const T& X, const T& Y) -> T { return stored(pose(X) * pose(Y)); };
    o[op::inverse] = [](const T& X) -> T { return stored(pose(X).inverse()); };
    o[op::act_point] = [](const T& X, const V3& x) -> V3 { return pose(X).act(x); };
    o[op::act_motion] = [](const T& X, const V6& V) -> V6 { return pose(X).act(Motion(V)).to_vector(); };
    o[op::act_inverse_motion] = [](const T& X, const V6& V) -> V6 {
      return pose(X).actInv(Motion(V)).to_vector();
    };
    o[op::act_force] = [](const T& X, const V6& F) -> V6 { return pose(X).act(Force(F)).to_vector(); };
    o[op::act_inverse_force] = [](const T& X, const V6& F) -> V6 {
      return pose(X).actInv(Force(F)).to_vector();
    };
    o[op::cross_motion] = [](const V6& V, const V6& W) -> V6 {
      return Motion(V).cross(Motion(W)).to_vector();
    };
    o[op::cross_force] = [](const V6& V, const V6& F) -> V6 { return Motion(V).cross(Force(F)).to_vector(); };
    o[op::act_inertia] = [](const T& X, const B& I) -> B { return body(pose(X).act(inertia(I))); };
    o[op::act_inverse_inertia] = [](const T& X, const B& I) -> B { return body(pose(X).actInv(inertia(I))); };
    o[op::momentum] = [](const B& I, const V6& V) -> V6 { return (inertia(I) * Motion(V)).to_vector(); };
    o[op::kinetic_energy] = [](const B& I, const V6& V) -> S { return inertia(I).kineticEnergy(Motion(V)); };
    o[op::inertia_matrix] = [](const B& I) -> M6 { return inertia(I).matrix(); };
  }
};

}  // namespace liecheck::properties
