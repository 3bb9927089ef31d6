#pragma once
// A scene as a benchmark: a robot, a start, a duration, and what acts.

#include <Eigen/Core>
#include <boost/multiprecision/float128.hpp>
#include <functional>
#include <liecheck/scene/effects/effect.hpp>
#include <oracles/real.hpp>
#include <string>
#include <vector>

namespace liecheck::scene {
struct Scene;
}

namespace liecheck::properties {

using float128 = boost::multiprecision::float128;

/// A configuration [nq] and a velocity [nv] in the library's coordinates, exactly.
struct Moment {
  std::vector<oracles::Real> q, v;
};

struct Benchmark {
  std::string name, what;
  Model<double> robot;
  Eigen::VectorXd q0, v0;
  double duration = 1;     ///< [s]
  std::string integrator;  ///< that the scene's file names; may be empty
  /// The effects, and those of them that a closed form knows: gravity in the world [m/s^2]; of each coordinate [nv]
  /// stiffness, its rest position and viscous damping. Empty: none.
  std::function<scene::Effects<double>()> effects = [] { return scene::Effects<double>(); };
  std::function<scene::Effects<float128>()> effects_float128 = [] { return scene::Effects<float128>(); };
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  Eigen::VectorXd stiffness, rest, damping;
  bool others = false;  ///< something else acts

  bool conservative() const { return !others && (damping.size() == 0 || damping.isZero(0)); }
  /// Does nothing act from outside, so that momentum is kept?
  bool force_free() const;
};

/// Throws std::invalid_argument where an effect makes no sense for the robot.
Benchmark benchmark_of(const scene::Scene& scene);

}  // namespace liecheck::properties
