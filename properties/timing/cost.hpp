#pragma once
// What accuracy costs in time: every operation of every subject timed on inputs on which its error is measured as
// well.
//
// Time is processor time of the calling thread, by Google Benchmark, all rows' repetitions in random order so that
// what the machine does meanwhile falls on all of them alike. Every subject is called through the same pointer to a
// function and returns through memory; what that alone takes is a row of its own, the subject `call`, and is not
// subtracted. Throughput: calls that do not wait for one another. Latency: the address of the next input is formed
// from three numbers of the last result, so that each call waits for the one before.

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace liecheck::properties {

/// Median of repetitions and the interval that holds the true one with 95 % (order statistics, no distribution
/// assumed) [ns per call].
struct Spread {
  double median = 0, low = 0, high = 0;
  std::size_t repetitions = 0;
};
/// Sorts them. Fewer than six repetitions give their range, which holds the true median with less.
Spread spread_of(std::vector<double>& samples);

/// The errors of one block over one set of inputs, in eps of the row's scalar. Maxima are lower bounds.
struct BlockErrors {
  std::string block;
  std::vector<double> errors;  ///< of what was measured
  std::uint64_t not_finite = 0, wrong_branch = 0, unresolved = 0, refused = 0;
  /// The smallest error that a share q of the measured inputs do not exceed. 0 where none was measured.
  double quantile(double q) const;
  double largest() const { return quantile(1); }
};

/// Adds the errors of blocks of the same names.
void merge_blocks(std::vector<BlockErrors>& all, const std::vector<BlockErrors>& more);

struct CostSet {
  std::string set;  ///< a band of angles, or "mixed": all of them
  std::size_t inputs = 0;
  Spread throughput, latency;  ///< no repetitions where this set was not timed
  double instructions = 0;     ///< per call; 0 where there is no counter
  std::vector<BlockErrors> blocks;
};

struct CostRow {
  std::string subject, version, scalar, operation;
  double eps = 0;             ///< of the scalar
  std::vector<CostSet> sets;  ///< the last one is "mixed"
};

struct CostOptions {
  std::vector<std::string> operations, subjects, scalars;  ///< none: all
  std::uint64_t seed = 42;
  double seconds = 60;  ///< about how long all timing takes
  std::size_t repetitions = 40;
  std::size_t inputs_per_band = 256;
  bool flags = false;  ///< also liecheck in double compiled with other flags (kernels.hpp), "liecheck@..."
  std::atomic<bool>* stop = nullptr;  ///< set it, and what is done is kept
  std::function<void(double share)> progress = [](double) {};
};

struct CostResult {
  CostOptions options;
  std::vector<CostRow> rows;
  bool complete = false;
  double elapsed = 0;      ///< s
  std::string no_counter;  ///< why instructions are not counted; empty where they are
};

/// Throws std::invalid_argument naming an operation, subject or scalar that is not known.
CostResult measure_cost(const CostOptions& options);

std::vector<std::string> cost_operations();
std::vector<std::string> cost_subjects();
/// The scalars that are timed, from the fewest to the most digits.
const std::vector<std::string>& cost_scalars();

}  // namespace liecheck::properties
