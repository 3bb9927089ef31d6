#pragma once
// The points (time, error) of a cost record, which of them are worth their time, and which to advise.

#include <reports/record.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// One subject in one scalar on one operation, over all inputs.
struct CostPoint {
  std::string subject, scalar, operation;
  double error = 0;                    ///< the largest found, relative; infinite where a case has no result
  double latency = 0, throughput = 0;  ///< medians [ns]; 0 where not timed
  std::string dominated_latency, dominated_throughput;  ///< by which row; empty: not dominated
  std::string name() const { return subject + " in " + scalar; }
};

/// Whether a row is the same code with other compiler flags, "liecheck@gcc-O2".
bool other_flags(const Json& row);

/// In the order of the record, without the row `call` and without other flags.
std::vector<CostPoint> cost_points(const Json& cost);

/// -log10 of the error; infinite where every result is exact, 0 where a case has no result.
double digits_of(const CostPoint& point);

/// A step between two undominated points of an operation, by latency: `to` is the next slower point that has at most
/// half the error of `from`.
struct CostStep {
  const CostPoint *from, *to;
};
std::vector<CostStep> cost_steps(const std::vector<CostPoint>& points, const std::string& operation);

/// A subject in one scalar that offers every operation of a list.
struct CostCandidate {
  std::string subject, scalar;
  double error = 0;    ///< the largest of any of the operations
  double latency = 0;  ///< [ns] of one call of each
  std::string name() const { return subject + " in " + scalar; }
};
std::vector<CostCandidate> cost_candidates(const std::vector<CostPoint>& points,
                                           const std::vector<std::string>& operations);

/// The fastest with at most this error; null where there is none.
const CostCandidate* fastest_within(const std::vector<CostCandidate>& all, double error);
const CostCandidate* most_accurate(const std::vector<CostCandidate>& all, const std::string& scalar);

}  // namespace liecheck::reports
