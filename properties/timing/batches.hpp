#pragma once
// Batches of liecheck as rows of `cost`: one call computes all inputs, so a batch has no latency.

#include <operations/operation.hpp>
#include <timing/signature.hpp>

namespace liecheck::properties {

/// The subject that gives the row of a batch its name and its errors.
inline constexpr const char* batch_subject = "liecheck:batch";

/// The passes compute all inputs in one call. All pointers are null if the operation has no batch.
template <class S>
Signature batch_signature(const Operation& operation);

}  // namespace liecheck::properties
