#pragma once
// The table of limits (properties/campaign/budgets.csv; docs/measuring.md defines its columns), by operation, block
// and region of theta. A subject that documents bounds of its own has lines of its own, for the forward rule up to
// theta = pi. Tests and the report read the same table; the invariants do not know it.

#include <generators/angle_bands.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties {

enum class Rule { forward, excess };

/// Where a limit comes from: docs/measuring.md, limits.
enum class Basis { hunted, derived, row, exact };

struct Budget {
  std::string operation, block;
  std::string region;  ///< to_pi, beyond_pi or any
  Rule rule;
  double limit;        ///< eps (forward) or eps kappa (excess)
  std::string reason;  ///< with the largest error found, where the limit was hunted
  Basis basis = Basis::derived;
  double value = 0;            ///< the largest error found, the bound derived, or that of the row
  std::string hard_case = {};  ///< hunted: the name of the case that shows it; row: operation/block
  bool fma = false;            ///< that case errs so much with fused multiply-adds only
  std::string subject = {};    ///< empty: every subject; else its own line, of the block `*`: of every block
};

/// The lines as they stand in the file.
const std::vector<Budget>& budget_lines();

/// The lines for a subject: its own limits where it has any.
const std::vector<Budget>& budgets(const std::string& subject);

/// The budget of a block in a band, for a subject. Throws std::logic_error where the table has no line.
const Budget& budget_of(const std::string& subject, std::string_view operation, std::string_view block,
                        Region region);

}  // namespace liecheck::properties
