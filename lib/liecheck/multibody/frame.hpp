#pragma once
// A named frame, fixed to the moving side of a joint.

#include <liecheck/spatial/se3.hpp>
#include <string>

namespace liecheck {

/// The names are Pinocchio's.
enum class FrameType { OP_FRAME, JOINT, FIXED_JOINT, BODY, SENSOR };

template <Scalar S>
struct Frame {
  std::string name;
  int parentJoint;   ///< index of the joint that carries it
  int parentFrame;   ///< index of the frame that carries it in the robot's description
  SE3<S> placement;  ///< X_JF: pose in the frame of parentJoint
  FrameType type;

  template <Scalar T>
  Frame<T> cast() const {
    return {name, parentJoint, parentFrame, placement.template cast<T>(), type};
  }
};

}  // namespace liecheck
