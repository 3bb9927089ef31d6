#pragma once
// The table of limits by operation, block and region of theta: properties/budgets/budgets.csv, whose columns
// docs/measuring.md defines. A subject that documents its own bounds has its own lines, which replace limits
// of the forward rule up to theta = pi. The tests and the report read the same table; the invariants do not.

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
  std::string subject = {};    ///< empty: every subject. With a subject, block `*` means every block
};

/// The lines in the order of the file.
const std::vector<Budget>& budget_lines();

/// The lines for a subject, with its own limits if it has any.
const std::vector<Budget>& budgets(const std::string& subject);

/// The budget of a block in a band, for a subject. Throws std::logic_error if the table has no line.
const Budget& budget_of(const std::string& subject, std::string_view operation, std::string_view block,
                        Region region);

}  // namespace liecheck::properties
