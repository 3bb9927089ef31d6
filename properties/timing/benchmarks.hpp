#pragma once
// Times operations with Google Benchmark. All repetitions of all rows run in random order. A repetition is
// discarded if another program used part of the execution units, because this slows some code by half and
// other code not at all. A reference loop before and after each repetition detects the other program.

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
  /// Approximate duration of the whole measurement [s]. A repetition is at least one pass. Repetitions that
  /// have not started after 1.3 * `seconds` + 1 s (busy machine) are skipped. Because the order is random,
  /// each row loses about the same number of repetitions.
  double seconds = 1;
  std::size_t repetitions = 40;
  std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> progress = [](double) {};
};

/// Fills ns and instructions. Returns why instructions are not counted, or "".
std::string run_interleaved(std::vector<Timed>& all, const Interleaving& how);

}  // namespace liecheck::properties
