#pragma once
// Numbers written once for every scalar: the little language of fixtures/hard_cases (its README defines it).
//
// An expression is evaluated at 100 digits and each number of its value is rounded once, to nearest even, to the
// scalar at hand: `pi` is pi as a float in float and pi as a double in double, `nextup(pi)` its neighbour there.
// What depends on the scalar are the constants eps, min_normal, denorm_min and max and the functions round,
// nextup, nextdown and scaled.

#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties {

/// The binary format that an expression is rounded to: |x| in [2^min_exponent, 2^max_exponent) when normal.
struct Format {
  std::string name;
  int digits = 0, min_exponent = 0, max_exponent = 0;
};

/// "float", "double" or "float128". Throws std::invalid_argument naming the text.
Format format_of(const std::string& scalar);

/// The numbers of a comma-separated list, each a hexadecimal float that the format holds exactly. Throws
/// std::invalid_argument naming the place and what is wrong: syntax, an unknown name, a number beyond the
/// format's range, or a list of which every number rounds to zero although one is not.
std::vector<std::string> evaluate(std::string_view text, const Format& format);

}  // namespace liecheck::properties
