#pragma once
// What the report shows about scenes in addition to the sweep: the cost of each effect, and films of motions.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A stage of a plan, as `liecheck scene explain` measures it.
struct StageCost {
  std::string scene, stage, equation, energy, when, why;
  std::optional<double> nanoseconds;  ///< of one call
  std::optional<long> instructions;   ///< of one call
};
/// The stages for a body and a hinge, each with all of its effects, and for a quadruped on the ground.
std::vector<StageCost> stage_costs();

/// A film of a motion. Each body is drawn as the homogeneous box that has the same mass and inertia. Lines
/// lead from the body's origin to the joints that it carries.
struct Film {
  struct Link {
    std::string name;
    std::array<double, 3> centre, half;         ///< [m], in the link's frame and along `axes`
    std::array<double, 9> axes;                 ///< columns: principal axes
    std::vector<std::array<double, 3>> joints;  ///< [m], in the link's frame
  };
  std::string name, what, integrator;
  double interval = 0;           ///< between frames [s]
  std::optional<double> ground;  ///< height [m]
  std::vector<Link> links;
  std::vector<std::vector<std::array<double, 7>>> frames;  ///< poses of links in the world: p, Q as x y z w
};
std::vector<Film> films();

}  // namespace liecheck::properties
