#pragma once
// The budget table (properties/campaign/budgets.csv): operation x block x region -> rule, limit, reason; and for subjects that
// document other bounds of their own, block -> limit, reason in place of those up to half a turn.
// Tests and the report read the same table; the invariants do not know it.

#include <generators/angle_bands.hpp>
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

/// The lines for a subject: its own limits where it has any.
const std::vector<Budget>& budgets(const std::string& subject);

/// The budget of a block in a band, for a subject. Throws std::logic_error where the table has no line.
const Budget& budget_of(const std::string& subject, const std::string& operation, const std::string& block,
                        Region region);

}  // namespace liecheck::properties
