#pragma once
// The error over the angle and the scale of the translation, on a grid of random inputs: a formula that cancels shows
// as a line. For the laws whose input is one rotation and one translation.

#include <campaign/campaign.hpp>

namespace liecheck::properties {

/// A column: decades of theta, or of pi - theta, from `low` to 10 `low` [rad].
struct AngleColumn {
  Axis axis;
  double low;
};
/// theta from 1e-16 to 1, then pi - theta from 1 to 1e-16.
std::vector<AngleColumn> map_columns();
/// The rows: the lower ends of two decades each of the norm of the translation [m].
std::vector<double> map_rows();

/// The largest errors of one output of one series, by row and column. NaN: none was measured; infinite: a case was
/// not finite, on a wrong branch, or without a result.
struct ErrorMap {
  const Series* series = nullptr;
  std::size_t output = 0;
  std::vector<std::vector<double>> errors;
};

/// The maps of all outputs whose unit has a length. Runs on the threads of the campaign; ends early after
/// stop_requested, and then returns the maps that are complete.
std::vector<ErrorMap> error_maps(const CampaignResult& campaign);

}  // namespace liecheck::properties
