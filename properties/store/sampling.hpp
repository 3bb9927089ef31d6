#pragma once
// Whether two samples of errors may come from the same code: docs/measuring.md, section Two campaigns.

#include <campaign/tally.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// What is worse in `is` than in `was`, two samples of the same cell with different inputs, and would be seen by
/// chance alone less than once in 1e9 comparisons; nothing else.
///
/// A single case proves nothing: with m of n + m cases, the largest error is in the later sample with the probability
/// m / (n + m), and so is a failure that occurs once. So counts are compared, not maxima: of the cases that fail, and
/// of the cases above the largest earlier error, how many are in which sample? Fisher's exact test. The whole
/// distributions are compared by the test of Kolmogorov and Smirnov.
std::vector<std::string> worse_by_more_than_chance(const Row& was, const Row& is);

/// Whether an error grew by more than another order of operations or a rounding of the result could explain.
inline bool grown(double from, double to) {
  return to > from * 1.1 && to > from + 0.5;
}

}  // namespace liecheck::properties
