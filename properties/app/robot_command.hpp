#pragma once
// `liecheck robot`: what a URDF becomes, and what is lost on the way.

#include <string>

namespace liecheck::properties {

struct RobotFlags {
  std::string file, root = "fixed";
  bool tied = false, strict = false;
};

/// The joints with both their offsets, and the warnings. Throws UrdfError. Returns 0.
int run_robot_command(const RobotFlags& flags);

}  // namespace liecheck::properties
