#pragma once
// How a URDF becomes a model.

#include <liecheck/multibody/joint.hpp>
#include <optional>

namespace liecheck {

/// How the root link is connected to the world.
enum class RootJoint {
  Fixed,     ///< welded
  FreeFlyer  ///< by a free-flyer named "root_joint", joint 1
};

/// How a joint with <mimic> is modelled.
enum class MimicJoints {
  Independent,  ///< as an independent joint, as in Pinocchio; adds a warning
  Tied          ///< as a Mimic, without numbers in q and v
};

struct UrdfOptions {
  RootJoint root = RootJoint::Fixed;
  std::optional<Joint<double>> root_joint =
      {};  ///< any other joint instead of `root`, also named "root_joint"
  MimicJoints mimic = MimicJoints::Independent;
  bool strict = false;  ///< a warning is an error
};

}  // namespace liecheck
