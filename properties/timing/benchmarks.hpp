#pragma once
// Google Benchmark, all repetitions of all rows in random order. Those during which another program had a part of the
// execution units, as a loop before and after each tells, do not count: they slow some code by half and some not at
// all.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

struct Timed {
  std::function<void()> pass;
  std::size_t calls = 1;             ///< of what is timed, in one pass
  std::vector<double> ns;            ///< per call, one for each repetition that counts
  std::vector<double> instructions;  ///< per call; empty without a counter
};

struct Interleaving {
  /// Of all of it, about; a repetition is at least one pass. Repetitions that are left 1 s after 1.3 times as long, on a
  /// busy machine, are not run: chance leaves out as many of every row.
  double seconds = 1;
  std::size_t repetitions = 40;
  std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> progress = [](double) {};
};

/// Fills ns and instructions. Returns why instructions are not counted; empty where they are.
std::string run_interleaved(std::vector<Timed>& all, const Interleaving& how);

}  // namespace liecheck::properties
