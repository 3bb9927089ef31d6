#pragma once
// A badge: the verdict of a campaign and its hard cases on each subject, as a small picture for a README.

#include <campaign/campaign.hpp>
#include <hard_cases/hard_cases.hpp>
#include <map>

namespace liecheck::properties {

/// "pass", "fail" or "incomplete" by subject. A subject fails if a case, a cliff or a hard case of it fails that its
/// limits file does not expect, or if the oracles disagree. It is incomplete if it does not fail and something that
/// must be measured was not, or the campaign was interrupted.
std::map<std::string, std::string> verdicts_by_subject(const CampaignResult& campaign,
                                                       const std::vector<HardRow>& hard_cases);

/// An SVG 20 px high: "liecheck", then each subject with its verdict.
std::string badge_of(const std::map<std::string, std::string>& verdicts);

}  // namespace liecheck::properties
