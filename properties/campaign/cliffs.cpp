#include <campaign/cliffs.hpp>

#include <fmt/format.h>
#include <algorithm>

namespace liecheck::properties {

namespace {

constexpr std::uint64_t least_cases = 100;
constexpr double height = 100;

/// The largest figure of the nearest measured band on either side, or 0 if a side has none.
double of_neighbours(const std::vector<double>& figures, std::size_t band) {
  const auto measured = [](double figure) { return figure > 0; };
  const auto at = figures.begin() + static_cast<std::ptrdiff_t>(band);
  const auto above = std::find_if(at + 1, figures.end(), measured);
  const auto below = std::find_if(std::make_reverse_iterator(at), figures.rend(), measured);
  return above == figures.end() || below == figures.rend() ? 0 : std::max(*above, *below);
}

/// The highest cliff of one output among the bands that are expected or are not, if there is any.
std::optional<Cliff> highest(const CliffTerms& terms, std::size_t output, const std::vector<double>& figures,
                             bool expected) {
  const std::vector<Band>& bands = terms.bands.all();
  double moderate = 0;
  for (std::size_t b = 0; b < bands.size(); ++b)
    if (is_reference(bands[b])) moderate = std::max(moderate, figures[b]);
  std::vector<Cliff> found;
  for (std::size_t b = 0; b < bands.size(); ++b)
    for (const bool from_moderate : {true, false}) {
      const double reference = from_moderate ? moderate : of_neighbours(figures, b);
      if (reference > 0 && figures[b] >= height * reference && expected == terms.expected(output, b))
        found.push_back({output, b, expected, from_moderate, figures[b], reference});
    }
  const auto best = std::ranges::max_element(found, {}, &Cliff::figure);  // the first one, if equal: moderate
  return best == found.end() ? std::nullopt : std::optional(*best);
}

}  // namespace

bool is_reference(const Band& b) {
  return (b.axis == Axis::theta && b.high == 1) || (b.axis == Axis::none && b.low == 1);
}

double cliff_figure(const Row& row, Rule rule) {
  if (row.errors.count() < least_cases) return 0;
  const double largest = rule == Rule::forward ? row.max_error : row.max_excess;
  return std::max(1.0, std::min(largest, row.errors.quantile(0.99)));
}

std::vector<Cliff> cliffs_of(const CliffTerms& terms, const Rows& rows) {
  const std::vector<Band>& bands = terms.bands.all();
  std::vector<std::vector<double>> figures(terms.outputs, std::vector<double>(bands.size()));
  for (const auto& [cell, row] : rows) {
    const auto output = static_cast<std::size_t>(cell.first), band = static_cast<std::size_t>(cell.second);
    if (band > 0)  // band 0 is "all": inputs without an angle
      figures[output][band] = cliff_figure(row, terms.rule(output, bands[band].region));
  }
  std::vector<Cliff> all;
  for (std::size_t i = 0; i < figures.size(); ++i)
    for (const bool expected : {false, true})
      if (const auto cliff = highest(terms, i, figures[i], expected)) all.push_back(*cliff);
  return all;
}

std::vector<Cliff> cliffs_of(const Series& series, const Tally& tally) {
  return cliffs_of(
      {series.outputs.size(), series.bands(),
       [&](std::size_t output, Region region) { return series.budget(output, region).rule; },
       [&](std::size_t output, std::size_t band) { return series.expected(output, band) != nullptr; }},
      tally.rows);
}

bool unexpected(const std::vector<Cliff>& cliffs) {
  return !std::ranges::all_of(cliffs, &Cliff::expected);
}

std::string text_of(const Series& series, const Cliff& c) {
  const Output& o = series.outputs.at(c.output);
  return fmt::format("{} {} at {}: {:.1g} times its error {} ({:.3g} against {:.3g} eps)", o.operation,
                     o.block, series.bands()[c.band].name, c.ratio(),
                     c.moderate ? "at moderate angles" : "in the bands beside it", c.figure, c.reference);
}

}  // namespace liecheck::properties
