#pragma once
// A command of the program: its flags on the command line, and what runs it.

#include <functional>

namespace CLI {
class App;
}

namespace liecheck::properties {

/// Exit codes of the program.
enum Exit { within_budget = 0, property_failed = 1, bad_input = 2, incomplete = 3 };

struct Command {
  const CLI::App* arguments;  ///< knows whether the command was given
  std::function<int()> run;   ///< returns the exit code
};

}  // namespace liecheck::properties
