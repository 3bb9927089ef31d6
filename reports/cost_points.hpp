#pragma once
// The points (time, error) of a cost record, and the steps between undominated points.

#include <reports/record.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// One subject in one scalar on one operation, over all inputs, called one by one or many at once.
struct CostPoint {
  std::string subject, scalar, operation;
  double error = 0;        ///< largest relative error found; infinite if a case has no result
  double latency = 0;      ///< median time of an input [ns]; 0 if not timed
  double eps = 0;          ///< of the scalar
  bool dominated = false;  ///< whether another row of the operation dominates this one, by latency
  std::size_t batch = 1;   ///< inputs of one call
  std::string name() const { return subject + " in " + scalar + at_once(); }
  std::string at_once() const { return batch > 1 ? ", " + std::to_string(batch) + " at once" : ""; }
};

/// Whether a row is the same code with other compiler flags, "liecheck@gcc-O2".
bool other_flags(const Json& row);

/// Whether one call of the row computes many inputs when its throughput is measured.
bool takes_many(const Json& row);

/// The largest relative error of the inputs of a set, as `error` of a row is that of all: infinite if one has no error, and
/// -1 if none was measured.
double error_of_set(const Json& set, double eps);

/// The points in the order of the record, without the rows of `call` and of other compiler flags: over all inputs or, with
/// the name of a set, over those of one band of angles, where none counts as dominated. A row that takes many inputs at once
/// has a point more, or only this one.
std::vector<CostPoint> cost_points(const Json& cost, const std::string& set = "");

/// Correct digits, max(0, -log10 error): infinite if every result is exact, 0 if a case has no result.
double digits_of(const CostPoint& point);

/// The correct digits that are shown: at most those of an error of eps/2.
double shown_digits(const CostPoint& point);

/// A step between two undominated points of an operation, by latency: `to` is the next slower point that has
/// at most half the error of `from`.
struct CostStep {
  const CostPoint *from, *to;
};
std::vector<CostStep> cost_steps(const std::vector<CostPoint>& points, const std::string& operation);

}  // namespace liecheck::reports
