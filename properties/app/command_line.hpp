#pragma once
// The command line of the program: reading it, and running the command that it names.

#include <memory>
#include <optional>
#include <string>

namespace liecheck::properties {

struct Program;

/// The message as a line for a terminal: printable, in valid UTF-8, and without the middle of a message of more than
/// 2000 bytes, which quotes a long value: its first part names the place, its last part the reason.
std::string one_line(const std::string& message);

class CommandLine {
 public:
  /// typed_line: the whole command line, quoted for a shell.
  CommandLine(const Program& program, const std::string& typed_line);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Reads the arguments; argv[0] is the program. Prints the help or the version if they ask for it, and returns the
  /// exit code. Throws std::invalid_argument if they are wrong. It may be called again with others.
  std::optional<int> read(int argc, const char* const* argv);
  /// Runs the command that was read and returns its exit code.
  int run() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace liecheck::properties
