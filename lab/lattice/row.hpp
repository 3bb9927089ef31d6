#pragma once
// A row of the lattice.

#include <lattice/lab.hpp>

namespace liecheck::properties {

/// One fault and its verdict.
struct LatticeRow {
  std::string subject, operation, block, change, family, trigger;
  FaultVerdict verdict;
  std::uint64_t judged = 0;  ///< cases of each law that it was given

  /// Subject, operation, block, change and trigger: no other fault of a run has the same.
  std::string key() const {
    return subject + '\t' + operation + '\t' + block + '\t' + change + '\t' + trigger;
  }
  /// Whether the fault is there to be found: it changed results by more than the limits grant.
  bool counts() const { return verdict.found != Found::granted && verdict.found != Found::unchanged; }
  bool found_within(std::uint64_t cases) const {
    return verdict.found == Found::found && verdict.cases <= cases;
  }
};

}  // namespace liecheck::properties
