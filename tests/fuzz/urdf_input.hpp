#pragma once
// One input of the URDF entrance: it becomes a robot or a UrdfError of one short line; a robot can be used.

#include <string>

namespace liecheck::test {

/// Throws std::logic_error where the entrance breaks that promise. True if it is a robot.
bool try_urdf(const std::string& text);

}  // namespace liecheck::test
