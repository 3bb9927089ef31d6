#pragma once
// Subjects whose functions run in another process. A campaign calls them for many cases at once, which costs as much
// as one call: support/together.hpp.

#include <set>
#include <string>

namespace liecheck::properties {

/// Their names.
std::set<std::string>& remote_subjects();

}  // namespace liecheck::properties
