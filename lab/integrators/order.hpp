#pragma once
// The observed order of a method: how its error decreases with the step, as long as it is above rounding.

#include <optional>
#include <vector>

namespace liecheck::properties {

/// errors[k] is the error with step h / 2^k. The order is the mean over the last `wanted` halvings (or fewer)
/// whose errors are at least 100 times the floor and 1000 times `rounding`. A halving helps if its order is
/// above promised / 3. The floor exists if an errors[k] is below 1e-3, at least two halvings follow and none
/// of these helps. It is the smallest error from errors[k] on.
struct ObservedOrder {
  double order = 0;  ///< log2(first / last) / halvings; 0 without halvings
  int halvings = 0;
  std::size_t first = 0;      ///< index of the first error that is used
  std::vector<double> local;  ///< the order of each halving that is used
  std::optional<double> floor;
  bool settled = false;  ///< at least five halvings, each within 0.05 of their mean
};
ObservedOrder observe_order(const std::vector<double>& errors, int promised, int wanted = 5,
                            double rounding = 0);

}  // namespace liecheck::properties
