#pragma once
// Campaigns without output.

#include <campaign/campaign.hpp>
#include <campaign/robots.hpp>

namespace liecheck::properties {

inline CampaignOptions quiet(Selection selection, std::uint64_t cases, unsigned jobs = 1) {
  CampaignOptions options;
  options.selection = std::move(selection);
  options.cases = cases, options.jobs = jobs, options.quiet = true;
  return options;
}
inline CampaignResult run_quietly(Selection selection, std::uint64_t cases, unsigned jobs = 1,
                                  const Robot& robot = built_in_robot()) {
  return run_campaign(quiet(std::move(selection), cases, jobs), robot);
}

}  // namespace liecheck::properties
