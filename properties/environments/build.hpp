#pragma once
// Builds a subject, whose adapter is one source file, for an environment.

#include <environments/environments.hpp>
#include <map>
#include <stdexcept>
#include <string>

namespace liecheck::properties::environments {

/// The adapters of the build tree, as its file environments.json lists them.
struct Sources {
  struct Adapter {
    std::string source, flags, libraries;
    bool always = false;  ///< it is built anew each time: its libraries may have changed
  };
  std::map<std::string, Adapter> adapters;  ///< by the name of the subject
  std::string process;                      ///< a program of the process protocol, compiled with the adapter
  std::string compiler, flags;              ///< of the program itself

  std::string include;  ///< flags to find the interface of adapters

  /// Beside the program in its build tree. Throws std::runtime_error if it is not there.
  static Sources of_build_tree();
  /// Adds an adapter in C or C++ with the name of its file without the ending, which it returns. Throws
  /// std::invalid_argument if the file is not there or the name is taken.
  std::string add(const std::string& file, const std::string& own_flags, const std::string& own_libraries);
};

/// The compiler failed, in the words of its first error.
struct NotBuilt : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Compiles the adapter of `subject` for the environment in `folder`, unless that was done and nothing changed since.
/// Returns what --adapter takes. Throws NotBuilt.
std::string built(const Sources& sources, const std::string& subject, const Environment& e,
                  const std::string& folder);

/// The name of the program's own build among the environments.
inline constexpr const char* own_build = "program";

/// The next call of built() compiles it again: what it returned does not start.
void forget(const std::string& subject, const std::string& environment, const std::string& folder);

/// The same with the program's own compiler and flags, as a shared library.
std::string built_for_program(const Sources& sources, const std::string& subject, const std::string& folder);

}  // namespace liecheck::properties::environments
