#pragma once
// Shrinking: from a failing input to the smallest one that still fails in the same way.
//
// Greedy passes over the law's own simpler inputs and over the groups of the input, each candidate kept only if it
// stays valid and still fails: zero or identity, quarter and half turns, axis-aligned, unit scale, powers of two, short
// decimals, few bits. Bounded by a number of evaluations and by two seconds.

#include <algorithm>
#include <campaign/series.hpp>
#include <chrono>
#include <functional>
#include <generators/shrinks.hpp>
#include <vector>

namespace liecheck::properties {

/// The smallest input found that still fails in the same way.
struct Shrunk {
  CaseId id;
  std::vector<std::string> decimal;
  Judged judged;
};

/// Shrinks a failing case of one output: at most `evaluations` measurements and two seconds.
Shrunk shrink(const Series& series, const CaseId& id, int output, int evaluations);

template <class S>
std::vector<S> shrink_input(
    std::vector<S> input, const std::vector<Field>& fields,
    const std::function<bool(const std::vector<S>&)>& still_fails, int evaluations,
    const std::function<std::vector<std::vector<S>>(const std::vector<S>&)>& simpler = {}) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  const auto exhausted = [&] { return evaluations-- <= 0 || std::chrono::steady_clock::now() > deadline; };
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
        if (candidate == group) break;  // the rest is no simpler
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
