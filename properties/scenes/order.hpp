#pragma once
// The order that a method shows: how its error falls when the step is halved, above the floor of roundoff.

#include <optional>
#include <vector>

namespace liecheck::properties {

/// errors[k]: with steps h / 2^k. The floor: the smallest error from where halving no longer helps (less than a third of
/// what the order promises, twice, below 1e-3); none where the errors still fall at the end. The order is the slope over the last
/// `wanted` halvings whose errors all stand 100 times above the floor and 1000 times above
/// `rounding`, or over as many as there are.
struct ObservedOrder {
  double order = 0;  ///< log2(first / last) / halvings; 0 where there is no halving
  int halvings = 0;
  std::size_t first = 0;      ///< index of the first error of those
  std::vector<double> local;  ///< of each of those halvings
  std::optional<double> floor;
  bool settled = false;  ///< five or more halvings, none further than 0.05 from their mean
};
ObservedOrder observe_order(const std::vector<double>& errors, int promised, int wanted = 5,
                            double rounding = 0);

}  // namespace liecheck::properties
