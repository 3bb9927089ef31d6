#pragma once
// Long horizons: what is left of a pose after up to 10^9 calls of integrate, of a product with a normalisation, or of
// compose, and how the errors grow.

#include <cstdint>
#include <functional>
#include <horizons/horizon.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The ways in which an attitude is moved.
inline const std::vector<std::string> horizon_walks{"pure", "coning", "random",        "first_order",
                                                    "full", "back",   "back_repeated", "scene"};

struct HorizonOptions {
  std::vector<std::string> subjects{"liecheck"}, scalars{"float", "double"}, walks = horizon_walks;
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
/// offered is left out, and `scene` is left to scene_horizons.hpp. Returns false if stop_requested. Throws std::invalid_argument for an unknown name, or for a
/// state of other options.
bool measure_horizons(const HorizonOptions& options, const std::function<void(const Horizon&)>& report);

}  // namespace liecheck::properties
