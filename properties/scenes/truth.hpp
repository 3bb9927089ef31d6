#pragma once
// The exact motion of a scene, if it is known.

#include <atomic>
#include <optional>
#include <scenes/benchmark.hpp>

namespace liecheck::properties {

struct Truth {
  std::string name;
  bool closed = false;      ///< a closed form; otherwise an extrapolation with two orders
  double disagreement = 0;  ///< difference between these two at the end
  /// The state at t [s], 0 <= t <= duration. Extrapolated states are cached.
  std::function<Moment(double t)> at;
};

/// Empty if the scene has none of the motions in oracles/motions. Once `stop` is set, an extrapolation throws
/// Stopped.
std::optional<Truth> truth_of(const Benchmark& scene, const std::atomic<bool>* stop = nullptr);

/// The closed form that a scene names by its key `truth`. Throws std::invalid_argument if the motion has none of this name.
Truth named_truth(const Benchmark& scene, const std::string& name);

/// The absolute errors of a state. The attitude error is the largest angle error of any joint [rad]: of the
/// frame of a free-flyer or spherical joint, or of the angle of a revolute joint. The other errors are
/// 2-norms over all joints. An error is NaN if the scene has no such quantity.
struct MotionError {
  double attitude = 0, position = 0, angular_velocity = 0, linear_velocity = 0;
  static MotionError none();
  /// The attitude error, or the position error if nothing rotates.
  double leading() const;
  void take_larger(const MotionError& other);
};
/// The four errors and their names.
struct ErrorMeasure {
  const char* name;
  double MotionError::*of;
};
inline constexpr ErrorMeasure error_measures[] = {{"attitude", &MotionError::attitude},
                                                  {"position", &MotionError::position},
                                                  {"angular velocity", &MotionError::angular_velocity},
                                                  {"linear velocity", &MotionError::linear_velocity}};
MotionError motion_error(const Model<double>& robot, const Moment& found, const Moment& exact);

}  // namespace liecheck::properties
