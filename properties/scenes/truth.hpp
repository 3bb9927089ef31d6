#pragma once
// Which exact motion a scene has, if it is one that is known.

#include <optional>
#include <scenes/benchmark.hpp>

namespace liecheck::properties {

struct Truth {
  std::string name;
  bool closed = false;      ///< a closed form; else a reference of two orders that agree
  double disagreement = 0;  ///< of those two, at the end
  /// At t [s], 0 <= t <= duration. A reference remembers what it has computed.
  std::function<Moment(double t)> at;
};

/// Empty where no motion of oracles/motions is that of the scene.
std::optional<Truth> truth_of(const Benchmark& scene);

/// The errors of a moment by block, each an absolute 2-norm: of attitudes the largest angle between one that the robot
/// has and the exact one [rad]: of a free-flyer's or ball's frame, of a turning joint its own. NaN where the scene has
/// no such number.
struct MotionError {
  double attitude = 0, position = 0, angular_velocity = 0, linear_velocity = 0;
  static MotionError none();
  /// The attitude's, or the position's where nothing turns.
  double leading() const;
  void take_larger(const MotionError& other);
};
MotionError motion_error(const Model<double>& robot, const Moment& found, const Moment& exact);

}  // namespace liecheck::properties
