#pragma once
// What a campaign finds beside its random cases.

#include <string>
#include <vector>

namespace liecheck::properties {

/// What the probe of an adapter finds of one operation.
struct ProbedOperation {
  std::string subject, operation, sentence;
  bool wrong = false;  ///< or a stated choice is broken; otherwise it has another convention, and no law judges it
  bool operator==(const ProbedOperation&) const = default;
};

struct FailedHardCase {
  std::string subject, scalar, name, operation, block, verdict;
  bool operator==(const FailedHardCase&) const = default;
};

struct BesideCases {
  std::vector<ProbedOperation> probed = {};
  std::string corpus = {};  ///< the digest of the hard cases' names and inputs; "" if they were not all replayed
  std::vector<FailedHardCase> failed = {};
};

}  // namespace liecheck::properties
