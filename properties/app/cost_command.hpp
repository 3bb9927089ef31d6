#pragma once
// `liecheck cost`, which a report runs too.

#include <timing/cost.hpp>

namespace liecheck::properties {

/// Shows its progress, and stops at stop_requested. Throws std::invalid_argument naming what is not known, before
/// anything runs.
CostResult run_cost(CostOptions options);

}  // namespace liecheck::properties
