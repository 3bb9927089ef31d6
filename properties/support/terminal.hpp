#pragma once
// Colours of standard output: on a terminal only, and not if NO_COLOR is set (no-color.org).

#include <string>

namespace liecheck::properties {

enum class Colour { red = 31, green = 32, yellow = 33, bold = 1 };

/// The text in a colour if standard output shows colours, else the text.
std::string coloured(Colour colour, const std::string& text);

}  // namespace liecheck::properties
