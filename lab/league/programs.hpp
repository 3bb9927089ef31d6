#pragma once
// Programs in the languages of the league's libraries: how they are run, and what they print.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace liecheck::properties::league {

/// How a program of a language ends its file's name.
std::string suffix(const std::string& language);

/// The command of the list of adapters that runs the program in the file, and that command as a reader sees it.
std::pair<std::string, std::string> commands(const std::string& run, const std::filesystem::path& file);

struct Output {
  std::string text;  ///< what it writes to standard output
  int code = 0;
};

/// Writes the program into the file, and runs it for at most a minute from a new folder, since languages import from that
/// of a program.
Output run_program(const std::string& run, const std::filesystem::path& file, const std::string& program);

/// Whether the output has every number that the adapter returned.
bool confirms(const std::string& output, const std::vector<double>& returned, bool in_float);

/// The numbers in a text, in its order; words such as nan and inf are numbers, too.
std::vector<double> numbers_in(const std::string& text);

}  // namespace liecheck::properties::league
