#pragma once
// What `liecheck hard-cases` and the first section of every campaign print.

#include <hard_cases/hard_cases.hpp>
#include <cstdio>

namespace liecheck::properties {

/// The built-in corpus and more files of hard cases.
std::vector<HardCase> corpus_with(const std::vector<std::string>& files);

/// A line of counts for each subject and scalar, and the first failures.
void print_hard_case_summary(const std::vector<HardRow>& rows, std::size_t shown_failures);

/// A line for each case, a letter for each subject and scalar.
void print_hard_case_table(const std::vector<HardRow>& rows);

/// Puts the rows into a record; its verdict becomes "fail" where one failed.
void add_hard_cases(nlohmann::json& record, const std::vector<HardRow>& rows);

}  // namespace liecheck::properties
