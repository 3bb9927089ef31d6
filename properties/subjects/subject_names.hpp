#pragma once
// The names of the subjects, and which of them are libraries of other projects.

#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties {

/// Every subject, in either scalar, in alphabetical order.
std::vector<std::string> subject_names();

/// Whether the profile `careful` judges the subject, because it never promised liecheck's limits.
bool is_other_library(std::string_view subject);

/// Names of the optional libraries that the build did not find. The file of such a subject registers nothing.
/// registry.cpp lists the optional libraries.
std::vector<std::string> absent_subjects();

}  // namespace liecheck::properties
