#pragma once
// Checks that a campaign reached the classes and bands that its generators must cover.

#include <campaign/series.hpp>

namespace liecheck::properties {

/// One class of one field, or one band of the angle.
struct Covered {
  std::string what;  ///< "phi: beyond pi", "band theta 1e-8..1e-7"
  std::uint64_t count = 0;
  std::uint64_t excluded = 0;  ///< inputs of it that are outside the subject's domain
  std::uint64_t one_in = 0;    ///< at least one case in this many belongs to it
  bool required = false;       ///< the campaign is long enough to expect inputs in it
  bool missing() const { return required && count == 0 && excluded == 0; }
};

/// All classes and bands that the series' generator must cover. The bands are those of the exact angles that
/// were measured; a law without angles has none.
std::vector<Covered> coverage_of(const Series& series, const Tally& tally);

/// One line: how many classes and bands were reached, or which are missing, and how many cases and classes
/// are outside the subject's domain.
std::string coverage_line(const std::vector<Covered>& all, const Tally& tally);

}  // namespace liecheck::properties
