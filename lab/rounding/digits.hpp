#pragma once
// The digits that random rounding estimates beside those that the oracles find.

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

struct DigitsOptions {
  std::vector<std::string> subjects, operations;  ///< empty: those that run in Stochastic; every one
  std::size_t inputs = 64;                        ///< of each band
  std::size_t samples = 16;                       ///< runs with random rounding for each input
  std::uint64_t seed = 42;
  const std::atomic<bool>* stop = nullptr;
};

/// One part of one operation's result, over the inputs of a band. Each number of digits is -log10 of the root mean
/// square, over inputs, of |y - reference| / |reference|.
struct DigitsRow {
  std::string subject, operation, part, band;
  std::size_t inputs = 0;
  double actual = 0;     ///< of the subject in double; the reference is the oracle's result
  double estimated = 0;  ///< of the samples; the reference is their mean
  double without_exemption =
      0;  ///< the same where the steps of error-free transformations round at random too; NaN if
          ///< the subject was called in the four rounding modes instead
  /// The estimate promises a digit more than there is.
  bool deceives() const { return estimated - actual > 1; }
};

/// A line of source whose roundings move a result.
struct RoundingLine {
  std::string place;     ///< file and line, or an address
  std::string function;  ///< that it is in
  double share = 0;      ///< of the variance that all lines cause, if each rounds at random alone
};

/// The subjects whose code is compiled for Stochastic. Any other subject is called in the four rounding modes.
std::vector<std::string> stochastic_subjects();

/// Throws std::invalid_argument that names an unknown subject or operation.
void check_digits(const DigitsOptions& options);

/// Calls row() for each row as soon as it is known. Throws std::invalid_argument that names an unknown subject or
/// operation.
void measure_digits(const DigitsOptions& options, const std::function<void(const DigitsRow&)>& row);

/// The lines whose roundings move the operation's result most, over the inputs of a band, largest share first.
/// options.subjects and options.operations must name one each, and the subject be one of stochastic_subjects().
std::vector<RoundingLine> rounding_lines(const DigitsOptions& options, const std::string& band);

/// The names of the bands of operations on poses.
std::vector<std::string> digits_bands();

}  // namespace liecheck::properties
