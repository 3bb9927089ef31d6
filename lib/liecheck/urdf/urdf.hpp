#pragma once
// URDF text -> Model<double>.
//
// Children of a link are visited in alphabetical order of joint names, depth first. A revolute, continuous,
// prismatic or floating joint is a joint of the model, with a JOINT frame of its name and a BODY frame of its
// child link's; a fixed joint is a FIXED_JOINT and a BODY frame, and its child's inertia is merged into the
// joint that supports it. Geometry, limits, damping and mimic are not read into the model. planar is not
// supported.

#include <liecheck/multibody/model.hpp>
#include <stdexcept>
#include <string>

namespace liecheck {

/// How the root link is connected to the world.
enum class RootJoint {
  Fixed,     ///< welded
  FreeFlyer  ///< by a free-flyer named "root_joint", joint 1
};

/// A robot that cannot be read. what() is one line, `FILE:LINE: what (value)`, or `FILE: what (value)` and
/// line() 0 where no line is at fault.
class UrdfError : public std::runtime_error {
 public:
  UrdfError(const std::string& file, int line, const std::string& what, const std::string& value);
  const std::string& file() const { return file_; }
  int line() const { return line_; }

 private:
  std::string file_;
  int line_;
};

/// A text longer than this is refused: 64 MiB, a thousand times the URDF of a humanoid.
constexpr std::size_t max_urdf_bytes = std::size_t(64) << 20;

/// The text of a URDF file, which is opened and read once: a regular file, or a pipe that somebody writes to.
/// Throws UrdfError.
std::string readUrdf(const std::string& path);

/// The robot of a URDF file. Throws UrdfError.
Model<double> buildModelFromUrdf(const std::string& path, RootJoint root = RootJoint::Fixed);

/// The robot of a URDF text; source_name stands for FILE in messages. Throws UrdfError.
Model<double> buildModelFromUrdfText(const std::string& text, RootJoint root = RootJoint::Fixed,
                                     const std::string& source_name = "URDF text");

}  // namespace liecheck
