#pragma once
// The libraries of other projects that are subjects of the program.

#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties {

/// Whether the profile `careful` judges the subject, because it never promised liecheck's limits.
bool is_other_library(std::string_view subject);

/// Names of the optional libraries that the build did not find. The file of such a subject registers nothing.
/// registry.cpp lists the optional libraries.
std::vector<std::string> absent_subjects();

}  // namespace liecheck::properties
