#pragma once
// Times operations in this process. All repetitions of all rows run in random order, so that disturbances of
// the machine affect all rows alike. Each repetition is between two runs of a reference loop.

#include <atomic>
#include <functional>
#include <string>
#include <timing/repetitions.hpp>
#include <vector>

namespace liecheck::properties {

/// What is timed: `pass` here, or passes that are timed elsewhere; nothing if both are null.
struct Timed {
  std::function<void()> pass;
  std::size_t calls = 1;  ///< calls of the timed operation in one pass
  std::function<double(std::size_t passes)> elsewhere = nullptr;  ///< processor time of the passes [ns]
};

struct Interleaving {
  /// Approximate duration of the whole measurement [s]. A repetition is at least one pass. Repetitions that
  /// have not started after 1.3 * `seconds` + 1 s (busy machine) are left out. Because the order is random,
  /// each row loses about the same number of repetitions.
  double seconds = 1;
  std::size_t repetitions = 40;
  std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> progress = [](double) {};
};

/// The repetitions of each row that were run.
std::vector<std::vector<Repetition>> run_interleaved(const std::vector<Timed>& all, const Interleaving& how);

/// Why instructions are not counted; "" if they are.
std::string no_counter();

}  // namespace liecheck::properties
