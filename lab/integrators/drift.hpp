#pragma once
// The drift of energy and momentum over a run, split into a linear trend and an oscillation.

#include <Eigen/Core>
#include <scenes/runner.hpp>
#include <vector>

namespace liecheck::properties {

/// The drift of a conserved quantity, relative to its norm at the start: the slope of the least-squares line
/// [1/s] and the largest distance from that line. `samples` is 0 if the scene does not conserve the quantity.
struct Drift {
  std::size_t samples = 0;
  double slope = 0, oscillation = 0;
};

/// The drift of the vectors x[k] at times t[k] [s], relative to max(|x[0]|, scale). The slope of a vector is
/// given by its norm; that of a single number has a sign.
Drift drift_of(const std::vector<double>& t, const std::vector<Eigen::VectorXd>& x, double scale = 0);

/// The drifts in a run of a scene, in double, from samples at the start and after each of `samples` equal
/// parts. Energy is the kinetic energy plus all potentials, if the scene is conservative. Momentum is the
/// angular momentum about the centre of mass, if no external force acts. Throws Diverged.
struct Drifts {
  Drift energy, momentum;
};
Drifts drifts_of(Runner& runner, const Benchmark& scene, const Effort& effort, long samples);

}  // namespace liecheck::properties
