#pragma once
// Which points of error against time are worth having.

#include <timing/cost.hpp>

namespace liecheck::properties {

/// The largest error found of any block over all inputs, relative as the block measures it (not in eps); infinite
/// where a result was not finite, on a wrong branch, refused or unresolved. Defects of norm or orthogonality, which
/// the next operation takes out again, do not count.
double error_of(const CostRow& row);
/// The block that it comes from.
std::string worst_block(const CostRow& row);

enum class TimeOf { throughput, latency };

/// For each row the index of one of the same operation that is faster for certain (disjoint intervals) and errs no
/// more, or that errs less and is not slower; -1 where there is none: the front. Of several, the fastest.
/// The row `call` has no error and takes no part, nor do other flags (liecheck@...).
std::vector<int> dominators(const std::vector<CostRow>& rows, TimeOf kind);

}  // namespace liecheck::properties
