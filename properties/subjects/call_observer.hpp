#pragma once
// Shows the checked calls of a thread (call_log.hpp), with the bits of their results. All checked calls run in the
// rounding mode and with the treatment of subnormals that mode_of_calls says (support/float_environment.hpp).

#include <functional>
#include <operations/operation.hpp>
#include <string>

namespace liecheck::properties {

/// Receives the operation, a key of the call within its case, and the bits of its result.
using CallObserver =
    std::function<void(const Operation& operation, const std::string& key, const std::string& result)>;

/// The observer of this thread, or null.
CallObserver*& call_observer();

}  // namespace liecheck::properties
