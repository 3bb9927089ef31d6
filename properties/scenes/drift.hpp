#pragma once
// Energy and momentum over a run, split into what goes on and what comes back.

#include <Eigen/Core>
#include <scenes/benchmark.hpp>
#include <vector>

namespace liecheck::properties {

/// Of a quantity that should not change, relative to its size at the start: the least-squares slope [1/s], and the
/// largest distance from that line. `samples`: none where it is not kept by this scene.
struct Drift {
  std::size_t samples = 0;
  double slope = 0, oscillation = 0;
};

/// x [k] at times t [s], a vector each; its change is relative to |x(0)| or, where larger, to `scale`. The slope's norm,
/// signed for one number.
Drift drift_of(const std::vector<double>& t, const std::vector<Eigen::VectorXd>& x, double scale = 0);

/// Watches a run of a scene, in double.
class DriftWatch {
 public:
  explicit DriftWatch(const Benchmark& scene);
  ~DriftWatch();
  void see(double t, const Moment& moment);
  /// Kinetic and potential, of gravity and of what effects say [J]; of a scene without friction.
  Drift energy() const;
  /// Angular, about the centre of mass in the world's axes; of a scene on which nothing acts from outside.
  Drift momentum() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace liecheck::properties
