#pragma once
// Repetitions of a timed operation, each beside a reference loop, and the ratio of their times.
//
// The time of an operation in nanoseconds changes with the clock rate of the processor. Its ratio to a loop that
// runs beside it changes less. But the ratio also differs between processes, because each places its code, stack
// and inputs at other addresses. So a ratio is measured in several processes, which also show its spread.

#include <cstddef>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A median and its 95 % confidence interval by order statistics.
struct Spread {
  double median = 0, low = 0, high = 0;
  std::size_t repetitions = 0;
};
/// The interval of fewer than six samples is their range, whose confidence is below 95 %.
Spread spread_of(std::vector<double> samples);

/// One repetition in a process.
struct Repetition {
  std::size_t process = 0;
  double ns = 0;            ///< of a call of the operation
  double reference_ns = 0;  ///< of a pass of the reference loop: the mean of before and after the repetition
  double slowest_ns = 0;    ///< the slower one of the two
  double instructions = 0;  ///< per call; 0 without a counter
};

/// How a machine ran during repetitions.
struct Machine {
  double reference_ns = 0;  ///< median of the reference loop in the undisturbed repetitions
  double disturbed = 0;     ///< share of the disturbed repetitions
  /// Whether the machine kept its speed. Otherwise another run may find other ratios.
  bool steady() const { return disturbed <= 0.25; }
};

/// Removes the disturbed repetitions of each row, but keeps the eight fastest references of each. A repetition
/// is disturbed if its slower reference takes more than 1.1 times the 1 % quantile of all, because the processor
/// was slower or another program used part of it. The choice does not depend on the measured times.
Machine keep_undisturbed(std::vector<std::vector<Repetition>>& rows);

/// The processes of a run share the state of the machine, such as its clock rate and its neighbours. The reference
/// follows it to 3 %: so much did its time differ between two runs of one program, an hour apart, in which most
/// operations kept theirs.
inline constexpr double between_runs = 1.03;
/// The time of a call as a multiple of the reference: the median of the processes, each with the median of its
/// repetitions. The spread is [median / g, median g], g = f^2 between_runs, where f is the largest factor between
/// the median and a process. The range of 20 processes alone would hold the median of another run with a
/// probability of 99.98 % if processes of two runs differ as processes of one do, but a run has thousands of
/// ratios, and some of its processes have no undisturbed repetition.
struct Ratio {
  double median = 0, low = 0, high = 0;
  std::size_t processes = 0;
};
Ratio ratio_of(const std::vector<Repetition>& row);
/// The median of the counts; 0 without a counter.
double instructions_of(const std::vector<Repetition>& row);

/// Repetitions as text, for another process.
std::string written(const std::vector<std::vector<Repetition>>& rows);
/// Appends the repetitions of a process to those of the same rows. Throws std::runtime_error if the text does not
/// have as many rows.
void append_written(std::vector<std::vector<Repetition>>& rows, const std::string& text, std::size_t process);

}  // namespace liecheck::properties
