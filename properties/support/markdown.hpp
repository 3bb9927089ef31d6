#pragma once
// Text of others in Markdown.

#include <string>

namespace liecheck::properties {

/// The text without characters that Markdown would not show as they are, on one line.
std::string markdown(const std::string& text);

/// The text as a block of code, which no line of the text ends.
std::string markdown_block(const std::string& text);

}  // namespace liecheck::properties
