#pragma once
// Shrinking: replaces a failing input by a simpler one that still fails in the same way.
//
// Greedy passes try the law's own simpler inputs and simpler values of each group: zero or identity,
// rotations by pi/2 and pi, axis-aligned vectors, unit scale, powers of two, short decimals, few bits. A
// candidate is accepted if it is valid and still fails, with at least a tenth of the error, and not as a limits
// file expects. The search stops after a number of evaluations, after two seconds, or at stop_requested.

#include <campaign/series.hpp>
#include <functional>
#include <optional>
#include <vector>

namespace liecheck::properties {

/// The simplest input found that still fails in the same way.
struct Shrunk {
  CaseId id;
  std::vector<std::string> decimal;
  Judged judged;
  bool reproduced = true;  ///< false: the input did not fail again, or gave another result, and is not shrunk
};

/// Shrinks a failing case of one output: at most `evaluations` measurements and two seconds.
Shrunk shrink(const Series& series, const CaseId& id, int output, int evaluations);

/// The failure of an output among the measurements of a case; none if it passes.
std::optional<Judged> failure_of(const std::vector<Judged>& judged, int output);
/// The error or excess of a failure [eps], at most that of a result without a right digit.
double score_of(const Series& series, const Judged& failure);
/// The case with the numbers x in the place of the input at an address.
Shrunk case_with(const Series& series, const CaseId& address, const std::vector<double>& x,
                 const Judged& failure);

using Simpler = std::function<std::vector<std::vector<double>>(const std::vector<double>&)>;
/// Shrinks an input of the scalar that fails.
std::vector<double> shrink_input(std::vector<double> input, const std::vector<Field>& fields,
                                 const Scalar& scalar,
                                 const std::function<bool(const std::vector<double>&)>& still_fails,
                                 int evaluations, const Simpler& simpler = {});

}  // namespace liecheck::properties
