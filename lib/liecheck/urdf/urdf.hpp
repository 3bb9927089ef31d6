#pragma once
// URDF text -> Model<double>.
//
// The joints below a link are visited in alphabetical order of their names, depth first. A revolute, continuous,
// prismatic, planar or floating joint becomes a joint of the model, with a JOINT frame of its name and a BODY frame named
// after its child link; a fixed joint becomes a FIXED_JOINT frame and a BODY frame, and the inertia of its child link is
// added to the joint that supports it. Limits, damping and friction are stored in the model; a continuous joint has no
// position limits, and without <limit> no effort and velocity limits either. Geometry is not read and packages are not
// searched for.
//
// The text is parsed once, by TinyXML-2, and not by urdfdom: that would be a second parser behind the same checks, since
// urdfdom reports errors without a line, on a logger of the whole process, and where a number of an <inertial> ends in
// white space it continues with a link without mass. Trees and numbers are urdfdom's to the last bit, as
// tests/lib/urdfdom_test.cpp checks; the one difference is that any white space may surround a number.

#include <liecheck/multibody/model.hpp>
#include <liecheck/urdf/error.hpp>
#include <liecheck/urdf/options.hpp>
#include <string>
#include <vector>

namespace liecheck {

/// A robot and its warnings, one line each: `FILE:LINE: what (value)`. There are warnings for axes, limits, damping and
/// friction that a joint's type does not use, for mimic joints that are treated as independent, for links with an inertia
/// that no body has (an error unless the bodies that they are fixed to make up for it), and for joints that carry no
/// mass, for which aba may throw SingularInertia.
struct UrdfRobot {
  Model<double> model;
  std::vector<std::string> warnings;
};

/// The largest size of a URDF text, 64 MiB: a thousand times that of a humanoid.
constexpr std::size_t max_urdf_bytes = std::size_t(64) << 20;

/// The text of a URDF file, which is opened and read once: a regular file, or a pipe with a writer.
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
