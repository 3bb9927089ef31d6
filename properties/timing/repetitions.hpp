#pragma once
// Repetitions of a timed operation, each beside a reference loop, and the ratio of their times.
//
// The time of an operation in nanoseconds changes with the clock rate of the processor. Its ratio to a loop that
// runs beside it changes less, but not nothing while another program uses the same core: that slows some code as much and
// other code not at all. So repetitions are short, a tenth of a millisecond, many, and each is kept or left out by its
// reference alone: of many, some run on a core that is free for so long. The ratio also differs between processes, because
// each places its code, stack and inputs at other addresses; so they are of several processes.

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
  double instructions = 0, cycles = 0;  ///< per call; 0 without a counter
};

/// How a machine ran during repetitions.
struct Machine {
  double reference_ns = 0;  ///< median of the reference loop in the undisturbed repetitions
  double disturbed = 0;     ///< share of the disturbed repetitions
  double spread = 0;        ///< of half of the times at most, relative to the time
  /// Whether another run finds the same times, within 15 %.
  bool steady() const { return spread <= 0.15; }
};

/// Removes the disturbed repetitions of each row, but keeps the eight fastest references of each. A repetition
/// is disturbed if its slower reference takes more than 1.1 times the 1 % quantile of all, because the processor
/// was slower or another program used part of it. The choice does not depend on the measured times.
Machine keep_undisturbed(std::vector<std::vector<Repetition>>& rows);

/// The repetitions of a run share the state of the machine, such as its clock rate and its neighbours. The reference
/// follows it to 3 %: so much did its time differ between two runs of one program, an hour apart, in which most
/// operations kept theirs.
inline constexpr double between_runs = 1.03;
/// The time of a call as a multiple of the reference: the median of all repetitions. The spread is [median / g, median g], and
/// the median of another run is in it with a probability of 99 %: g = f^1.86 between_runs, where f is the larger factor
/// between the median and an end of its 95 % confidence interval. The difference of two medians varies by sqrt(2) as much as
/// one of them, and 99 % of a normal distribution reach 2.58/1.96 times as far as 95 %.
struct Ratio {
  double median = 0, low = 0, high = 0;
  std::size_t processes = 0;
  double spread() const { return high / median - 1; }
};
Ratio ratio_of(const std::vector<Repetition>& row);
/// The median of `counts` of the repetitions; 0 without a counter.
double counted(const std::vector<Repetition>& row, double Repetition::*counts);

/// Repetitions as text, for another process.
std::string written(const std::vector<std::vector<Repetition>>& rows);
/// Appends the repetitions of a process to those of the same rows. Throws std::runtime_error if the text does not
/// have as many rows.
void append_written(std::vector<std::vector<Repetition>>& rows, const std::string& text, std::size_t process);

}  // namespace liecheck::properties
