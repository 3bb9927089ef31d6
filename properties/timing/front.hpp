#pragma once
// Finds the rows that another row of the same operation dominates in error and time.

#include <timing/cost.hpp>

namespace liecheck::properties {

/// The largest error of any block over all inputs, as the block defines it (not in eps). It is infinite if a
/// result was not finite, on a wrong branch, refused or unresolved. Defects of norm or orthogonality do not
/// count, because the next operation removes them.
double error_of(const CostRow& row);
/// The block with this error.
std::string worst_block(const CostRow& row);

enum class TimeOf { throughput, latency };

/// For each row, the index of the fastest row of the same operation that dominates it, or -1. A row dominates
/// another if it is faster (disjoint intervals) and its error is no larger, or if its error is smaller and
/// its median time no larger. The row `call`, which has no error, and the rows liecheck@FLAGS are left out.
std::vector<int> dominators(const std::vector<CostRow>& rows, TimeOf kind);

}  // namespace liecheck::properties
