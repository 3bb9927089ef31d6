#pragma once
// URDF text -> Model<double>.
//
// Children of a link are visited in alphabetical order of joint names, depth first. A revolute, continuous,
// prismatic, planar or floating joint is a joint of the model, with a JOINT frame of its name and a BODY frame of
// its child link's; a fixed joint is a FIXED_JOINT and a BODY frame, and its child's inertia is merged into the
// joint that supports it. Limits, damping and friction are those of the model; a continuous joint has no position
// limits, and one without <limit> no others either. Geometry is not read, packages are not looked for.

#include <liecheck/multibody/model.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

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
  std::optional<Joint<double>> root_joint = {};  ///< instead of root, any other one; named "root_joint" too
  MimicJoints mimic = MimicJoints::Independent;
  bool strict = false;  ///< a warning is an error
};

/// A robot, and what was lost or looks wrong: one line each, `FILE:LINE: what (value)`. Warned of are axes, limits,
/// damping and friction that the joint's type has no use for, mimic joints that are independent, links whose inertia
/// no body has (an error unless what they are fixed to makes up for it), and joints that carry no mass, on which aba may throw SingularInertia.
struct UrdfRobot {
  Model<double> model;
  std::vector<std::string> warnings;
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
UrdfRobot loadUrdf(const std::string& path, const UrdfOptions& options = {});

/// The robot of a URDF text; source_name stands for FILE in messages. Throws UrdfError.
UrdfRobot loadUrdfText(const std::string& text, const UrdfOptions& options = {},
                       const std::string& source_name = "URDF text");

/// The same without the warnings.
Model<double> buildModelFromUrdf(const std::string& path, RootJoint root = RootJoint::Fixed);
Model<double> buildModelFromUrdfText(const std::string& text, RootJoint root = RootJoint::Fixed,
                                     const std::string& source_name = "URDF text");

}  // namespace liecheck
