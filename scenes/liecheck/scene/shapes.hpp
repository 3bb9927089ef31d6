#pragma once
// Collision shapes of bodies, and the ground as a surface of triangles, as a scene gives them.

#include <array>
#include <liecheck/spatial/se3.hpp>
#include <string>
#include <vector>

namespace liecheck::scene {

/// A shape that is fixed to a body, centred in its own frame S. The axes of capsules and cylinders are z_S.
struct Shape {
  enum class Type { Sphere, Capsule, Cylinder, Box, Unusable };
  Type type;
  /// [m] Sphere: radius. Capsule, cylinder: radius, and length of the axis, without a capsule's caps. Box:
  /// sides.
  std::array<double, 3> size;
  std::string body;  ///< by which effects name it
  int frame;         ///< index of the body's frame F in the model
  SE3<double> X_FS = SE3<double>::Identity();
  std::string why = {};  ///< why it is unusable, such as "is a mesh"
};

/// Triangles with counter-clockwise vertices as seen from outside (from above, for the ground).
struct TriangleMesh {
  std::vector<std::array<double, 3>> vertices;  ///< [m], in the world
  std::vector<std::array<std::size_t, 3>> triangles;
};

}  // namespace liecheck::scene
