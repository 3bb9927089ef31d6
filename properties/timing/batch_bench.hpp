#pragma once
// Times of batches beside the loop over single calls, and beside a copy of memory.

#include <functional>
#include <liecheck/batch/instructions.hpp>
#include <string>
#include <utility>
#include <vector>

namespace liecheck::properties {

/// The median over the rounds [ns per column], and half the distance of the quartiles relative to it.
struct BatchTime {
  double median = 0, spread = 0;
};

struct BatchRow {
  std::string operation, scalar;
  long columns = 0;
  BatchTime loop, copy;
  std::vector<BatchTime> batch;  ///< for each of BatchBenchOptions::instructions
};

struct BatchBenchOptions {
  std::vector<long> columns;                      ///< lengths of the batches
  std::vector<batch::Instructions> instructions;  ///< supported
  std::vector<std::string> operations;            ///< empty: all
  int threads = 1, rounds = 9;
  double seconds = 0.003;  ///< duration of one measurement, at least
};

/// The sets of instructions that this processor has, by name.
std::vector<std::pair<std::string, batch::Instructions>> supportedInstructions();

/// The names of the operations.
std::vector<std::string> batch_operations();

/// Calls done(row) for each operation, scalar and number of columns; for trees up to 100,000 columns, since
/// the poses of a million quadrupeds would take gigabytes. In each round, the loop, the copy and the batches
/// take turns. The loop calls the operation on one pose after another, which are stored as a user stores
/// them. The copy moves as many bytes as the operation: it reads half of them and writes half. Polls
/// stop_requested.
void time_batches(const BatchBenchOptions& options, const std::function<void(const BatchRow&)>& done);

}  // namespace liecheck::properties
