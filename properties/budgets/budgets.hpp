#pragma once
// The table of limits by operation, block and region of theta: properties/budgets/budgets.csv, whose columns
// docs/measuring.md defines. A subject that documents its own bounds has its own lines there, or in a limits
// file (limits.hpp). The tests and the report read the same table; the invariants do not.

#include <generators/angle_bands.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties {

enum class Rule { forward, excess };

/// The source of a limit: docs/measuring.md, section Limits.
enum class Basis { hunted, derived, row, exact };

struct Budget {
  std::string operation, block;
  std::string region;  ///< to_pi, beyond_pi or any
  Rule rule;
  double limit;        ///< eps (forward) or eps kappa (excess)
  std::string reason;  ///< includes the largest error found if the limit was hunted
  Basis basis = Basis::derived;
  double value = 0;            ///< the largest error found, the derived bound, or the other row's value
  std::string hard_case = {};  ///< hunted: name of the case; row: operation/block of the other row
  bool fma = false;            ///< the case has that error only with fused multiply-adds
  std::string subject = {};    ///< empty: every subject. With one, `*` means every operation or block
};

/// The lines in the order of the file.
const std::vector<Budget>& budget_lines();

/// The lines for a subject, with the own limits that budgets.csv has for it.
const std::vector<Budget>& budgets(const std::string& subject);

/// Whether an own limit replaces that of a line, in the region to_pi or beyond_pi: it names operation and
/// block or has `*`, has the region or `any`, and has the same rule.
bool replaces(const Budget& own, const Budget& line, const std::string& region);

/// The table with own limits. Of several that replace one limit, the one counts that names most: operation,
/// then block, then region.
std::vector<Budget> with_own_limits(const std::vector<Budget>& table, const std::vector<Budget>& own);

/// The budget of a block in a region. Throws std::logic_error if the table has no line.
const Budget& budget_in(const std::vector<Budget>& table, std::string_view operation, std::string_view block,
                        Region region);
const Budget& budget_of(const std::string& subject, std::string_view operation, std::string_view block,
                        Region region);

}  // namespace liecheck::properties
