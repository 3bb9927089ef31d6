#pragma once
// Joint: the concept of a joint model, and the variant of all joint models.
//
// A joint model works on one segment of q (nq numbers) and one of v (nv numbers). Offsets, names and the tree
// are in Model. To add a joint type, add a file to joints/ and add the type to the variant below.

#include <concepts>
#include <liecheck/multibody/joints/continuous.hpp>
#include <liecheck/multibody/joints/free_flyer.hpp>
#include <liecheck/multibody/joints/helical.hpp>
#include <liecheck/multibody/joints/mimic.hpp>
#include <liecheck/multibody/joints/planar.hpp>
#include <liecheck/multibody/joints/prismatic.hpp>
#include <liecheck/multibody/joints/revolute.hpp>
#include <liecheck/multibody/joints/spherical.hpp>
#include <liecheck/multibody/joints/translation.hpp>
#include <liecheck/multibody/joints/universe.hpp>
#include <type_traits>
#include <variant>

namespace liecheck {

/// What configuration.hpp and the algorithms require of a joint. Sizes are constants, so segments have a
/// fixed size and nothing is allocated. A stored unit vector u (quaternion or (cos, sin)) begins at index
/// unit_begin of the segment, and normDefect is |u|^2 - 1. Without a unit vector, unit_begin is nq and
/// normDefect is 0. subspace() is S [6 x columns]: V = S v is the velocity relative to the parent in the
/// child's axes. S must be constant: no algorithm adds (dS/dt) v. columns is nv, or 1 for a mimic.
/// transform(X_PJ, q) is the pose in the parent's frame; for a mimic q is the coordinate of its primary.
template <class J>
concept JointModel = requires(const J joint, const typename J::Configuration q, const typename J::Tangent v,
                              const typename J::Configuration::Scalar budget, ArgumentPosition argument) {
  { J::nq } -> std::convertible_to<int>;
  { J::nv } -> std::convertible_to<int>;
  { J::columns } -> std::convertible_to<int>;
  { J::unit_begin } -> std::convertible_to<int>;
  joint.subspace();
  { joint.shortname() } -> std::convertible_to<std::string>;
  { joint.neutral() } -> std::same_as<typename J::Configuration>;
  { joint.normalized(q) } -> std::same_as<typename J::Configuration>;
  { joint.normDefect(q) } -> std::same_as<typename J::Configuration::Scalar>;
  { joint.integrate(q, v) } -> std::same_as<typename J::Configuration>;
  { joint.difference(q, q) } -> std::same_as<typename J::Tangent>;
  { joint.isSame(q, q, budget) } -> std::same_as<bool>;
  { joint.dIntegrate(q, v, argument) } -> std::same_as<typename J::Jacobian>;
  { joint.dDifference(q, q, argument) } -> std::same_as<typename J::Jacobian>;
  { joint.integrateCoeffWiseJacobian(q) } -> std::same_as<typename J::CoefficientJacobian>;
};

/// There is no type for fixed joints: Model::addFixedJoint adds only a frame.
template <Scalar S>
using Joint = std::variant<Universe<S>, FreeFlyer<S>, Revolute<S>, Continuous<S>, Prismatic<S>, Helical<S>,
                           Spherical<S>, Planar<S>, Translation<S>, Mimic<S>>;

static_assert(JointModel<Universe<double>> && JointModel<FreeFlyer<double>> && JointModel<Revolute<double>> &&
              JointModel<Continuous<double>> && JointModel<Prismatic<double>> &&
              JointModel<Helical<double>> && JointModel<Spherical<double>> && JointModel<Planar<double>> &&
              JointModel<Translation<double>> && JointModel<Mimic<double>>);

/// True if ||u|^2 - 1| <= budget for the joint's unit vector u; false for NaN.
template <JointModel J>
bool isNormalized(const J& joint, const typename J::Configuration& q,
                  const typename J::Configuration::Scalar& budget) {
  return absolute<typename J::Configuration::Scalar>(joint.normDefect(q)) <= budget;
}

/// |difference(q0, q1)|^2 of one joint. As in Pinocchio, squares of m and of rad are added.
template <JointModel J>
typename J::Configuration::Scalar squaredDistance(const J& joint, const typename J::Configuration& q0,
                                                  const typename J::Configuration& q1) {
  return joint.difference(q0, q1).squaredNorm();
}

/// True if the joint rotates about an axis through its origin, S = (0, axis).
template <Scalar S, class J>
inline constexpr bool rotates_about_axis = std::is_same_v<J, Revolute<S>> || std::is_same_v<J, Continuous<S>>;
template <Scalar S>
bool rotatesAboutAxis(const Joint<S>& joint) {
  return std::holds_alternative<Revolute<S>>(joint) || std::holds_alternative<Continuous<S>>(joint);
}

/// The numbers of q and v that the joint takes; 0 for a mimic.
template <Scalar S>
int nq(const Joint<S>& joint) {
  return std::visit([](const auto& j) { return int(j.nq); }, joint);
}
template <Scalar S>
int nv(const Joint<S>& joint) {
  return std::visit([](const auto& j) { return int(j.nv); }, joint);
}
template <Scalar S>
std::string shortname(const Joint<S>& joint) {
  return std::visit([](const auto& j) { return j.shortname(); }, joint);
}
namespace joint_detail {
template <Scalar T, template <Scalar> class J, Scalar S>
Joint<T> cast(const J<S>& joint) {
  if constexpr (std::is_empty_v<J<S>>)
    return J<T>();
  else
    return joint.template cast<T>();
}
}  // namespace joint_detail
/// The joint with its constants, if it has any, converted to T.
template <Scalar T, Scalar S>
Joint<T> cast(const Joint<S>& joint) {
  return std::visit([](const auto& j) { return joint_detail::cast<T>(j); }, joint);
}

}  // namespace liecheck
