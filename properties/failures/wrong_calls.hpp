#pragma once
// Calls of the probe of an adapter that are wrong where no law looks, as on joints with two bodies each.

#include <string>
#include <vector>

namespace liecheck::properties {

struct CampaignResult;
struct WrongCall;

/// A wrong result that no known convention explains, or that breaks a stated choice.
struct WrongWhenProbed {
  std::string subject, operation, sentence;
};

/// The wrong calls of operations that a law of the campaign measures and none finds wrong: of each subject the first one, and
/// which others are wrong, too. Adds the sentences on operations that no law of the campaign measures to `remarks`.
std::vector<WrongCall> wrong_calls_beside(const CampaignResult& campaign,
                                          const std::vector<WrongWhenProbed>& wrong,
                                          std::vector<std::string>& remarks);

}  // namespace liecheck::properties
