#pragma once
// The records of operations as the table of docs/operations.md.

#include <string>

namespace liecheck::properties {

/// Markdown, ends with a newline.
std::string operations_table();

}  // namespace liecheck::properties
