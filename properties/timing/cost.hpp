#pragma once
// Measures the time and the error of every operation of every subject on the same inputs.
//
// A time is processor time of the calling thread. It is measured in several processes, as a multiple of a
// reference loop (repetitions.hpp, benchmarks.hpp). Every subject of this program is called through a function pointer and
// returns through memory. The subject `call` is such a call alone; its time is not subtracted. An adapter has loops of its
// own, which are compiled with its library. For throughput, calls do not wait for one another. For latency, the address of
// the next input depends on the last result.

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <timing/bands.hpp>
#include <timing/repetitions.hpp>
#include <vector>

namespace liecheck::properties {

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
  Ratio throughput, latency;  ///< no processes if this set was not timed
  double instructions = 0;    ///< per call; 0 without a counter
  std::vector<BlockErrors> blocks;
  /// Of adapters: the latency of a call through the interface; of a program, of a call of nothing in its loop.
  Ratio interface = {};
  double cycles = 0;  ///< per call, as throughput; 0 without a counter
};

struct CostRow {
  std::string subject, version, scalar, operation;
  double eps = 0;             ///< of the scalar
  std::vector<CostSet> sets;  ///< the last one is "mixed"
  /// Of adapters: in which loops they are timed. "own types" or "numbers", loops of the adapter (liecheck_loops); "calls",
  /// through the interface; "one" or "one, many", loops of a program over single inputs, and all at once as throughput.
  std::string timed = {};
};

/// The largest error of any block over all inputs, as the block defines it (not in eps). It is infinite if a
/// result was not finite, on a wrong branch, refused or unresolved, and if a block has no error at all.
/// Defects of norm and orthogonality are ignored, because the next operation removes them.
double error_of(const CostRow& row);
/// The same over the inputs of one set.
double error_of(const CostRow& row, const CostSet& set);
/// The block with the error that error_of() returns.
std::string worst_block(const CostRow& row);

/// For each row, the index of the fastest row of the same operation that dominates it, or -1. A row dominates
/// another if it is faster (disjoint spreads) and its error is no larger, or if its error is smaller and
/// its median time no larger. Rows without an error, such as `call`, and liecheck@FLAGS are not compared.
/// `time` is &CostSet::throughput or &CostSet::latency.
std::vector<int> dominators(const std::vector<CostRow>& rows, Ratio CostSet::*time);

struct CostOptions {
  std::vector<std::string> operations, subjects, scalars;  ///< empty: all
  std::vector<std::string> adapters;  ///< as they were given; their subjects are registered
  std::uint64_t seed = 42;
  double seconds = 60;                          ///< approximate time for all timing
  std::size_t processes = 20, repetitions = 8;  ///< repetitions of each process
  std::size_t inputs_per_band = 256;
  bool curve = false;  ///< error over the angle, of textbook:CUTOFF, series:TERMS and liecheck
  bool flags = false;  ///< also time liecheck@FLAGS: in double, compiled with other flags (kernels.hpp)
  /// What times_in_this_process() returns in a new process of the same options; nothing if it was stopped.
  std::function<std::optional<std::string>(double seconds)> times_in_a_process;
  std::span<const CostBand> bands() const {
    return curve ? std::span<const CostBand>(curve_bands) : cost_bands;
  }
  std::atomic<bool>* stop = nullptr;  ///< once set, the run ends and returns what is done
  std::function<void(double share)> progress = [](double) {};
};

struct CostResult {
  CostOptions options;
  std::vector<CostRow> rows;
  bool complete = false;
  double elapsed = 0;  ///< s
  Machine machine;
  std::string no_counter;  ///< why instructions are not counted; empty if they are
};

/// Throws std::invalid_argument naming an operation, subject or scalar that is not known.
CostResult measure_cost(const CostOptions& options);
/// The repetitions in this process, for measure_cost().
std::string times_in_this_process(const CostOptions& options);

std::vector<std::string> cost_operations();
/// Those that one of the subjects offers in double.
std::vector<std::string> cost_operations_of(const std::vector<std::string>& subjects);
/// The scalars that are timed, from the fewest to the most digits.
std::vector<std::string> cost_scalars();
/// The scalars of linked_wide_rows (rows.hpp): of the laboratory.
std::vector<std::string>& linked_wide_scalars();

}  // namespace liecheck::properties
