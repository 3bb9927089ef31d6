#pragma once
// What the author of an adapter runs first: each operation is called at moderate arguments.

#include <adapters/adapter.hpp>
#include <vector>

namespace liecheck::properties::adapters {

/// One operation in one scalar. `complaint` says in words what is wrong with its answers; "" if nothing is.
struct CheckedOperation {
  std::string operation, scalar, complaint;
};

/// Calls each offered operation three times: in one batch, and one by one. Both must give the same bits, and
/// results that agree with liecheck's to a thousandth.
std::vector<CheckedOperation> check(Adapter& adapter);

}  // namespace liecheck::properties::adapters
