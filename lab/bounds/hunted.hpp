#pragma once
// The largest error in double of the hard cases, which searches found, for the blocks that have a proof.

#include <string>

namespace liecheck::properties {

/// The largest error [eps] in double of one block for rotations up to pi, over all hard cases and one more input that a search
/// found: a lower bound of the maximum.
/// 0 if no hard case measures it.
double largest_error_of_hard_cases(const std::string& operation, const std::string& block);

}  // namespace liecheck::properties
