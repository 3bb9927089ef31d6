#pragma once
// The robot of a campaign, from a URDF, and its hash.

#include <invariants/measurement.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// Reads a URDF file. Throws what the URDF reader throws.
Robot load_robot(const std::string& path, bool fixed = false, std::vector<std::string>* warnings = nullptr);
Robot built_in_robot();
/// " --robot FILE", followed by " --root fixed" for a robot with a fixed root.
std::string robot_flags(const Robot& robot);
/// `path` is the argument of --robot, or empty if the text is from elsewhere.
/// The warnings of the URDF are written to `warnings`, if given.
Robot robot_of(const std::string& urdf, const std::string& path, bool fixed = false,
               std::vector<std::string>* warnings = nullptr);

}  // namespace liecheck::properties
