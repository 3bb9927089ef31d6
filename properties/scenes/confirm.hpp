#pragma once
// Confirms the reference of a scene without a closed form by its second formulation (independent.hpp).

#include <atomic>
#include <scenes/benchmark.hpp>

namespace liecheck::properties {

struct Confirmed {
  std::string name;         ///< of both references, or of one and why it is alone
  double disagreement = 0;  ///< the largest of the four errors of one against the other; 0 if it is alone
};

/// `moments` are the states at the ends of equal parts of the duration, by gauss12 in float128 with `steps`
/// steps. In maximal coordinates, the motion is integrated in long double, with 11 bits more than double.
/// Throws std::invalid_argument if the two are not nearer to each other than gauss12 in double is to them,
/// which is what a sweep compares; and Stopped.
Confirmed confirmed(const Benchmark& scene, const std::vector<Moment>& moments, long steps,
                    const std::atomic<bool>* stop);

}  // namespace liecheck::properties
