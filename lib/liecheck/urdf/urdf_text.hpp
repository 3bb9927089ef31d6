#pragma once
// What a URDF text must be before urdfdom sees it. urdfdom says what it dislikes on stderr, without a line,
// and lets much pass; here every complaint is a UrdfError with its line.

#include <liecheck/urdf/urdf.hpp>
#include <string>

namespace liecheck::urdf_detail {

/// Joints from the root to a leaf; urdfdom's links own one another, so their destruction recurses.
constexpr int max_tree_depth = 2000;

/// Throws UrdfError unless text is one well-formed robot: a tree of named links, joints of supported types,
/// numbers that are finite. Returns the line of the robot element.
int validateUrdfText(const std::string& text, const std::string& source_name, RootJoint root);

}  // namespace liecheck::urdf_detail
