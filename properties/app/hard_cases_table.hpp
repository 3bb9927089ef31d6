#pragma once
// Verdicts on hard cases as text.

#include <hard_cases/hard_cases.hpp>

namespace liecheck::properties {

/// Prints the first section of every campaign: counts for each subject and scalar, and the first failures.
void print_hard_case_summary(const std::vector<HardRow>& rows, std::size_t shown_failures);

/// Prints a line for each case, with a letter for each subject and scalar.
void print_hard_case_table(const std::vector<HardRow>& rows);

}  // namespace liecheck::properties
