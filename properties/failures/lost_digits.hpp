#pragma once
// Formulas that are right, but cancel for some angles.

#include <failures/calls.hpp>

namespace liecheck::properties {

/// Whether some are known of an operation.
bool has_lost_digits(std::string_view operation);

/// The formula that, computed in the scalar of the calls, errs as most of their results that have lost digits do, in words;
/// or "". What cancels depends on one rounded number, so that another library's errors of the same formula are the same.
std::string lost_digits_of(const Operation& operation, const std::vector<JudgedCall>& calls, bool is_float);

}  // namespace liecheck::properties
