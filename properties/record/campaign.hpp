#pragma once
// A campaign as a record: what `--json` writes and the report reads, documented in docs/record.md.

#include <campaign/campaign.hpp>
#include <nlohmann/json_fwd.hpp>
#include <store/counterexamples.hpp>

namespace liecheck::properties {

/// `earlier_environment` is the environment of an earlier run as JSON; if empty, the present one is recorded.
nlohmann::json record_of(const CampaignResult& result, const Counterexamples& replayed = {},
                         const std::string& earlier_environment = {});

}  // namespace liecheck::properties
