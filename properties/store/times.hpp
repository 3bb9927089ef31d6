#pragma once
// How the times of two records of `liecheck cost --json` differ, for `liecheck compare --cost`.

#include <string>
#include <vector>

namespace liecheck::properties {

/// The latency of an operation on the inputs of one band, which changed by more than its spread from run to run. Times are
/// multiples of a reference loop that is timed beside the calls, so that two machines, or a busy one, compare.
struct TimeChange {
  std::string subject, scalar, operation, band;
  double before_ns, after_ns;
  double factor;  ///< the time after over the time before
};

struct TimeChanges {
  std::size_t compared = 0;      ///< operations with times in both records
  std::vector<TimeChange> some;  ///< slower ones first; of each operation the band that changed most
};

/// Throws std::invalid_argument if a file is no such record.
TimeChanges time_changes(const std::string& before, const std::string& after);

/// Lines for a terminal, and a table in Markdown.
std::string text_of(const TimeChanges& times);
std::string in_markdown(const TimeChanges& times);

}  // namespace liecheck::properties
