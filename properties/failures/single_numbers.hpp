#pragma once
// What single numbers of wrong results tell: which are wrong, and whether they are computed from overwritten ones.

#include <failures/substitutions.hpp>

namespace liecheck::properties {

/// The order of Euler angles whose results the wrong ones are, in words; or "".
std::string other_order_of(const Operation& operation, const std::vector<JudgedCall>& calls);

/// Whether a product is computed in place, so that its later numbers use the first ones of the result, in words; or "".
std::string in_place_of(const Operation& operation, const std::vector<JudgedCall>& calls);

/// Whether wrong results are right but for a power of the norm of Q, by which too much or too little is divided; or "".
std::string norm_power_of(const Operation& operation, const std::vector<JudgedCall>& calls);

/// The numbers that are wrong in words, if the same third of all, or fewer, are wrong in all calls; or "".
std::string wrong_numbers_of(const Operation& operation, const std::vector<JudgedCall>& calls);

/// An angle that is wrong by the same number in all wrong results, as where pi has few digits, in words; or "".
std::string constant_of(const Operation& operation, const std::vector<JudgedCall>& calls);

/// To how many digits nine of ten wrong results are right, if these are two or more, in words; or "".
std::string approximation_of(const Operation& operation, const std::vector<JudgedCall>& calls);

}  // namespace liecheck::properties
