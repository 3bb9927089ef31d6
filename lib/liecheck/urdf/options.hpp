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

/// What becomes of a joint with <mimic>.
enum class MimicJoints {
  Independent,  ///< a joint of its own, as in Pinocchio; a warning says so
  Tied          ///< a Mimic, without numbers in q and v
};

struct UrdfOptions {
  RootJoint root = RootJoint::Fixed;
  std::optional<Joint<double>> root_joint =
      {};  ///< replaces root by any other joint, also named "root_joint"
  MimicJoints mimic = MimicJoints::Independent;
  bool strict = false;  ///< a warning is an error
};

}  // namespace liecheck
