#pragma once
// Cliffs: bands of the angle in which an error is far above the error elsewhere, as where a formula cancels.
// docs/limits.md, section Cliffs. No limit excuses one.

#include <campaign/series.hpp>
#include <functional>

namespace liecheck::properties {

/// The highest band of one output. The figure of a band is error / max(1, kappa) [eps] that 99 % of its cases
/// do not exceed, and at least 1; where the rule is forward, kappa counts as 1.
struct Cliff {
  std::size_t output = 0, band = 0;
  bool expected = false;  ///< by the limits file of the subject
  bool moderate =
      false;  ///< `reference` is that of moderate angles, 0.1 to pi - 1; otherwise of both neighbours
  double figure = 0, reference = 0;
  double ratio() const { return figure / reference; }
};

/// What judges the rows of a series: a stored one has no law.
struct CliffTerms {
  std::size_t outputs;
  const Bands& bands;
  std::function<Rule(std::size_t output, Region region)> rule;
  std::function<bool(std::size_t output, std::size_t band)> expected;
};

/// Whether a band has moderate angles.
bool is_reference(const Band& band);

/// The figure of a band; 0 if less than 100 cases were measured.
double cliff_figure(const Row& row, Rule rule);

/// By output; beside an expected one there may be another. A cliff is a hundred times its reference.
std::vector<Cliff> cliffs_of(const CliffTerms& terms, const Rows& rows);
std::vector<Cliff> cliffs_of(const Series& series, const Tally& tally);

/// "exp6 translation at theta 1e-8..1e-7: 1e+07 times its error at moderate angles (2e+07 against 2 eps)".
std::string text_of(const Series& series, const Cliff& cliff);

/// Whether any of them is not expected.
bool unexpected(const std::vector<Cliff>& cliffs);

}  // namespace liecheck::properties
