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
  double largest = 0;        ///< eps or eps kappa, by the rule
  double budget = 0;         ///< the limit of the budget table
  std::uint64_t broken = 0;  ///< results without an error in eps: not finite, wrong branch, refused, ...
  std::uint64_t unresolved = 0;
  std::string worst;  ///< the ID of the case with the largest error, or of a broken one
};
using Needs = std::map<LimitKey, Need>;

/// By the names of the subjects. The scalars of a subject share a limit, which is in eps.
std::map<std::string, Needs> needs_of(const CampaignResult& campaign);

/// A subject's own limits, by line.
using OwnLimits = std::map<LimitKey, double>;
/// `allowance` times each need. A block whose error does not exceed the accuracy of the oracles keeps the
/// limit of the budget table.
OwnLimits limits_for(const Needs& needs);

/// The limits as the text of a subject's file: OPERATION, BLOCK, REGION, RULE = LIMIT, reason.
std::string text_of(const std::string& subject, const OwnLimits& limits, const std::string& reason);
/// Reads such a text. Throws std::runtime_error that names the line.
OwnLimits parse_limits(const std::string& text);

struct Accusation {
  LimitKey key;
  Need found;
  double limit = 0;
};
/// What exceeds its limit, or is broken or unresolved.
std::vector<Accusation> accusations(const Needs& found, const OwnLimits& limits);

}  // namespace liecheck::properties
