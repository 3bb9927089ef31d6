#pragma once
// What a check of an adapter finds.

#include <conventions/finding.hpp>
#include <string>
#include <vector>

namespace liecheck::properties::adapters {

/// One operation in one scalar. `complaint` says in words what is wrong with its answers; "" if nothing is.
struct CheckedOperation {
  std::string operation, scalar, complaint;
};

struct Checked {
  std::vector<CheckedOperation> operations;
  std::vector<conventions::Finding> findings;  ///< a difference in one scalar only says in which
};

}  // namespace liecheck::properties::adapters
