#pragma once
// Long horizons: what is left of a pose after up to 10^9 calls of integrate, of a product with a normalisation, or of
// compose, and how the errors grow.

#include <cstdint>
#include <functional>
#include <horizons/horizon.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// What each step of a walk calls.
enum class Step { integrate, first_order_normalize, normalize, compose, scene };

/// A way in which an attitude is moved: docs/laboratory.md.
struct Walk {
  const char* name;
  Step step;
  bool random = true;    ///< its paths differ
  bool repeated = true;  ///< its increments come again
  double norm = 0;       ///< what liecheck must keep [eps]; 0: not judged
  double angle = 0;      ///< the same, over sqrt(n)
};
inline constexpr Walk horizon_walks[] = {
    {"pure", Step::integrate, false, true, 4},
    {"coning", Step::integrate, false, true, 4},
    {"random", Step::integrate, true, true, 4, 2},
    {"first_order", Step::first_order_normalize, true, true, 4},
    {"full", Step::normalize, true, true, 4},
    {"back", Step::compose, true, false, 0, 8},
    {"back_repeated", Step::compose},
    {"scene", Step::scene},
};
std::vector<std::string> horizon_walk_names();

struct HorizonOptions {
  std::vector<std::string> subjects{"liecheck"}, scalars{"float", "double"}, walks = horizon_walk_names();
  std::uint64_t steps = 1'000'000;  ///< of each path
  unsigned paths = 4;               ///< with other random numbers, for the mean of squares
  std::uint64_t seed = 42;
  unsigned jobs = 1;
  std::string state;  ///< a file from which a path goes on, or ""
  /// The name of a path and the share of its steps that is done. Threads call it one after another.
  std::function<void(const std::string&, double)> progress;
  /// What a subject does not offer, in words.
  std::function<void(const std::string&)> left_out;
};

/// Measures each walk of each subject, reports it, and writes the state now and then and at the end. A walk that is not
/// offered is left out, and `scene` is left to scene_horizons.hpp. Returns false if stop_requested. Throws
/// std::invalid_argument for an unknown name, or for a state of other options.
bool measure_horizons(const HorizonOptions& options, const std::function<void(const Horizon&)>& report);

}  // namespace liecheck::properties
