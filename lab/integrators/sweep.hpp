#pragma once
// Measures the error, drift and time of integrators x steps on scenes.
//
// Each of the four errors is the largest at the ends of the four quarters of the duration, against the exact motion or
// against a reference of two runs that a second formulation confirms (reference.hpp). The drift of energy and momentum
// uses at most 129 samples (drift.hpp). The time is processor time per simulated second. The runs of all
// points of a scene are timed in random order (timing/benchmarks.hpp).

#include <atomic>
#include <integrators/drift.hpp>
#include <integrators/order.hpp>
#include <integrators/peers/peer.hpp>
#include <scenes/truth.hpp>
#include <timing/cost.hpp>

namespace liecheck::properties {

struct SweepPoint {
  Effort effort;
  long steps = 0;  ///< steps made
  MotionError error;
  Drift energy, momentum;
  Spread time;           ///< [ns] per simulated second; no repetitions if not timed
  std::string diverged;  ///< when and why; empty if it did not
};

/// One method on one scene in double.
struct SweepSeries {
  std::string subject, version, integrator;  ///< subject: "liecheck" or a peer
  int order = 0;
  bool adaptive = false;
  std::vector<SweepPoint> points;  ///< each has half the step of the one before, or a tenth of the tolerance
  /// The smallest error of any point, and whether smaller steps no longer lowered it.
  double smallest = 0;
  bool at_floor = false;
};

/// The observed order of a method on a scene with a known motion. `exact` means that all errors are rounding.
struct OrderRow {
  std::string integrator, scalar;
  int promised = 0;
  bool exact = false;
  std::vector<double> errors;
  std::vector<long> steps;
  ObservedOrder observed;
};

/// A peer that cannot run a scene.
struct LeftOut {
  std::string peer, why;
};

struct SceneSweep {
  Benchmark scene;
  std::string truth;  ///< name of the exact motion or of the reference
  bool closed = false;
  MotionError disagreement{};  ///< of the two runs that make the reference; 0 for a closed form
  std::vector<SweepSeries> series;
  std::vector<OrderRow> orders;
  std::vector<LeftOut> left_out;
};

struct SceneSweepOptions {
  std::vector<std::string> integrators;  ///< empty: all
  std::vector<long> steps;  ///< over the whole duration, multiples of 4; empty: from coarse to the floor
  std::size_t order_scenes = 1000;  ///< number of closed forms that must show a method's order; 0: none
  double order_seconds = 20;        ///< approximate limit for measuring one order [s]
  double longest = 0.02;            ///< runs that take longer are not timed [s], unless `seconds` allow it
  double seconds = 20;              ///< approximate time for all timing [s]; 0: no timing
  std::size_t repetitions = 11;
  bool peers = true;
  std::atomic<bool>* stop = nullptr;
  std::function<void(double share, const std::string& what)> progress = [](double, const std::string&) {};
};

/// Throws std::invalid_argument naming an integrator that does not exist.
std::vector<SceneSweep> sweep_scenes(const std::vector<Benchmark>& scenes, const SceneSweepOptions& options);

/// Returns a line for each settled order that is off by more than 0.1, and a line for each method whose order
/// is right on fewer than `scenes` closed forms. Closed forms for which the method is exact do not count.
std::vector<std::string> wrong_orders(const std::vector<SceneSweep>& all, std::size_t scenes = 3);

/// Compares liecheck with a peer on a scene by one of the error_measures. For each point of the peer,
/// liecheck's time is its shortest time for an error that is no larger, interpolated between two points
/// (log-log). `ratio` is the largest ratio of liecheck's median time to the peer's. If it is below 1,
/// liecheck is faster at every compared point. low and high are the ends of its 95 % confidence interval.
/// Errors that the reference does not know (reference.hpp), and errors of more than 1 (a wrong motion), are
/// not compared.
struct PeerComparison {
  std::string scene, peer, integrator, measure;
  std::size_t points = 0;  ///< points of the peer that were compared
  std::size_t behind = 0;  ///< points at which liecheck's time is longer
  double ratio = 0, low = 0, high = 0;
  double error = 0;        ///< of the peer, at the point of the largest ratio
  std::string ours;        ///< liecheck's integrator at that point
  bool unmatched = false;  ///< a point of the peer is more accurate than all of liecheck's
};
std::vector<PeerComparison> compare_peers(const std::vector<SceneSweep>& all);

}  // namespace liecheck::properties
