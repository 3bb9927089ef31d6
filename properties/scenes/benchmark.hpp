#pragma once
// A scene as a benchmark: a robot, its initial state, a duration and effects.

#include <Eigen/Core>
#include <functional>
#include <liecheck/scene/effects/effect.hpp>
#include <memory>
#include <oracles/real.hpp>
#include <string>
#include <vector>

namespace liecheck::scene {
struct Scene;
}

namespace liecheck::properties {

/// A configuration [nq] and a velocity [nv] in the library's coordinates, in high precision.
struct Moment {
  std::vector<oracles::Real> q, v;
};

/// tau = clamp(stiffness (target - q) - damping v, +- limit) of one coordinate of v.
struct Servo {
  int v;
  double stiffness, damping, target, limit;
};

struct Benchmark {
  std::string name, what;
  Model<double> robot;
  Eigen::VectorXd q0, v0;
  double duration = 1;  ///< [s]
  /// All effects. Those that closed forms and other simulators have themselves are repeated below: gravity in
  /// the world [m/s^2]; stiffness, rest position and viscous damping of each coordinate [nv], empty if there
  /// is none.
  std::function<scene::Effects<double>()> effects = [] { return scene::Effects<double>(); };
  std::shared_ptr<const scene::Scene> source;  ///< what the effects are made from
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  Eigen::VectorXd stiffness, rest, damping;
  Eigen::VectorXd armature;               ///< of each coordinate [nv], empty if there is none
  std::vector<Servo> servos;              ///< the effects `pd` with constant targets
  std::vector<std::string> effect_names;  ///< of effects(), in its order; another one for `pd` with rows
  bool others = false;                    ///< whether a closed form lacks some of the effects
  /// All effects and the surroundings as the scene describes them, for the independent formulations of the laboratory.
  std::vector<scene::Request> requests;
  scene::Surroundings around;

  bool conservative() const { return !others && (damping.size() == 0 || damping.isZero(0)); }
  /// Whether no external force acts, so that momentum is conserved.
  bool force_free() const;
};

/// Throws std::invalid_argument if an effect does not fit the robot.
Benchmark benchmark_of(const scene::Scene& scene);

}  // namespace liecheck::properties
