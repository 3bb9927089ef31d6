#pragma once
// Did a campaign reach what its generators must cover?

#include <campaign/series.hpp>

namespace liecheck::properties {

/// One class of one field, or one band of the angle.
struct Covered {
  std::string what;  ///< "phi: beyond pi", "band theta 1e-8..1e-7"
  std::uint64_t count = 0;
  std::uint64_t one_in = 0;
  bool required = false;  ///< the campaign is long enough to expect it
  bool missing() const { return required && count == 0; }
};

/// Everything that the series' generator must cover. Bands are those of the exact angles that the law measured at;
/// a law without angles has none.
std::vector<Covered> coverage_of(const Series& series, const Tally& tally);

/// One line: how many of the classes and bands were reached, or what is missing.
std::string coverage_line(const std::vector<Covered>& all, std::uint64_t cases);

}  // namespace liecheck::properties
