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
  return r;
}

template <class S>
Subject<S> liecheck_with_robots(decltype(Operations<S>::tree) tree = nullptr) {
  Subject<S> s = LiecheckOperations<S>::make();
  s.operations.robot = &liecheck_robot<S>, s.operations.tree = std::move(tree);
  return s;
}

}  // namespace liecheck::properties
