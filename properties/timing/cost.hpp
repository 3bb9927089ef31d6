#pragma once
// Measures the time and the error of every operation of every subject on the same inputs.
//
// A time is processor time of the calling thread, measured by Google Benchmark. The repetitions of all rows
// run in random order, so that disturbances of the machine affect all rows alike. Every subject is called
// through a function pointer and returns through memory. The subject `call` is such a call alone; its time is
// not subtracted. For throughput, calls do not wait for one another. For latency, the address of the next
// input depends on the last result.

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The median of repetitions and its 95 % confidence interval by order statistics [ns per call].
struct Spread {
  double median = 0, low = 0, high = 0;
  std::size_t repetitions = 0;
};
/// Sorts the samples. The interval of fewer than six is their range, whose confidence is below 95 %.
Spread spread_of(std::vector<double>& samples);

/// The errors of one block over one set of inputs, in eps of the row's scalar.
struct BlockErrors {
  std::string block;
  std::vector<double> errors;  ///< of each measured input
  std::uint64_t not_finite = 0, wrong_branch = 0, unresolved = 0, refused = 0;
  /// The smallest error that a share q of the measured inputs does not exceed; 0 if none was measured.
  double quantile(double q) const;
  double largest() const { return quantile(1); }
};

/// Adds the errors in `more` to the blocks of the same names in `all`.
void merge_blocks(std::vector<BlockErrors>& all, const std::vector<BlockErrors>& more);

struct CostSet {
  std::string set;  ///< a band of angles, or "mixed": all of them
  std::size_t inputs = 0;
  Spread throughput, latency;  ///< no repetitions if this set was not timed
  double instructions = 0;     ///< per call; 0 without a counter
  std::vector<BlockErrors> blocks;
};

struct CostRow {
  std::string subject, version, scalar, operation;
  double eps = 0;             ///< of the scalar
  std::vector<CostSet> sets;  ///< the last one is "mixed"
};

/// The largest error of any block over all inputs, as the block defines it (not in eps). It is infinite if a
/// result was not finite, on a wrong branch, refused or unresolved, and if a block has no error at all.
/// Defects of norm and orthogonality are ignored, because the next operation removes them.
double error_of(const CostRow& row);
/// The block with the error that error_of() returns.
std::string worst_block(const CostRow& row);

/// For each row, the index of the fastest row of the same operation that dominates it, or -1. A row dominates
/// another if it is faster (disjoint intervals) and its error is no larger, or if its error is smaller and
/// its median time no larger. Rows without an error, such as `call`, and liecheck@FLAGS are not compared.
/// `time` is &CostSet::throughput or &CostSet::latency.
std::vector<int> dominators(const std::vector<CostRow>& rows, Spread CostSet::*time);

struct CostOptions {
  std::vector<std::string> operations, subjects, scalars;  ///< empty: all
  std::uint64_t seed = 42;
  double seconds = 60;  ///< approximate time for all timing
  std::size_t repetitions = 40;
  std::size_t inputs_per_band = 256;
  bool flags = false;  ///< also time liecheck@FLAGS: in double, compiled with other flags (kernels.hpp)
  std::atomic<bool>* stop = nullptr;  ///< once set, the run ends and returns what is done
  std::function<void(double share)> progress = [](double) {};
};

struct CostResult {
  CostOptions options;
  std::vector<CostRow> rows;
  bool complete = false;
  double elapsed = 0;      ///< s
  std::string no_counter;  ///< why instructions are not counted; empty if they are
};

/// Throws std::invalid_argument naming an operation, subject or scalar that is not known.
CostResult measure_cost(const CostOptions& options);

std::vector<std::string> cost_operations();
std::vector<std::string> cost_subjects();
/// The scalars that are timed, from the fewest to the most digits.
const std::vector<std::string>& cost_scalars();

}  // namespace liecheck::properties
