#pragma once
// URDF text -> Model<double>.
//
// The joints below a link are visited in alphabetical order of their names, depth first. A revolute,
// continuous, prismatic, planar or floating joint becomes a joint of the model, with a JOINT frame of its
// name and a BODY frame named after its child link. A fixed joint becomes a FIXED_JOINT frame and a BODY
// frame, and the inertia of its child link is added to the joint that supports it. Limits, damping and
// friction are stored in the model. A continuous joint has no position limits; without <limit> it has no
// effort and velocity limits either. Geometry is not read and packages are not searched. A mimic that is tied
// to a later joint is added, with the joints below it, after that joint and the joints below that.
//
// The text is parsed by expat, not by urdfdom. urdfdom reports errors without a line, on a logger of the
// whole process. If white space follows a number of an <inertial>, urdfdom drops the mass of the link. Trees
// and numbers are those of urdfdom to the last bit, as tests/lib/urdfdom_test.cpp checks. The only difference
// is that this reader accepts white space around any number.

#include <liecheck/multibody/model.hpp>
#include <liecheck/urdf/error.hpp>
#include <liecheck/urdf/options.hpp>
#include <string>
#include <vector>

namespace liecheck {

/// A robot and its warnings, one line each: `FILE:LINE: what (value)`. What public URDFs contain although
/// URDF does not allow it is a warning if the model is defined without it: unknown and repeated words, which
/// are ignored; attributes that are missing and have an obvious value; limits that are missing, crossed or
/// negative, so that the joint is not limited; errors in geometry and materials. Warnings also name what the
/// model leaves out (axes, limits, damping and friction that a joint's type does not use, soft limits, mimic
/// joints that are treated as independent) and what it cannot compute with: numbers whose square overflows,
/// joints that move no inertia, and inertias that no body can have (aba may throw SingularInertia of either).
struct UrdfRobot {
  Model<double> model;
  std::vector<std::string> warnings;
};

/// The largest size of a URDF text, 64 MiB: a thousand times that of a humanoid.
constexpr std::size_t max_urdf_bytes = std::size_t(64) << 20;

/// The text of a URDF file, read once; of a larger one than max_urdf_bytes, one byte more than is accepted. It may be a
/// regular file, or a pipe with a writer. Throws UrdfError.
std::string readUrdf(const std::string& path);

/// The robot of a URDF file. Throws UrdfError.
UrdfRobot loadUrdf(const std::string& path, const UrdfOptions& options = {});

/// The robot of a URDF text; messages show source_name as FILE. Throws UrdfError.
UrdfRobot loadUrdfText(const std::string& text, const UrdfOptions& options = {},
                       const std::string& source_name = "URDF text");

/// The model of loadUrdf or loadUrdfText, without the warnings.
Model<double> buildModelFromUrdf(const std::string& path, RootJoint root = RootJoint::Fixed);
Model<double> buildModelFromUrdfText(const std::string& text, RootJoint root = RootJoint::Fixed,
                                     const std::string& source_name = "URDF text");

}  // namespace liecheck
