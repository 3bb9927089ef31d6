#pragma once
// Flags that several commands have: seed, jobs, robot, and which subjects and properties.

#include <app/arguments.hpp>
#include <campaign/selection.hpp>
#include <optional>

namespace liecheck::properties {

/// Adds --seed; `help` says of what.
Flag add_seed(Arguments& arguments, std::uint64_t& seed, const std::string& help);

/// Adds -j, --jobs.
Flag add_jobs(Arguments& arguments, unsigned& jobs);
/// The number of threads; one for each core by default.
unsigned default_jobs();

/// --robot and --root.
struct RobotFlags {
  std::string file, root = "free-flyer";

  /// The flag --robot of `add`, which --root needs.
  Flag add(Arguments& arguments,
           const std::string& help = "robot for configuration properties; built in: mixed_joints");
  /// Reads the file, which may be a pipe: call it once.
  Robot read() const;
};

/// --subject, --property, --scalar and --json.
struct SelectionFlags {
  std::vector<std::string> subjects, properties, scalars;
  std::string json;

  void add(Arguments& arguments);
  /// liecheck in float and double unless something else is named; "all" is everything.
  Selection selection() const;
};

/// Which cases a campaign runs: --cases, --robot, --root, --seed, --for and --jobs.
struct CaseFlags {
  RobotFlags robot;
  std::uint64_t seed = 42, cases = 1000;
  std::optional<double> seconds;
  unsigned jobs = default_jobs();
  Flag jobs_flag;

  /// Returns all but --root.
  std::vector<Flag> add(Arguments& arguments);
};

}  // namespace liecheck::properties
