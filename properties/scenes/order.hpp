#pragma once
// The observed order of a method: how its error falls when the step is halved, above rounding errors.

#include <optional>
#include <vector>

namespace liecheck::properties {

/// errors[k] is the error with step h / 2^k. The order is the mean over the last `wanted` halvings (or fewer)
/// whose errors are at least 100 times the floor and 1000 times `rounding`. A halving helps if its order is
/// above promised / 3. The floor is the smallest error from errors[k] on, where errors[k] is below 1e-3 and
/// none of the later halvings, at least two, helps. There is no floor if the errors still fall at the end.
struct ObservedOrder {
  double order = 0;  ///< log2(first / last) / halvings; 0 without halvings
  int halvings = 0;
  std::size_t first = 0;      ///< index of the first error that counts
  std::vector<double> local;  ///< the order of each halving that counts
  std::optional<double> floor;
  bool settled = false;  ///< at least five halvings, each within 0.05 of their mean
};
ObservedOrder observe_order(const std::vector<double>& errors, int promised, int wanted = 5,
                            double rounding = 0);

}  // namespace liecheck::properties
