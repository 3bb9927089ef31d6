#pragma once
// Failing inputs of earlier runs, run again before anything new.

#include <campaign/campaign.hpp>

namespace liecheck::properties {

/// A failing input, as a store keeps it.
struct Counterexample {
  std::string property, subject, scalar, robot, operation, block;
  std::string input;  ///< hexadecimal floats, joined by commas
  auto operator<=>(const Counterexample&) const = default;
};

Counterexamples replay_counterexamples(const std::vector<Counterexample>& all,
                                       const std::vector<SeriesResult>& series);

}  // namespace liecheck::properties
