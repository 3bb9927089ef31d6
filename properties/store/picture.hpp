#pragma once
// What got worse and what got better between two campaigns, as a picture for a pull request.

#include <store/stored_campaign.hpp>

namespace liecheck::properties {

/// An SVG with a line for each cell of `changes`: its errors before (hollow) and after (filled) on a logarithmic
/// axis in eps, and how many cases fail. If the inputs are the same, the errors are the largest ones; otherwise the
/// 99 % quantiles, because a maximum depends on the sample. At most 30 lines get worse and 12 better; the picture
/// says how many more there are. Throws what `changes` throws.
std::string picture_of_changes(const StoredCampaign& a, const StoredCampaign& b);

}  // namespace liecheck::properties
