#pragma once
// Names that a user gives, which must be among those that are known.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The names of some things, such as &Environment::name of each.
template <class Things, class Name>
std::vector<std::string> names_of(const Things& all, Name name) {
  std::vector<std::string> names;
  for (const auto& one : all) names.emplace_back(std::invoke(name, one));
  return names;
}

/// Throws std::invalid_argument, such as "--only: unknown library 'x'; known: a, b", for the first that is not known.
inline void check_known(const std::vector<std::string>& given, const std::vector<std::string>& known,
                        const char* flag, const char* what) {
  for (const std::string& name : given)
    if (std::ranges::find(known, name) == known.end())
      throw std::invalid_argument(
          fmt::format("{}: unknown {} '{}'; known: {}", flag, what, name, fmt::join(known, ", ")));
}

}  // namespace liecheck::properties
