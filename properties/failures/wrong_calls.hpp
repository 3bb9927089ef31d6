#pragma once
// Calls of the probe of an adapter that are wrong where no law looks, as on joints with two bodies each.

#include <campaign/beside_cases.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

struct CampaignResult;
struct WrongCall;

/// Of what the probe finds, the wrong calls of operations that a law of the campaign measures and none finds wrong: of each subject the first one, and
/// which others are wrong, too. Adds the sentences on operations that no law of the campaign measures to `remarks`.
std::vector<WrongCall> wrong_calls_beside(const CampaignResult& campaign,
                                          const std::vector<ProbedOperation>& probed,
                                          std::vector<std::string>& remarks);

}  // namespace liecheck::properties
