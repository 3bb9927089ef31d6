#pragma once
// Verdicts on hard cases as text.

#include <hard_cases/hard_cases.hpp>

namespace liecheck::properties {

/// The first section of every campaign: a line of counts for each subject and scalar, and the first failures.
void print_hard_case_summary(const std::vector<HardRow>& rows, std::size_t shown_failures);

/// A line for each case, a letter for each subject and scalar.
void print_hard_case_table(const std::vector<HardRow>& rows);

}  // namespace liecheck::properties
