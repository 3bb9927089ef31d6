#pragma once
// What limits a subject needs: the largest error of each operation, block and region that a campaign
// measured. A limit of `allowance` times this maximum is what the subject may promise; another campaign, with
// another seed and more cases, shows whether the subject keeps it.

#include <campaign/campaign.hpp>
#include <compare>

namespace liecheck::properties {

/// A limit is this many times the largest error measured. The factor allows for what the measurement missed.
inline constexpr double allowance = 4;

/// A line of a table of limits: its region is that of the budget table, so it may be "any".
struct LimitKey {
  std::string operation, block, region, rule;
  auto operator<=>(const LimitKey&) const = default;
};

struct Need {
  double largest = 0;            ///< eps or eps kappa, by the rule
  double limit = 0;              ///< what judged the subject
  std::uint64_t broken = 0;      ///< results without an error in eps: not finite, wrong branch, refused, ...
  std::uint64_t unmeasured = 0;  ///< or unresolved
  std::string worst;             ///< the ID of the case with the largest error, or of a broken one
  bool accused() const { return broken || unmeasured || !(largest <= limit); }
};
using Needs = std::map<LimitKey, Need>;

/// By the names of the subjects. The scalars of a subject share a limit, which is in eps. An excess below
/// half the limit is an upper bound, unless the campaign computed every condition number.
std::map<std::string, Needs> needs_of(const CampaignResult& campaign);

/// Lines of a limits file with `factor` times each need. A block whose error does not exceed the accuracy of
/// the oracles has none.
std::string limit_lines(const Needs& needs, double factor, const std::string& reason);
/// The text of a limits file with `allowance` times each need.
std::string limits_text(const std::string& subject, const Needs& needs, const std::string& reason);

}  // namespace liecheck::properties
