#pragma once
// The libraries of other projects that are subjects of the program.

#include <string_view>

namespace liecheck::properties {

/// Whether the profile `careful` judges the subject, because it never promised liecheck's limits.
bool is_other_library(std::string_view subject);

}  // namespace liecheck::properties
