#pragma once
// The robot of a campaign, from a URDF, and its hash.

#include <invariants/property.hpp>

namespace liecheck::properties {

/// Reads the robot and its hash. Throws what the URDF reader throws.
Robot load_robot(const std::string& path, bool fixed = false);
Robot built_in_robot();
/// " --robot FILE", and its root where that is not free.
std::string robot_flags(const Robot& robot);
/// `path` is what --robot was given; empty where the text came from elsewhere.
Robot robot_of(const std::string& urdf, const std::string& path, bool fixed = false);

}  // namespace liecheck::properties
