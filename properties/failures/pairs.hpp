#pragma once
// Numbers that were returned, or that a law formed from what was returned, beside the exact ones.

#include <failures/calls.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties {

/// A number that was returned, and the exact one.
struct NumberPair {
  std::string name;
  double got;
  oracles::Real exact;
  double apart = 0;  ///< relative to the norm of its part; infinite if the number is not finite
};

/// Whether a block concerns a part of a result: it has its unit.
bool is_judged(const Output& output, const Layout& layout, const Part& part);
/// Whether a block concerns number i of a result of so many. Of a 6 x 6 or 9 x 9 matrix, the coupling block is the upper right
/// one, of a coadjoint the lower left one, of an extended pose the upper two of the last three columns; the block of a
/// Jacobian has all other numbers.
bool is_in_block(const Output& output, std::size_t size, std::size_t i);

/// The numbers of a call's result that an output judges, or all if the call is of another operation.
/// Of a subject that returns poses as (p, Q), the R of a pose is the Q that it returned, but for its sign and last bit.
std::vector<NumberPair> pairs_of(const Output& output, const NotedCase& noted, const NotedCall& call,
                                 const std::vector<oracles::Real>& one_side);

/// What a law on trees compares, by the names of the result or of the product that the law forms.
std::vector<NumberPair> pairs_of_law(const Output& output, const NotedComparison& compared);

/// What a law compares in place of the numbers of a result, and the vectors that this needs beside the operation's arguments.
struct FormedNumbers {
  std::string_view operation, block;  ///< the block, or "" for each
  std::string_view name, vectors;     ///< "(A_g v)", "v"
};
/// Of an output; null if its numbers are those of the result.
const FormedNumbers* formed_numbers(const Output& output);

}  // namespace liecheck::properties
