#pragma once
// Runs subjects until a law accuses them: `lab bugs` and `lab history` share this search.

#include <campaign/selection.hpp>
#include <limits>

namespace liecheck::properties {

struct FailureSearch {
  Selection selection;
  std::uint64_t seed = 42;
  std::uint64_t from = 0;                                           ///< index of the first case of each law
  std::uint64_t cases = std::numeric_limits<std::uint64_t>::max();  ///< of each law
  double seconds = std::numeric_limits<double>::infinity();
};

struct FirstFailure {
  std::string by;            ///< "law: operation, block", or "" if no case failed
  std::string not_measured;  ///< the first output without a verdict
  std::string replay;        ///< the address of the first failing case, and the flags that its replay needs
  std::string outcome;       ///< of that case, unless it has an error: "not finite", "wrong branch", ...
  double error = 0;          ///< of that case [eps]
  std::uint64_t cases = 0;   ///< until then, of all laws
  double seconds = 0;
  bool in_time = false;  ///< a case failed, or all cases were taken
  /// log10 of the error, or all digits of a double if the result has no error.
  double digits_lost() const;
};

/// Takes rounds of cases over all laws, and the hard cases after the first round, until a case fails, the cases
/// or the time are used up, or a signal asks to stop.
FirstFailure first_failure(const FailureSearch& search, const Robot& robot);

}  // namespace liecheck::properties
