#pragma once
// The library in scalars wider than double, on double's inputs: what further digits cost.

#include <timing/rows.hpp>

namespace liecheck::properties {

/// Rows of double-double (QD, where it is installed), float128 and of 50 and 100 digits (MPFR), where the options want them.
void add_tiers(CostPlan& plan, const std::vector<std::unique_ptr<Property<double>>>& laws);

}  // namespace liecheck::properties
