#pragma once
// liecheck's own library as a subject with robots and trees.

#include <subjects/liecheck_operations.hpp>

#include <liecheck/multibody/configuration.hpp>
#include <liecheck/urdf/urdf.hpp>

namespace liecheck::properties {

template <class S>
RobotOperations<S> liecheck_robot(const std::string& urdf, bool fixed) {
  const auto model = std::make_shared<const Model<S>>(
      buildModelFromUrdfText(urdf, fixed ? RootJoint::Fixed : RootJoint::FreeFlyer, "the campaign's robot")
          .template cast<S>());
  RobotOperations<S> r;
  r[op::robot_integrate] = [model](const VecX<S>& q, const VecX<S>& d) -> VecX<S> {
    return integrate(*model, q, d);
  };
  r[op::robot_difference] = [model](const VecX<S>& a, const VecX<S>& b) -> VecX<S> {
    return difference(*model, a, b);
  };
  r[op::robot_is_same] = [model](const VecX<S>& a, const VecX<S>& b) {
    return isSameConfiguration(*model, a, b);
  };
  using enum ArgumentPosition;
  const auto derivative = [model](const auto& function, ArgumentPosition argument) {
    return [model, function, argument](const VecX<S>& a, const VecX<S>& b) -> MatX<S> {
      return function(*model, a, b, argument);
    };
  };
  const auto by_integrate = [](const auto& m, const VecX<S>& q, const VecX<S>& d, ArgumentPosition argument) {
    return dIntegrate<S>(m, q, d, argument);
  };
  const auto by_difference = [](const auto& m, const VecX<S>& a, const VecX<S>& b,
                                ArgumentPosition argument) { return dDifference<S>(m, a, b, argument); };
  r[op::robot_d_integrate_arg0] = derivative(by_integrate, ARG0);
  r[op::robot_d_integrate_arg1] = derivative(by_integrate, ARG1);
  r[op::robot_d_difference_arg0] = derivative(by_difference, ARG0);
  r[op::robot_d_difference_arg1] = derivative(by_difference, ARG1);
  return r;
}
// liecheck_trees_float.cpp and liecheck_trees_double.cpp compile them.
extern template RobotOperations<float> liecheck_robot(const std::string& urdf, bool fixed);
extern template RobotOperations<double> liecheck_robot(const std::string& urdf, bool fixed);

// liecheck_transforms_float.cpp and liecheck_transforms_double.cpp compile them.
extern template void LiecheckTransforms<float>::add(TypedOperations<float>&);
extern template void LiecheckTransforms<double>::add(TypedOperations<double>&);

template <class S>
TypedSubject<S> liecheck_with_robots(decltype(TypedOperations<S>::tree) tree = nullptr) {
  TypedSubject<S> s = LiecheckOperations<S>::make();
  s.operations.robot = &liecheck_robot<S>, s.operations.tree = std::move(tree);
  return s;
}

}  // namespace liecheck::properties
