#pragma once
// The budget table (properties/budgets.csv): operation x block x region -> rule, limit, reason.
// Tests and the report read the same table; the invariants do not know it.

#include <generators/bands.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

enum class Rule { forward, excess };

struct Budget {
  std::string operation, block;
  std::string region;  ///< to_pi, beyond_pi or any
  Rule rule;
  double limit;  ///< eps (forward) or eps kappa (excess)
  std::string reason;
};

const std::vector<Budget>& budgets();

/// The budget of a block in a band. Throws std::logic_error where the table has no line.
const Budget& budget_of(const std::string& operation, const std::string& block, Region region);

}  // namespace liecheck::properties
