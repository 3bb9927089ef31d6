#pragma once
// One input of the URDF reader: it becomes a usable robot, or a UrdfError of one short line.

#include <string>

namespace liecheck::test {

/// Throws std::logic_error where the reader breaks that promise. True if the text is a robot.
bool try_urdf(const std::string& text);

}  // namespace liecheck::test
