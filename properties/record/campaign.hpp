#pragma once
// The JSON record of a campaign.

#include <campaign/campaign.hpp>
#include <nlohmann/json_fwd.hpp>
#include <store/counterexamples.hpp>

namespace liecheck::properties {

/// The record that `--json` writes and the report reads; documented in the README. `environment` is JSON of the run
/// where that was another one; empty: this machine and program.
nlohmann::json record_of(const CampaignResult& result, const Counterexamples& replayed = {},
                         const std::string& environment = {});

}  // namespace liecheck::properties
