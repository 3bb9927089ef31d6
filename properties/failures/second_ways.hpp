#pragma once
// Failures of a finding that its first line, and its cause, do not tell of.

#include <failures/findings.hpp>

namespace liecheck::properties {

/// Up to three lines "also ...", each with an example: bands in which the first block fails with another outcome, or at huge
/// angles beside small ones; bands in which another block of the operation fails and the first does not; and outcomes of
/// other operations that the one which is their cause does not have in the same bands, or bands in which it passes.
std::string second_ways(const Finding& finding, const CampaignResult& campaign);

}  // namespace liecheck::properties
