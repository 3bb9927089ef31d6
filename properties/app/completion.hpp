#pragma once
// Completion of the command line by a shell: a script that knows every command, flag and name of this build.

#include <string>
#include <vector>

namespace liecheck::properties {

struct CompletedFlag {
  std::vector<std::string> names;  ///< with their dashes
  std::string help;
  bool has_value = false;
};

/// A command, or a group of commands, which has no flags.
struct CompletedCommand {
  std::string group;  ///< "scene" of "scene run", or ""
  std::string name, help;
  std::vector<CompletedFlag> flags;
  bool is_group = false;
};

/// The first sentence of a help, which fits into a line of a menu.
std::string brief(const std::string& help);

/// Returns the script for "bash", "zsh" or "fish". `program` is its name.
std::string completion_script(const std::string& program, const std::string& shell,
                              const std::vector<CompletedCommand>& commands);

}  // namespace liecheck::properties
