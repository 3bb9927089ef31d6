#pragma once
// The order that a method shows: how its error falls when the step is halved, above the floor of roundoff.

#include <optional>
#include <vector>

namespace liecheck::properties {

/// errors[k]: with steps h / 2^k. The floor: the smallest error from where halving no longer helps (less than a third of
/// what the order promises, twice); none where the errors still fall at the end. The order is the slope over the last
/// `wanted` halvings whose errors all stand 100 times above the floor, or over as many as there are.
struct ObservedOrder {
  double order = 0;  ///< log2(first / last) / halvings; 0 where there is no halving
  int halvings = 0;
  std::size_t first = 0;      ///< index of the first error of those
  std::vector<double> local;  ///< of each of those halvings
  std::optional<double> floor;
};
ObservedOrder observe_order(const std::vector<double>& errors, int promised, int wanted = 5);

}  // namespace liecheck::properties
