#pragma once
// One robot told as different URDFs, for the readers of URDFs.

#include <campaign/robots.hpp>
#include <string>
#include <vector>

namespace liecheck::properties::league {

/// A robot told in one way.
struct Telling {
  std::string name, how;  ///< how: what it does, in words
  std::string urdf;
  /// The joints whose coordinate has the opposite sign of the original one, by name.
  std::vector<std::string> reversed = {};
  /// If the tree has another root: the joint that the old and the new base share, whose direction is turned around.
  std::string turned = {};
  /// Whether the joints have damping or friction, which a reader may or may not add to their torques.
  bool dissipates = false;
};

/// The robot written anew, and then told in equivalent ways. The names of its joints stay, and so do the frames of
/// the links behind them, but for the last:
///
/// - plain: each link with its inertia in the link's axes
/// - inertial_rpy: the axes of each inertia are rotated by its <origin rpy="...">
/// - lumped_fixed_joints: each body is a link of its own, fixed to the link at a distance and rotated
/// - offset_frames: before each joint, a massless link at a distance and rotated
/// - split_bodies: half of each body is a link of its own, fixed to the other half at a distance and rotated; the next joints
///   hang on it
/// - mirrored_axes: each axis and the sign of its coordinate are reversed
/// - empty_links: a link without inertial, but with a shape, is fixed to each body
/// - fixed_twice: each body is on a link that is fixed to its own through another
/// - scaled_meshes: each link has a mesh in millimetres, whose scale is of the shape alone
/// - narrow_limits: most configurations and velocities exceed the limits, also the soft ones
/// - damped: joints have damping and friction; joint torques and accelerations are not judged
/// - mimicking: one joint mimics another; both have coordinates, as Pinocchio's default is
/// - re_rooted: a child of the base is the base; only if the root floats and has a joint of one degree of freedom
///
/// All numbers are rounded to the nearest double. The robot must have been read without an error. Throws
/// std::invalid_argument if it has a planar joint, which the tellings do not support.
std::vector<Telling> tellings(const Robot& robot);

}  // namespace liecheck::properties::league
