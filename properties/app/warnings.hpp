#pragma once
// Warnings of a URDF on stderr.

#include <fmt/format.h>
#include <string>
#include <vector>

namespace liecheck::properties {

inline void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

}  // namespace liecheck::properties
