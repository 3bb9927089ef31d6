#pragma once
// The records of operations as the table of docs/operations.md.

#include <string>

namespace liecheck::properties {

/// The page in Markdown, with a final newline.
std::string operations_table();

}  // namespace liecheck::properties
