#pragma once
// Batches of liecheck as rows of `cost`: one call computes all inputs, so a batch has a throughput but no latency.

#include <timing/signature.hpp>

namespace liecheck::properties {

/// The subject whose errors stand in the row of a batch.
inline constexpr const char* batch_subject = "liecheck:batch";

/// Passes over all inputs at once; null for an operation without a batch.
template <class S>
Signature batch_signature(const Operation& operation);

}  // namespace liecheck::properties
