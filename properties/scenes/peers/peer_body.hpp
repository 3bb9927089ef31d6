#pragma once
// What a peer is told of a robot. C++17: some peers' headers know no later one.

#include <Eigen/Geometry>

namespace liecheck::properties {

/// A body on its parent (-1: the world): free, or turning about `axis` (unit, in its own frame) at p_PB.
struct PeerBody {
  int parent = -1;
  bool free = false;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), at = Eigen::Vector3d::Zero();
  double mass = 1;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), moments = Eigen::Vector3d::Ones();  ///< about the centre
};
}  // namespace liecheck::properties
