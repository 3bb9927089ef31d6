#pragma once
// The programs: liecheck for its users, and liecheck-lab, which measures liecheck itself (lab/app).

#include <app/command.hpp>
#include <initializer_list>

namespace liecheck::properties {

/// The commands of a program, in the order of its help.
class Commands {
 public:
  using Adder = std::function<Command(CLI::App& parent)>;

  explicit Commands(CLI::App& program) : program_(program) {}
  /// The commands that are added after it stand below this heading in the help.
  void heading(const std::string& text) { heading_ = text; }
  void add(std::initializer_list<Adder> commands);
  /// Adds a group, such as "scene", whose name alone is no command.
  void add_group(const std::string& name, const std::string& help, std::initializer_list<Adder> commands);
  /// Adds a command that has others below it, and runs itself if none of them is named.
  void add_with(const std::string& name, const Adder& command, std::initializer_list<Adder> below);

  const std::vector<Command>& all() const { return all_; }

 private:
  CLI::App& program_;
  std::string heading_;
  std::vector<Command> all_;
};

struct Program {
  const char* name;   ///< as it is called
  const char* title;  ///< the first line of its help, without the version
  void (*add_commands)(Commands& commands, const std::string& typed_line);
};

extern const Program liecheck_program;

/// What main() of a program does. Returns the exit code.
int run_main(int argc, char** argv, const Program& program);

/// Reads the command line, and runs its command or prints the help. Returns the exit code. Throws
/// std::invalid_argument if the command line is wrong. typed_line: as for campaign_command.
int run_program(const Program& program, int argc, char** argv, const std::string& typed_line);

}  // namespace liecheck::properties
