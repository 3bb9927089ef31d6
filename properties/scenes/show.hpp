#pragma once
// What the page shows of scenes besides the sweep: what each effect costs, and motions to look at.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A stage of a plan, as `liecheck scene explain` measures it.
struct StageCost {
  std::string scene, stage, equation, energy, when, why;
  std::optional<double> nanoseconds;  ///< each time
};
/// Of a lone body with every effect of bodies, a hinge with every effect of joints, and a quadruped on the ground.
std::vector<StageCost> stage_costs();

/// A motion in pictures: of each body the box with its inertia (homogeneous, of its mass), and lines from its origin to
/// the joints that hang on it.
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
  std::vector<std::vector<std::array<double, 7>>> frames;  ///< of each link p and Q, x y z w, in the world
};
std::vector<Film> films();

}  // namespace liecheck::properties
