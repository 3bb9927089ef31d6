#pragma once
// Shrinking: replaces a failing input by a simpler one that still fails in the same way.
//
// Greedy passes try the law's own simpler inputs and simpler values of each group: zero or identity,
// rotations by pi/2 and pi, axis-aligned vectors, unit scale, powers of two, short decimals, few bits. A
// candidate is accepted if it is valid and still fails, with at least a tenth of the error, and not as a limits
// file expects. The search stops after a number of evaluations, after two seconds, or at stop_requested.

#include <algorithm>
#include <campaign/series.hpp>
#include <chrono>
#include <functional>
#include <generators/shrinks.hpp>
#include <support/stop.hpp>
#include <vector>

namespace liecheck::properties {

/// The simplest input found that still fails in the same way.
struct Shrunk {
  CaseId id;
  std::vector<std::string> decimal;
  Judged judged;
  bool reproduced = true;  ///< false: the input did not fail again, or gave another result, and is not shrunk
};

/// Shrinks a failing case of one output: at most `evaluations` measurements and two seconds.
Shrunk shrink(const Series& series, const CaseId& id, int output, int evaluations);

template <class S>
std::vector<S> shrink_input(
    std::vector<S> input, const std::vector<Field>& fields,
    const std::function<bool(const std::vector<S>&)>& still_fails, int evaluations,
    const std::function<std::vector<std::vector<S>>(const std::vector<S>&)>& simpler = {}) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  const auto exhausted = [&] {
    return evaluations-- <= 0 || stop_requested || std::chrono::steady_clock::now() > deadline;
  };
  const auto any_simpler = [&] {
    for (auto& attempt : simpler(input)) {
      if (exhausted()) return false;
      if (still_fails(attempt)) {
        input = std::move(attempt);
        return true;
      }
    }
    return false;
  };
  bool improved = true;
  while (improved) {
    improved = false;
    while (simpler && any_simpler()) improved = true;
    std::size_t from = 0;
    for (const Field& f : fields) {
      const auto size = static_cast<std::size_t>(f.size);
      const std::vector<S> group(input.begin() + static_cast<std::ptrdiff_t>(from),
                                 input.begin() + static_cast<std::ptrdiff_t>(from + size));
      for (const auto& candidate : shrinks::candidates<S>(group, f.kind)) {
        if (candidate == group) break;  // later candidates are no simpler
        if (exhausted()) return input;
        std::vector<S> attempt = input;
        std::copy(candidate.begin(), candidate.end(), attempt.begin() + static_cast<std::ptrdiff_t>(from));
        if (still_fails(attempt)) {
          input = attempt;
          improved = true;
          break;
        }
      }
      from += size;
    }
  }
  return input;
}

}  // namespace liecheck::properties
