#pragma once
// What got worse between two rows of the same cell, and which of it is worse in the subject's own terms.

#include <campaign/tally.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// What judges a cell.
struct RowTerms {
  double limit = 0;  ///< eps or eps kappa, by the rule; 0 if this program does not know it
  Rule rule = Rule::forward;
  double eps = 0;  ///< of the scalar
  bool expected =
      false;  ///< the limits file expects failures here: nothing is worse in the subject's own terms
  bool failed_before = false;  ///< the block fails in some band of the row that `to` is compared with
};

/// Kinds of differences, in the order of their importance; only what follows `by_little` fails a comparison.
enum class Gravity { by_little, grown, cliff, crossed, broken };

struct Difference {
  std::string what;
  Gravity gravity = Gravity::by_little;
  double size = 0;  ///< among those of one gravity: the error over the limit, or the share of cases
};

/// What is worse in `to` than in `from`. With the same inputs, every difference comes from the program; otherwise it is
/// only what chance would cause less than once in 1e9 (sampling.hpp). `to_is_earlier`: in the text, the earlier row
/// stands first in either case.
std::vector<Difference> worse_rows(const Row& from, const Row& to, const RowTerms& terms, bool same_inputs,
                                   bool to_is_earlier);

/// "what: BEFORE → AFTER" of two sides, of which `to` may be the earlier one.
std::string before_after(const char* what, const std::string& from, const std::string& to,
                         bool to_is_earlier);

}  // namespace liecheck::properties
