#pragma once
// Formulas that are right, but cancel for some angles.

#include <failures/calls.hpp>

namespace liecheck::properties {

/// Whether some are known of an operation.
bool has_lost_digits(std::string_view operation);

/// The formula that, computed in the scalar of the calls, errs as most of their results that have lost digits do, in words;
/// or "". The error of a difference that cancels is that of one rounded number, the same in every library with the formula.
std::string lost_digits_of(const Operation& operation, const std::vector<JudgedCall>& calls, bool is_float);

}  // namespace liecheck::properties
