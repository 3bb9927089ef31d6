#pragma once
// Integrators x steps on scenes: what error, what drift, what time.
//
// Error: against the truth (truth.hpp), the largest at four quarters of the duration. Where a scene has no truth, ours
// in float128 by gauss12 takes its place, and says so. Drift: of energy and momentum over 128 moments (drift.hpp). Time:
// processor time of a whole run over its duration, all points of a scene interleaved (timing/benchmarks.hpp).

#include <atomic>
#include <scenes/peers/peer.hpp>
#include <scenes/drift.hpp>
#include <scenes/order.hpp>
#include <scenes/truth.hpp>
#include <timing/cost.hpp>

namespace liecheck::properties {

struct SweepPoint {
  Effort effort;
  long steps = 0;  ///< that were made
  MotionError error;
  Drift energy, momentum;
  Spread time;           ///< [ns] per simulated second; no repetitions where not timed
  std::string diverged;  ///< when and why; empty where it ended
};

/// One method on one scene in double.
struct SweepSeries {
  std::string subject, version, integrator;  ///< subject: "liecheck" or a peer
  int order = 0;
  bool adaptive = false;
  std::vector<SweepPoint> points;  ///< each with half the step of the one before, or a tenth of the tolerance
  /// The smallest error in double; a floor where halving the step did not lower it any more.
  double smallest = 0;
  bool at_floor = false;
};

/// The order that a method shows on a scene with a truth. Exact: rounding is all that it errs by.
struct OrderRow {
  std::string integrator, scalar;
  int promised = 0;
  bool exact = false;
  std::vector<double> errors;
  std::vector<long> steps;
  ObservedOrder observed;
};

struct SceneSweep {
  Benchmark scene;
  std::string truth;  ///< its name
  bool closed = false;
  double disagreement = 0;
  std::vector<SweepSeries> series;
  std::vector<OrderRow> orders;
};

struct SceneSweepOptions {
  std::vector<std::string> integrators;  ///< none: all
  std::vector<long> steps;  ///< over the whole duration, multiples of 4; none: from coarse to the floor
  std::size_t order_scenes = 1000;  ///< how many of each method's scenes its order is measured on; 0: none
  double order_seconds = 20;        ///< about the longest that measuring one order takes
  double longest = 0.02;            ///< longer runs are not timed [s]
  double seconds = 20;              ///< about how long all timing takes; 0: none
  std::size_t repetitions = 11;
  bool peers = true;
  std::atomic<bool>* stop = nullptr;
  std::function<void(double share, const std::string& what)> progress = [](double, const std::string&) {};
};

/// Throws std::invalid_argument naming an integrator that does not exist.
std::vector<SceneSweep> sweep_scenes(const std::vector<Benchmark>& scenes, const SceneSweepOptions& options);

/// Does every method show its order to 0.1 over five halvings wherever its order settles, and does it on at least
/// `scenes` scenes with closed forms on which it is not exact? What is wrong, a line each.
std::vector<std::string> wrong_orders(const std::vector<SceneSweep>& all, std::size_t scenes = 3);

/// A peer beside ours on a scene: over all its points, at an error no larger (between two points of ours on the line
/// through them, log-log), the largest of our time over its time.
/// ratio: below 1 where we are faster everywhere; none where no point of ours is as accurate.
struct PeerComparison {
  std::string scene, peer, integrator;
  std::size_t points = 0;  ///< of the peer that were compared
  double ratio = 0;        ///< the worst
  double error = 0;        ///< there
  std::string ours;        ///< what beat it there
  bool unmatched = false;  ///< a point of the peer has no match of ours
};
std::vector<PeerComparison> compare_peers(const std::vector<SceneSweep>& all);

}  // namespace liecheck::properties
