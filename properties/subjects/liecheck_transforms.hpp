#pragma once
// liecheck's own representations, transforms, means and inertial navigation as operations of a subject, in any scalar.

#include <boost/multiprecision/eigen.hpp>
#include <subjects/typed.hpp>

#include <liecheck/multibody/means.hpp>
#include <liecheck/spatial/preintegration.hpp>
#include <liecheck/spatial/relative_rotation.hpp>
#include <liecheck/spatial/representations.hpp>
#include <liecheck/spatial/transforms.hpp>

namespace liecheck::properties {

template <class S>
struct LiecheckTransforms : Types<S> {
  using O = TypedOperations<S>;
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::V7,
      typename Types<S>::M3, typename Types<S>::M6;
  using T = Pose<S>;
  using Motion = liecheck::Motion<S>;

  static void add(O& o);

 private:
  static SE3<S> pose(const T& X) { return {X.R, X.p}; }
  static ExtendedPose<S> extended_pose(const Vec<S, 15>& x) {
    M3 R;
    for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = x[i];
    return {R, x.template segment<3>(9), x.template tail<3>()};
  }
  static void add_representations(O& o) {
    o[op::quaternion_from_matrix] = [](const M3& R) -> V4 { return toQuaternion<S>(R).to_vector(); };
    o[op::matrix_from_quaternion] = [](const V4& Q) -> M3 { return SO3<S>(Q).matrix(); };
    o[op::quaternion_product] = [](const V4& a, const V4& b) -> V4 {
      return (SO3<S>(a) * SO3<S>(b)).to_vector();
    };
    o[op::quaternion_inverse] = [](const V4& Q) -> V4 { return SO3<S>(Q).inverse().to_vector(); };
    o[op::axis_angle_from_quaternion] = [](const V4& Q) -> V4 {
      return toAxisAngle<S>(SO3<S>(Q)).to_vector();
    };
    o[op::axis_angle_from_matrix] = [](const M3& R) -> V4 {
      return toAxisAngle<S>(toQuaternion<S>(R)).to_vector();
    };
    o[op::quaternion_from_axis_angle] = [](const V3& axis, const S& angle) -> V4 {
      return fromAxisAngle<S>({axis, angle}).to_vector();
    };
    o[op::matrix_from_axis_angle] = [](const V3& axis, const S& angle) -> M3 {
      return fromAxisAngle<S>({axis, angle}).matrix();
    };
    o[op::gibbs_from_quaternion] = [](const V4& Q) -> V3 { return toGibbs<S>(SO3<S>(Q)); };
    o[op::quaternion_from_gibbs] = [](const V3& g) -> V4 { return fromGibbs<S>(g).to_vector(); };
    o[op::mrp_from_quaternion] = [](const V4& Q) -> V3 { return toModifiedRodrigues<S>(SO3<S>(Q)); };
    o[op::quaternion_from_mrp] = [](const V3& s) -> V4 { return fromModifiedRodrigues<S>(s).to_vector(); };
    o[op::nearest_rotation] = [](const M3& A) -> M3 { return nearestRotation<S>(A); };
    o[op::gram_schmidt] = [](const M3& A) -> M3 { return orthonormalized<S>(A); };
    o[op::angle_between] = [](const V3& a, const V3& b) -> S { return angleBetween<S>(a, b); };
    o[op::slerp_directions] = [](const V3& a, const V3& b, const S& t) -> V3 {
      return liecheck::slerp<S>(a, b, t);
    };
  }
  static void add_navigation(O& o) {
    using V9 = Vec<S, 9>;
    using V15 = Vec<S, 15>;
    using M9 = Mat<S, 9>;
    o[op::se23_exp] = [](const V9& xi) -> V15 { return exp9<S>(xi).to_vector(); };
    o[op::se23_log] = [](const V15& X) -> V9 { return log9<S>(extended_pose(X)); };
    o[op::se23_left_jacobian] = [](const V9& xi) -> M9 { return leftJacobian<S>(xi); };
    o[op::se23_right_jacobian] = [](const V9& xi) -> M9 { return rightJacobian<S>(xi); };
    o[op::se23_adjoint] = [](const V15& X) -> M9 { return liecheck::adjoint<S>(extended_pose(X)); };
    o[op::preintegrate_forster] = [](const V9& w, const V9& a, const S& dt) -> V15 {
      return preintegratedForster<S, 3>(w, a, dt).increment();
    };
    o[op::preintegrate_brossard] = [](const V9& w, const V9& a, const S& dt) -> V15 {
      return preintegratedBrossard<S, 3>(w, a, dt).increment();
    };
    o[op::forster_bias_jacobians] = [](const V9& w, const V9& a, const S& dt) -> Mat<S, 15, 3> {
      return preintegratedForster<S, 3>(w, a, dt).by_biases();
    };
    o[op::brossard_bias_jacobians] = [](const V9& w, const V9& a, const S& dt) -> Mat<S, 15, 3> {
      return preintegratedBrossard<S, 3>(w, a, dt).by_biases();
    };
  }
  static void add_transforms(O& o) {
    o[op::adjoint] = [](const T& X) -> M6 { return pose(X).toActionMatrix(); };
    o[op::coadjoint] = [](const T& X) -> M6 { return pose(X).toDualActionMatrix(); };
    o[op::small_adjoint] = [](const V6& V) -> M6 { return Motion(V).toActionMatrix(); };
    o[op::transport_covariance] = [](const T& X, const M6& Sigma) -> M6 {
      return transported<S>(pose(X), Sigma);
    };
    o[op::screw_parameters] = [](const V6& V) -> V7 { return screwOf<S>(Motion(V)).to_vector(); };
    o[op::mean_rotation] = [](const V4& a, const V4& b, const V4& c, const V3& w) -> V4 {
      return chordalMean<S, 3>({{SO3<S>(a), SO3<S>(b), SO3<S>(c)}}, w).to_vector();
    };
    o[op::geodesic_mean] = [](const V4& a, const V4& b, const V4& c, const V3& w) -> V4 {
      return geodesicMean<S, 3>({{SO3<S>(a), SO3<S>(b), SO3<S>(c)}}, w).to_vector();
    };
    o[op::mean_pose] = [](const V7& a, const V7& b, const V7& c, const V3& w) -> V7 {
      return meanPose<S, 3>({{a, b, c}}, w);
    };
    o[op::interpolate] = [](const V7& a, const V7& b, const S& t) -> V7 {
      return interpolateSE3<S>(a, b, t);
    };
  }
};

template <class S>
void LiecheckTransforms<S>::add(O& o) {
  add_representations(o);
  add_transforms(o);
  add_navigation(o);
}

}  // namespace liecheck::properties
