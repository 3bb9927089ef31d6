#pragma once
// How the laws read a URDF.

#include <liecheck/urdf/urdf.hpp>

namespace liecheck::properties {

/// `coupled`: a mimic has no coordinate of its own; otherwise it is an independent joint.
inline UrdfOptions urdf_options(bool fixed, bool coupled) {
  UrdfOptions options;
  if (!fixed) options.root = RootJoint::FreeFlyer;
  if (coupled) options.mimic = MimicJoints::Tied;
  return options;
}

}  // namespace liecheck::properties
