#pragma once
// Confirms the reference of a scene without a closed form by its second formulation (independent.hpp).

#include <atomic>
#include <scenes/benchmark.hpp>
#include <scenes/truth.hpp>

namespace liecheck::properties {

struct Confirmation {
  std::string unconfirmed;  ///< why the second formulation has no motion; empty if it has
  MotionError apart{};      ///< the largest errors of one against the other
  std::vector<Moment> at;   ///< the second motion
};

/// Compares `moments`, the states at the ends of equal parts of the duration, with maximal coordinates, which are
/// integrated in long double, with 11 bits more than double, for at most a minute, to a tolerance of a few units in the
/// last place (2^-63), for the rounding errors that extrapolation amplifies. Throws Stopped.
Confirmation confirmation_of(const Benchmark& scene, const std::vector<Moment>& moments,
                             const std::atomic<bool>* stop, long double tolerance = 0x1p-57L);

}  // namespace liecheck::properties
