#pragma once
// How many numbers each operation takes and gives.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties::adapters {

struct OperationSizes {
  std::string_view operation;
  std::size_t inputs, results;
};

/// The operations that an adapter can offer, in the order of docs/operations.md, then a library's own checks
/// check_quaternion and check_rotation, which have no result.
const std::vector<OperationSizes>& all_sizes();

/// Those without the checks.
std::span<const OperationSizes> operation_sizes();

/// all_sizes() for an adapter whose poses are (p, Q).
const std::vector<OperationSizes>& quaternion_sizes();

/// The place of one of all_sizes() or of quaternion_sizes().
std::size_t place_of(const OperationSizes& sizes);

/// One of all_sizes(), or null if there is no such operation.
const OperationSizes* sizes_of(std::string_view operation);

/// Whether an adapter can offer the operation: one of all_sizes(), or one on trees or robots.
bool is_operation(std::string_view name);
/// What to say of a name that is no operation; of a former name, the present one.
std::string no_operation(std::string_view name);

}  // namespace liecheck::properties::adapters
