#pragma once
// The definitions of operations and blocks in the record, from the records of properties/operations.

#include <nlohmann/json_fwd.hpp>
#include <operations/operation.hpp>

namespace liecheck::properties {

/// Name, defining equation, source, axes, arguments, results and the call of liecheck's own function.
nlohmann::json definition_of(const Operation& operation);

/// Numerator, denominator and unit of the error of one block.
nlohmann::json definition_of(const Output& output);

}  // namespace liecheck::properties
