#pragma once
// How many numbers each operation takes and gives.

#include <cstddef>
#include <vector>

namespace liecheck::properties::adapters {

struct OperationSizes {
  const char* operation;
  std::size_t inputs, results;
};

/// The operations that an adapter can offer, in the order of docs/operations.md.
const std::vector<OperationSizes>& operation_sizes();

}  // namespace liecheck::properties::adapters
