#pragma once
// `liecheck sweep`, which a report runs too.

#include <coefficients/sweep.hpp>

namespace liecheck::properties {

/// Every coefficient where none is named. Shows its progress, and stops at stop_requested. Throws
/// std::invalid_argument naming a coefficient that is not known, before anything runs.
SweepResult run_sweep(const std::vector<std::string>& coefficients, unsigned jobs, std::uint32_t stride = 1);

}  // namespace liecheck::properties
