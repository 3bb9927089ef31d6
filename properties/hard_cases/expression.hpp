#pragma once
// The expression language of fixtures/hard_cases (defined in its README). One expression serves every scalar.
//
// An expression is evaluated at 100 digits. Then each number is rounded once, to nearest even, to the scalar:
// `pi` is the float nearest to pi in float and the double nearest to pi in double, and `nextup(pi)` is the
// next number above it. The constants eps, min_normal, denorm_min and max and the functions round, nextup,
// nextdown and scaled depend on the scalar.

#include <oracles/scalar.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties {

using oracles::Scalar;

/// The numbers of a comma-separated list, each a hexadecimal float that the scalar holds exactly. Throws
/// std::invalid_argument with the place of a syntax error, an unknown name or a number beyond the scalar's
/// range. Also throws for a number that was typed and rounds to zero, and if all numbers of the list round to
/// zero but not all are zero.
std::vector<std::string> evaluate(std::string_view text, const Scalar& scalar);

}  // namespace liecheck::properties
