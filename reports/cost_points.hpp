#pragma once
// The points of error against time that a cost record holds, and what follows from them.

#include <reports/record.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

class Field;

/// Throws what is wrong with a record's `cost`.
void check_cost(const Field& cost);

/// One subject in one scalar on one operation, over all inputs.
struct CostPoint {
  std::string subject, scalar, operation;
  double error = 0;                    ///< the largest found, relative; infinite where a case has no result
  double latency = 0, throughput = 0;  ///< medians [ns]; 0 where not timed
  std::string dominated_latency, dominated_throughput;  ///< by what; empty: on the front
  std::string name() const { return subject + " in " + scalar; }
};

/// A row of the same code compiled otherwise, "liecheck@gcc-O2".
bool other_flags(const Json& row);

/// In the order of the record, without the row `call` and without other flags.
std::vector<CostPoint> cost_points(const Json& cost);

/// -log10 of the error, infinite where no input showed any; 0 where a case has no result.
double digits_of(const CostPoint& point);

/// From one point of the front of an operation to the next that errs half as much or less, by latency.
struct CostStep {
  const CostPoint *from, *to;
};
std::vector<CostStep> cost_steps(const std::vector<CostPoint>& points, const std::string& operation);

/// What a user who needs all of some operations would take.
struct CostCandidate {
  std::string subject, scalar;
  double error = 0;    ///< the largest of any of the operations
  double latency = 0;  ///< [ns] of one call of each
  std::string name() const { return subject + " in " + scalar; }
};
/// Those that offer every one of the operations.
std::vector<CostCandidate> cost_candidates(const std::vector<CostPoint>& points,
                                           const std::vector<std::string>& operations);

/// The fastest of those that err at most so much; null where there is none.
const CostCandidate* fastest_within(const std::vector<CostCandidate>& all, double error);
const CostCandidate* most_accurate(const std::vector<CostCandidate>& all, const std::string& scalar);

}  // namespace liecheck::reports
