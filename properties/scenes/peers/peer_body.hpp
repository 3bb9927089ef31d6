#pragma once
// The bodies of a robot, as a peer gets them. This file is C++17, because some peers' headers are not C++20.

#include <Eigen/Geometry>

namespace liecheck::properties {

/// A body and its parent (-1: the world). The body is free, or rotates about `axis` (unit, in the body's
/// frame). `at` is the position p_PB of the body's origin B in its parent P.
struct PeerBody {
  int parent = -1;
  bool free = false;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), at = Eigen::Vector3d::Zero();
  double mass = 1;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), moments = Eigen::Vector3d::Ones();  ///< about centre
};
}  // namespace liecheck::properties
