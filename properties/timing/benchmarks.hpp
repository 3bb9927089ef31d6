#pragma once
// Times operations with Google Benchmark; all repetitions of all rows run in random order. A repetition is
// discarded if another program used part of the execution units, because that slows some code by half and
// other code not at all. A reference loop, timed before and after each repetition, detects that.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

struct Timed {
  std::function<void()> pass;
  std::size_t calls = 1;             ///< calls of the timed operation in one pass
  std::vector<double> ns;            ///< time of a call in each repetition that was not discarded
  std::vector<double> instructions;  ///< per call; empty without a counter
};

struct Interleaving {
  /// Approximate duration of the whole measurement [s]; a repetition is at least one pass. On a busy machine,
  /// repetitions that have not started after 1.3 * `seconds` + 1 s are skipped. Since the order is random,
  /// about the same number is skipped in every row.
  double seconds = 1;
  std::size_t repetitions = 40;
  std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> progress = [](double) {};
};

/// Fills ns and instructions. Returns why instructions are not counted, or "".
std::string run_interleaved(std::vector<Timed>& all, const Interleaving& how);

}  // namespace liecheck::properties
