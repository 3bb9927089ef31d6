#pragma once
// What the author of an adapter runs first, and what comes before a campaign: each operation is called at moderate
// arguments, and the conventions in which the adapter differs from liecheck are named.

#include <adapters/adapter.hpp>
#include <conventions/probe.hpp>
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

/// Calls each offered operation at six inputs: in one batch, and one by one. Both must give the same bits, and
/// results that agree with the oracles to a thousandth.
Checked check(Adapter& adapter);

}  // namespace liecheck::properties::adapters
