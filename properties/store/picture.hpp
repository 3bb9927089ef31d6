#pragma once
// What got worse and what got better between two campaigns, as a picture for a pull request.

#include <store/compare.hpp>

namespace liecheck::properties {

/// An SVG with a line for each cell that is worse or better: its errors before (hollow) and after (filled) on a logarithmic
/// axis in eps, and how many cases fail. If the inputs are the same, the errors are the largest ones; otherwise the
/// 99 % quantiles, because a maximum depends on the sample. At most 30 lines get worse and 12 better; the picture
/// says how many more there are.
std::string picture_of(const Comparison& comparison, const StoredCampaign& a, const StoredCampaign& b);

}  // namespace liecheck::properties
