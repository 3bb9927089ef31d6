#pragma once
// How many numbers each operation takes and gives.

#include <cstddef>
#include <string_view>
#include <vector>

namespace liecheck::properties::adapters {

struct OperationSizes {
  std::string_view operation;
  std::size_t inputs, results;
};

/// The operations that an adapter can offer, in the order of docs/operations.md.
const std::vector<OperationSizes>& operation_sizes();

/// One of operation_sizes(), or null if there is no such operation.
const OperationSizes* sizes_of(std::string_view operation);

/// Whether a process can offer the operation: one of operation_sizes(), or one on trees or robots.
bool is_operation(std::string_view name);

}  // namespace liecheck::properties::adapters
