#pragma once
// Foreign text on its way to a terminal or a shell.

#include <string>

namespace liecheck::properties {

/// On one line and without control characters (C0, DEL, C1), which are escaped as \n, \t or \xNN.
std::string printable(const std::string& text);

/// One word for a POSIX shell, quoted where it needs to be.
std::string shell_quoted(const std::string& word);

}  // namespace liecheck::properties
