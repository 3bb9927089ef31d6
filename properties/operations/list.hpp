#pragma once
// All operations as a list.

#include <operations/description.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// All operations with slots, then the quantities that laws form from them.
const std::vector<const Operation*>& all_operations();

/// The page docs/operations.md in Markdown, with a final newline.
std::string operations_table();

}  // namespace liecheck::properties
