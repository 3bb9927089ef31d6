#pragma once
// Prints text on standard output. Names, versions, reasons and file names come from others, so control characters are
// escaped, which could otherwise act on a terminal. Only colours (terminal.hpp) are printed without it.

#include <fmt/format.h>

#include <string>
#include <utility>

namespace liecheck::properties {

/// Prints printable_lines(text). Throws std::system_error if standard output is lost.
void say_text(const std::string& text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_text(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace liecheck::properties
