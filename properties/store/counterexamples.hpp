#pragma once
// Counterexamples: failing inputs of earlier runs, replayed before the cases of a new one.

#include <campaign/campaign.hpp>

namespace liecheck::properties {

struct Counterexample {
  std::string property, subject, scalar, robot, operation, block;
  std::string input;  ///< hexadecimal floats, joined by commas
  auto operator<=>(const Counterexample&) const = default;
};

/// The result of replaying counterexamples.
struct Counterexamples {
  struct Failing {
    std::string operation, block, id;
  };
  std::size_t replayed = 0;
  std::size_t skipped = 0;  ///< inputs for another robot, outside the selection or rejected by the law
  std::vector<Failing> failing;
  bool complete = true;  ///< false if stop_requested ended the replay
};

Counterexamples replay_counterexamples(const std::vector<Counterexample>& all,
                                       const std::vector<SeriesResult>& series);

}  // namespace liecheck::properties
