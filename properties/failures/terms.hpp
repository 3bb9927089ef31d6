#pragma once
// Terms of formulas that a wrong result lacks, counts twice, or has with another sign or factor.

#include <failures/substitutions.hpp>

namespace liecheck::properties {

/// "the term -1/2 phi x p has the opposite sign", if the errors of most wrong results are one multiple of one term of the
/// operation's formula, or one term in place of another; or "".
std::string wrong_term_of(const Operation& operation, const std::vector<JudgedCall>& calls);

}  // namespace liecheck::properties
