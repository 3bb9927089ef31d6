#pragma once
// Wrong results that are right ones of another call, or right ones with one change, tell what the code does in their place.

#include <failures/calls.hpp>
#include <string>

namespace liecheck::properties {

/// The calls of an output's operation that returned, and the right results, of a seed that is the same in every campaign: of its
/// first 300 cases, of 1000 if few of these are wrong, or until twelve are. Empty if the oracle does not know the operation.
std::vector<JudgedCall> judged_calls(const Series& series, std::size_t output);

/// Whether most results that are wrong are right ones in float, or those for an argument in float, in words; or "".
std::string float_of(const Operation& operation, const std::vector<JudgedCall>& calls);

/// The one change of the arguments, or of the right result, that gives all wrong results, or else four of five, in words:
/// "where it fails, the result is what rho = 0 would give". A result is given if what is wrong in it is given to a hundredth of its error, which happens by chance
/// once in a hundred calls at most. "" if no change gives them, or if fewer than four results are wrong by a millionth.
std::string substitution_of(const Operation& operation, const std::vector<JudgedCall>& calls);
/// The calls with Euler angles about turned axes (kind 1), or about axes that stay (0), of an operation that takes an order.
std::vector<JudgedCall> calls_of_kind(const std::vector<JudgedCall>& calls, int kind);
/// The same of Euler angles about turned axes alone, or about those that stay.
std::string substitution_of_one_kind(const Operation& operation, const std::vector<JudgedCall>& calls);
/// Parts of the result that are right but for their lengths, in words; or "".
std::string wrong_length_of(const Operation& operation, const std::vector<JudgedCall>& calls);

}  // namespace liecheck::properties
