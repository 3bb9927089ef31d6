#pragma once
// `liecheck cost`, which a report also runs.

#include <timing/cost.hpp>

namespace liecheck::properties {

/// Shows progress, and stops once stop_requested is set. Before anything runs, throws std::invalid_argument
/// that names an unknown operation, subject or scalar.
CostResult run_cost(CostOptions options);

}  // namespace liecheck::properties
