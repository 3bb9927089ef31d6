#pragma once
// What differs between two stored campaigns: docs/measuring.md, section Two campaigns.

#include <array>
#include <store/stored_campaign.hpp>

namespace liecheck::properties {

/// A cell that differs.
struct Change {
  std::array<std::string, 6>
      name;  ///< subject, scalar, property, operation, block, band or "hard case NAME"; all but the first may be ""
  std::string what;           ///< each difference as "failed: BEFORE → AFTER", the most important first
  std::string worst_case;     ///< of the cell in the later campaign: a case ID, or ""
  std::string place() const;  ///< "exp6, translation, theta 1e-8..1e-7"
  std::string text() const;
};

/// Each list begins with what is most important.
struct Comparison {
  std::vector<Change> worse, better;  ///< in the subject's own terms
  std::vector<Change> other;          ///< all else, in both directions
  /// What only one of the campaigns has: operations; "float" or "mylib in float" if all of a subject's are of it.
  std::vector<std::string> lost, gained;
  std::vector<std::string> unjudged;  ///< of `after`: sentences on operations that neither judges
};

/// Compares `after` with `before`. Throws std::invalid_argument if a subject was judged by different limits.
///
/// Worse in the subject's own terms is a failure where there was none (but not beside an earlier one if its error did not
/// grow), a new result that is NaN, on a wrong branch or none at all, a cliff that is new, and an error that grew by more
/// than two and thereby used up more than a quarter of its limit. Failures that the limits file expects are not. So are an
/// operation that the probe of an adapter finds in another convention or wrong, and a hard case that fails, if they were
/// not before. Where fewer cases lack an error, as NaN does, the errors of the others are not compared.
///
/// If the inputs are the same, every difference comes from the program. If they differ, a maximum depends on the sample,
/// and so does a failure that occurs once: then only what chance would cause less than once in 1e9 differs
/// (sampling.hpp), in one band or in all bands together.
///
/// With `strict`, each difference is worse or better. (With the same inputs: another count of failing, unresolved,
/// ill-posed or unmeasured cases, and a maximum that differs by more than 10 % and by more than 0.5 eps.)
Comparison compared(const StoredCampaign& before, const StoredCampaign& after, bool strict = false);

/// The number of cells with a verdict in both campaigns. If it is 0, nothing was compared.
std::size_t cells_in_both(const StoredCampaign& a, const StoredCampaign& b);

}  // namespace liecheck::properties
