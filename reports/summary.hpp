#pragma once
// A summary of the rows of a report: the verdict, the standing of each subject, the worst rows.

#include <cstdint>
#include <reports/record.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// One subject in one scalar.
struct Standing {
  std::string subject, version, scalar;
  double eps = 0;
  int passed = 0, failed = 0, ill_posed = 0, empty = 0;  ///< number of bands, by status
  int expected = 0;                                      ///< number that fail as a limits file expects
  int open = 0;                                          ///< number that are unresolved or unmeasured
  int not_measured = 0;                                  ///< number of such entries in the records
  std::uint64_t not_finite = 0, wrong_branch = 0;        ///< number of cases
  const Json* worst = nullptr;                           ///< its worst judged row; null if no row was judged
  Distinct<std::string> not_offered;
};

/// The figure that the budget of a row limits: max_eps under rule "forward", max_excess under "excess".
double judged(const Json& row);

/// "fail" if any band failed; otherwise "incomplete" if any band is unresolved or anything was not measured;
/// otherwise "pass", or "no verdict" if no band was judged.
std::string word(const Standing& standing);

/// Whether row a is worse than row b. A row with a result that is not finite or on a wrong branch is worse
/// than any other row. Otherwise the row with the larger ratio of error to budget is worse.
bool worse(const Json& a, const Json& b);

/// "fail" if any record or measurement failed; otherwise "incomplete" if any of them is incomplete, if there is no row, if a
/// hard case has no verdict, or if a subject is incomplete or has none; otherwise "pass".
std::string verdict(const Merged& merged);

/// Subjects in the order of the records.
std::vector<Standing> standings(const Merged& merged);

/// The worst row of each subject, scalar, operation and region of the angle, among those with a worst case: the one that
/// fails, then by outcome, then by the digits lost. In the order of the rows.
std::vector<std::size_t> worst_rows(const Json& results);

/// At most `limit` failing rows, worst first, and at most one for each subject, scalar, property, operation
/// and block.
std::vector<const Json*> worst_offenders(const Merged& merged, std::size_t limit);

}  // namespace liecheck::reports
