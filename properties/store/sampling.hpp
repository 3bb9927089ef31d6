#pragma once
// Whether two samples of errors may come from the same code: docs/measuring.md, section Two campaigns.
//
// A single case proves nothing: with m of n + m cases, the largest error is in the later sample with the probability
// m / (n + m), and so is a failure that occurs once. So counts are compared, not maxima, and whole distributions. The
// tests say yes by chance alone less than once in 1e9 comparisons.

#include <campaign/histogram.hpp>

namespace liecheck::properties {

/// Whether more of the marked cases are in the second sample, of m cases, than chance would put there. Fisher's exact
/// test, one-sided: the hypergeometric distribution.
bool too_many(std::uint64_t marked_a, std::uint64_t n, std::uint64_t marked_b, std::uint64_t m);

/// Whether the second sample has larger errors. One-sided two-sample test of Kolmogorov and Smirnov:
/// P(D > d) -> exp(-2 d^2 n m / (n + m)).
bool shifted(const Histogram& a, const Histogram& b);

}  // namespace liecheck::properties
