#pragma once
// `liecheck sweep`, which a report also runs.

#include <coefficients/sweep.hpp>

namespace liecheck::properties {

/// Sweeps the named coefficients, or all if none is named. Shows progress, and stops once stop_requested is
/// set. Before anything runs, throws std::invalid_argument that names an unknown coefficient.
SweepResult run_sweep(const std::vector<std::string>& coefficients, unsigned jobs, std::uint32_t stride = 1);

}  // namespace liecheck::properties
