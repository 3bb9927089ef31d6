#pragma once
// The environments of the command `environments`: how a subject is built, or in which mode it is called.

#include <optional>
#include <string>
#include <support/float_environment.hpp>
#include <vector>

namespace liecheck::properties::environments {

/// What is expected of a subject that is stable in the program's own build.
enum class Promise {
  same,      ///< stable or refused, as there
  fourfold,  ///< errors of at most four times the limits
  flushed,   ///< as there, if no number of the input is below min_normal/eps
  none       ///< -ffast-math: shown, not judged
};

/// Stands for the folder of the builds in Environment::link.
inline constexpr const char* builds_folder = "{builds}";

struct Environment {
  std::string name, what;
  Promise promise = Promise::same;
  std::optional<FloatMode> mode = {};  ///< of calls in this process; otherwise the subject is built anew
  std::string compiler = {}, flags = {},
              link = {};     ///< builds_folder in `link` stands for the folder of the builds
  std::string prepare = {};  ///< a shell command that runs first, in the folder of the builds
  std::string run = {};      ///< what runs the executable, or "" for this machine
  std::string ending = {};   ///< of the executable's name

  /// Something that must be there: a program in PATH, a file, or a flag of the processor.
  struct Need {
    enum Kind { program, file, processor } kind;
    std::string what, get;
  };
  std::vector<Need> needs = {};
};

/// All of them, in the order of the matrix.
const std::vector<Environment>& all();

/// What is missing for the environment and how to get it, or "".
std::string missing(const Environment& e);

}  // namespace liecheck::properties::environments
