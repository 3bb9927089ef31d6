#pragma once
// Flags that several commands have: seed, jobs, robot, subjects and properties.

#include <app/arguments.hpp>
#include <campaign/selection.hpp>
#include <optional>

namespace liecheck::properties {

/// Adds --seed with this help.
Flag add_seed(Arguments& arguments, std::uint64_t& seed, const std::string& help);

/// Adds -j, --jobs.
Flag add_jobs(Arguments& arguments, unsigned& jobs);
/// The default number of threads: one for each core.
unsigned default_jobs();

/// --robot and --root.
struct RobotFlags {
  std::string file, root = "free-flyer";

  /// Adds both flags. Returns --robot.
  Flag add(Arguments& arguments,
           const std::string& help = "robot of the laws that need one; default: the built-in mixed_joints");
  /// Reads the file, which may be a pipe: call it once.
  Robot read() const;
};

/// --subject, --property, --scalar and --json.
struct SelectionFlags {
  std::vector<std::string> subjects, properties, scalars;
  std::string json;

  void add(Arguments& arguments);
  /// By default liecheck in float and double; the subject "all" means all subjects.
  Selection selection() const;
};

/// Which cases a campaign runs: --cases, --robot, --root, --seed, --for and --jobs.
struct CaseFlags {
  RobotFlags robot;
  std::uint64_t seed = 42, cases = 1000;
  std::optional<double> seconds;
  unsigned jobs = default_jobs();
  Flag jobs_flag;

  /// Adds the flags. Returns all except --root.
  std::vector<Flag> add(Arguments& arguments);
};

}  // namespace liecheck::properties
