#pragma once
// Regions of the angle, the digits that a row loses there, and which hard cases fail: each is decided here alone, so that
// every place of the page has the same numbers.

#include <array>
#include <reports/record.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::reports {

struct Region {
  std::string_view key, name, brief;
};
/// The angles below 10⁻⁸ and within 10⁻⁸ of π are extreme, except 0 and π: is_ordinary().
inline constexpr std::array<Region, 7> regions = {{{"zero", "θ < 10⁻⁸", "≈ 0"},
                                                   {"small", "θ 10⁻⁸…10⁻²", "small"},
                                                   {"moderate", "θ 10⁻²…π−1", "middle"},
                                                   {"near-pi", "π − θ 10⁻⁸…1", "< π"},
                                                   {"pi", "π − θ < 10⁻⁸", "≈ π"},
                                                   {"beyond", "θ > π", "> π"},
                                                   {"all", "without angle", "no θ"}}};

/// The place in `regions` of the band of a row.
std::size_t region_of(const Json& row);

/// Whether the band of a row has inputs that people meet: angles of 1e-8 to 2 pi that are no closer than 1e-8 to pi, 0, pi, and
/// inputs without an angle. Findings weigh these first.
bool is_ordinary(const Json& row);
/// Whether results are over the budget. What a limits file expects is wrong as well.
bool is_over_budget(const Json& row);

/// Larger is worse: failing rows first, then by outcome, then by the digits lost.
double severity(const Json& row);

/// "NaN or Inf" or "wrong branch" if a case of the row had that outcome; of a row that fails though no measured error is over
/// its budget, "refused" or "bad call"; else "".
std::string outcome_of(const Json& row);
/// N, B, R or !: the mark of such an outcome.
const char* mark_of(const std::string& outcome);

/// The digits of each subject in each scalar, and those that rows lose.
class Digits {
 public:
  explicit Digits(const Merged& merged);
  /// -log10 eps: 15.7 for double.
  double all(const Json& row) const;
  /// log10 of the judged error in eps, from 0 to all of them; all, if results are not finite or of a wrong branch.
  double lost(const Json& row) const;
  /// "7.4 of 15.7 digits lost", "all 15.7 digits lost", or the outcome.
  std::string words(const Json& row) const;

 private:
  std::map<std::pair<std::string, std::string>, double> eps_;  // by subject and scalar
};

/// The verdicts on a hard case, from the best to the worst.
inline constexpr std::array<std::string_view, 9> hard_verdicts = {"stable",       "refused",    "ill-posed",
                                                                  "unmeasured",   "unresolved", "inaccurate",
                                                                  "wrong branch", "not finite", "bad call"};

/// A hard case of one subject in one scalar. The worst of its laws counts.
struct HardCase {
  std::string name, of_class, subject, scalar;
  std::string operation{}, block{};  ///< those that determine the verdict
  std::size_t verdict = 0;           ///< place in hard_verdicts
  bool failed = false;
  bool ordinary = false;  ///< whether it fails at an ordinary angle
};
std::vector<HardCase> hard_cases(const Merged& merged);

/// "41 of 585 hard cases fail", of one subject or, for "", of all; "" if there are none.
std::string hard_words(const std::vector<HardCase>& cases, const std::string& subject = "");

/// Whether a result with this verdict would fail without a limit that permits it.
bool is_wrong_verdict(std::size_t verdict);

/// "938 stable, 76 refused, 188 ill-posed": the known difficult inputs, each in each scalar, by verdict.
std::string hard_counts(const std::vector<HardCase>& cases);

/// The parts of what the terminal says of a finding: its first line without the number, and each further line with its name.
struct FindingText {
  std::string title;
  std::vector<std::pair<std::string, std::string>> lines;  ///< "where", "perhaps", "example", "replay", ...
  std::string line(const std::string& name) const;
  /// Whether nothing but a refusal is told: what refuses loses no digits silently.
  bool is_refusal() const;
};
FindingText parts_of(const std::string& finding);

}  // namespace liecheck::reports
