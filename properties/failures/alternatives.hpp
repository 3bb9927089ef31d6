#pragma once
// Wrong formulas that libraries have in place of the right ones.

#include <failures/substitutions.hpp>

namespace liecheck::properties {

/// Whether some are known of an operation.
bool has_alternatives(std::string_view operation);

/// The formula that gives the results of most calls that are wrong by more than a millionth, in words; or "".
std::string alternative_of(const Operation& operation, const std::vector<JudgedCall>& calls);

}  // namespace liecheck::properties
