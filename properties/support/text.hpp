#pragma once
// Escapes text for a terminal, a shell, a file name or a CSV file.

#include <string>

namespace liecheck::properties {

/// Returns the text on one line, with control characters (C0, DEL, C1), invisible format characters and bytes that are not
/// UTF-8 escaped as \n, \t or \xNN.
std::string printable(const std::string& text);

/// The same for a text of several lines, which keeps its ends of lines and its tabs.
std::string printable_lines(const std::string& text);

/// Returns the text without the byte order mark that some editors write before it.
std::string without_mark(const std::string& text);

/// Returns a name for a file in a folder: letters, digits, '-', '_' and '.' of the text, with '_' for each other byte and for
/// a leading dot. So no text leads out of the folder or names a hidden file.
std::string file_name(const std::string& text);

/// Returns one word for a POSIX shell, quoted where necessary.
std::string shell_quoted(const std::string& word);

/// A command of liecheck as its user types it: "liecheck WORDS". What starts the program may name itself in
/// LIECHECK_CALLED_AS, as in "npx liecheck", and in LIECHECK_SERVES what it writes before the name of an adapter.
std::string as_typed(const std::string& words);
/// The command that repeats a case.
std::string replay_words(const std::string& id, const std::string& flags = "");

/// Whether the text is one line that runs `liecheck replay` or `liecheck lab replay` and nothing else in a POSIX shell: outside
/// of single quotes, it has only letters that shell_quoted() leaves as they are.
bool is_replay(const std::string& text);

/// Returns the text as a part of XML or HTML, in an element or an attribute; control characters as &#NN;.
std::string xml_escaped(const std::string& text);

/// Returns a field of a CSV file (RFC 4180): printable_lines(), quoted where necessary, with quotes doubled. A text that a
/// spreadsheet would run as a formula gets an apostrophe before it.
std::string csv_field(const std::string& text);

}  // namespace liecheck::properties
