#pragma once
// A campaign's result as text.

#include <campaign/campaign.hpp>

namespace liecheck::properties {

/// Prints the table, the failures and the coverage (all of it if verbose). Returns the verdict's exit code.
int print_campaign(const CampaignResult& result, bool verbose);

}  // namespace liecheck::properties
