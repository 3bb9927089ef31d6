#pragma once
// Failures of a finding that its first line, and its cause, do not tell of.

#include <failures/findings.hpp>

namespace liecheck::properties {

struct SecondWays {
  std::string text;             ///< up to three lines "also ...", each with an example
  std::set<std::string> apart;  ///< blocks of the operation of whose failures such a line tells all
};

/// Bands in which the first block fails with another outcome, or at huge angles beside small ones; bands in which another block
/// of the operation fails and the first does not, or passes in that one's worst case; and outcomes of other operations that the
/// one which is their cause does not have in the same bands, or bands in which it passes.
SecondWays second_ways(const Finding& finding, const CampaignResult& campaign);

}  // namespace liecheck::properties
