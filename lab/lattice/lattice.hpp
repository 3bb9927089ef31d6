#pragma once
// The lattice of faults: bases x operations x triggers, each with a drawn perturbation. docs/laboratory.md
// explains the table and lists what is not found.

#include <lattice/row.hpp>
#include <map>
#include <optional>

namespace liecheck::properties {

struct LatticeOptions {
  std::vector<std::string> subjects = {"liecheck", "liecheck:fast", "look-alikes", "eigen", "textbook"};
  std::vector<std::string> operations;  ///< empty: all
  std::string scalar = "double";
  std::uint64_t seed = 42;
  std::uint64_t cases = 1000;  ///< of each law; more than 1000 only for rarer triggers, and a tenth on trees
  std::uint64_t faults = 0;    ///< a sample of this size; 0: all
  double least_share = 0;      ///< only faults whose trigger fires in this share of a law's cases
  std::optional<double> seconds;  ///< then the run stops, incomplete
  std::string resume;             ///< file to which each verdict is appended, and which is read first
};

struct LatticeResult {
  LatticeOptions options;
  std::vector<LatticeRow> rows;
  std::map<std::string, double> failures_of_base;  ///< share of its cases, by subject
  bool complete = false;

  /// Of the faults that count and whose trigger fires in 1 % of the cases of a law: all, and those found
  /// within 1000 cases.
  std::size_t common() const;
  std::size_t common_found() const;
  /// 99 % of them are found.
  bool passed() const { return 100 * common_found() >= 99 * common(); }
};

/// The subject with all look-alikes at once: a third correct implementation.
Subject look_alikes(const Scalar& scalar);

/// Runs the lattice. After stop_requested or after options.seconds it returns what was done. Throws
/// std::invalid_argument for an unknown subject or operation, and std::runtime_error, which names file and
/// line, for a bad file to resume.
LatticeResult run_lattice(const LatticeOptions& options, const Robot& robot);

}  // namespace liecheck::properties
