#pragma once
// The promise of the URDF reader: a text becomes a usable robot, or a UrdfError of one short line.

#include <string>

namespace liecheck::test {

/// Throws std::logic_error if the reader breaks this promise. True if the text is a robot.
bool try_urdf(const std::string& text);

}  // namespace liecheck::test
