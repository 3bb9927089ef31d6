#pragma once
// Escapes text for a terminal, a shell or a CSV file.

#include <string>

namespace liecheck::properties {

/// Returns the text on one line, with control characters (C0, DEL, C1) and bytes that are not UTF-8 escaped as \n,
/// \t or \xNN.
std::string printable(const std::string& text);

/// Returns one word for a POSIX shell, quoted where necessary.
std::string shell_quoted(const std::string& word);

/// Returns a field of a CSV file (RFC 4180), quoted where necessary, with quotes doubled.
std::string csv_field(const std::string& text);

}  // namespace liecheck::properties
