#pragma once
// The error of an operation in a scalar of any width, by block, against the oracles' closed forms at 100
// digits (334 bits, within 1e-98 of the exact value by tests/properties/enclosure_test.cpp). It serves
// scalars that are too wide for the laws' own oracles, which have 50 digits.
//
// Not every block of a law is measured. The others have the denominators of the laws, with one difference: a
// rotation matrix is measured by |R - R_exact| / sqrt 2, which contains both the angle error and the defect
// from orthogonality. For a scalar of 100 digits, the error is only the difference between two formulas with
// 100 digits.

#include <operations/operation.hpp>
#include <timing/cost.hpp>
#include <timing/signature.hpp>

namespace liecheck::properties {

/// Adds the error of each block of `operation`, in units of eps. Throws std::logic_error for an operation
/// that has no closed form here.
void add_wide_errors(std::vector<BlockErrors>& blocks, const Operation& operation, double eps,
                     const WideNumbers& arguments, const WideNumbers& result);

}  // namespace liecheck::properties
