#include <failures/promises.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <failures/blocks.hpp>
#include <failures/result.hpp>
#include <operations/operations.hpp>

namespace liecheck::properties {

namespace {

/// A cliff is a hundred times the error at moderate angles: what is below this many times is none with other inputs.
constexpr double far_above = 64;
constexpr double tiny = 1e-100, huge = 100;  ///< bounds of angles [rad]

bool is_tiny(const Band& b) {
  return b.axis == Axis::theta && b.high > 0 && b.high <= 1.001 * tiny;
}
bool is_huge(const Band& b) {
  return b.axis == Axis::none && b.low == huge;
}

/// "A" and "B" of "theta A..B"; empty for a band of another name.
std::pair<std::string, std::string> ends_of(const Band& b) {
  const auto space = b.name.find(' '), dots = b.name.find("..");
  if (b.axis == Axis::none || dots == b.name.npos) return {};
  return {b.name.substr(space + 1, dots - space - 1), b.name.substr(dots + 2)};
}

std::string text_of(const DomainBound& b) {
  return fmt::format("{}, {} {} {:.17g}{}{}\n", b.operation ? b.operation->name : "*",
                     quantity_names()[static_cast<std::size_t>(b.quantity)], b.lower ? ">=" : "=", b.bound,
                     b.reason.empty() ? "" : ", ", b.reason);
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> runs_of(const std::vector<Band>& bands,
                                                         const std::vector<bool>& bad) {
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t first = 0; first < bands.size(); ++first) {
    if (!bad[first]) continue;
    std::size_t last = first;
    while (bands[first].axis != Axis::none && last + 1 < bands.size() && bad[last + 1] &&
           bands[last + 1].axis == bands[first].axis)
      ++last;
    all.emplace_back(first, last);
    first = last;
  }
  return all;
}

std::vector<std::string> inputs_of(const std::vector<Band>& bands, std::size_t first, std::size_t last) {
  std::vector<std::string> all;
  const bool theta = bands[first].axis == Axis::theta;
  std::string low, high;
  for (std::size_t i = first; i <= last; ++i)
    if (const auto [a, b] = ends_of(bands[i]); a.empty())
      all.push_back(bands[i].name);
    else if (theta)
      low = low.empty() ? a : low, high = b;
    else
      low = a, high = high.empty() ? b : high;
  const bool to_zero = theta ? bands[first].high == 0 : bands[last].low == 0;
  if (!low.empty() && to_zero) all.clear(), low = "0";
  if (!low.empty()) all.push_back(fmt::format("{}theta {}..{}", theta ? "" : "pi-", low, high));
  return all;
}

Promises::Promises(const CampaignResult& campaign) : campaign_(campaign) {
  for (const auto& [series, tally] : campaign.series)
    for (const auto& [cell, row] : tally.rows) {
      const auto output = static_cast<std::size_t>(cell.first), band = static_cast<std::size_t>(cell.second);
      OfBand& b = block(*series, output).bands[band];
      const Rule rule = series->budget(output, series->bands()[band].region).rule;
      b.largest = std::max(b.largest, rule == Rule::forward ? row.max_error : row.max_excess);
      b.quantile = std::max(b.quantile, cliff_figure(row, rule)), b.cases += row.judged();
      b.median = std::max(b.median, row.errors.count() ? row.errors.quantile(0.5) : 0);
      if (b.outcome.empty()) b.outcome = worst_outcome(row, true);
    }
  find_cliffs();
}

auto Promises::block(const Series& s, std::size_t output) -> Block& {
  const Output& o = s.outputs[output];
  return blocks_
      .try_emplace({std::string(o.operation), std::string(o.block), s.scalar},
                   Block{&s, output, std::vector<OfBand>(s.bands().all().size())})
      .first->second;
}

void Promises::add(const Series& series, const Worst& worst) {
  const auto output = static_cast<std::size_t>(worst.output);
  const Output& o = series.outputs[output];
  const auto at = blocks_.find({std::string(o.operation), std::string(o.block), series.scalar});
  if (at == blocks_.end()) return;  // no case had it
  for (std::size_t i = 0; i < worst.bands.size(); ++i) {
    OfBand& b = at->second.bands[i];
    const Rule rule = series.budget(output, series.bands()[i].region).rule;
    if ((rule == Rule::excess) == worst.by_kappa) b.largest = std::max(b.largest, worst.bands[i].score);
    if (worst.bands[i].broken && b.outcome.empty())
      b.outcome = outcome_words[static_cast<int>(worst.bands[i].outcome)];
  }
  find_cliffs();
}

bool Promises::add(const std::vector<HardRow>& rows) {
  bool any = false;
  for (const HardRow& row : rows)
    for (const HardCell& cell : row.cells) {
      if (!cell.failed) continue;
      const auto at = blocks_.find({cell.operation, cell.block, cell.scalar});
      if (at == blocks_.end()) continue;
      Block& all = at->second;
      const auto& bands = all.series->bands().all();
      const auto band = std::ranges::find(bands, cell.band, &Band::name);
      OfBand& b = all.bands[band == bands.end() ? 0 : static_cast<std::size_t>(band - bands.begin())];
      if (cell.verdict == Verdict::inaccurate)
        b.largest = std::max(b.largest, cell.excess ? cell.error / std::max(1.0, cell.kappa) : cell.error);
      else
        b.outcome = name_of(cell.verdict);
      any = true;
    }
  find_cliffs();
  return any;
}

bool Promises::is_bad(const Block& block, std::size_t band) const {
  const OfBand& b = block.bands[band];
  if (!b.outcome.empty() || b.cliff || allowance * b.largest * block.series->eps >= 1) return true;
  // Inputs without an angle, such as Euler angles, have no other band that tells how large a usual error is.
  if (band == 0) return b.largest > std::max(far_above * b.median, 1 / std::sqrt(block.series->eps));
  double moderate = 1, largest = 0;
  for (std::size_t i = 0; i < block.bands.size(); ++i)
    if (is_reference(block.series->bands()[i])) {
      moderate = std::max(moderate, block.bands[i].quantile);
      if (allowance * block.bands[i].largest * block.series->eps < 1)
        largest = std::max(largest, block.bands[i].largest);
    }
  return b.largest > std::max(far_above * moderate, largest);
}

std::vector<bool> Promises::bad_bands(const Block& block, bool edges) const {
  constexpr std::uint64_t few_cases = 100;
  const auto& bands = block.series->bands().all();
  std::vector<bool> bad(bands.size());
  for (std::size_t i = 0; i < bands.size(); ++i) bad[i] = is_bad(block, i);
  const auto beside = [&](std::size_t i, std::size_t k) {
    return bands[i].axis != Axis::none && bands[k].axis == bands[i].axis;
  };
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (!bad[i]) continue;
    std::size_t next = i + 1;
    while (next < bands.size() && !bad[next] && block.bands[next].cases < few_cases) ++next;
    if (next < bands.size() && bad[next] && beside(i, next))
      std::fill(bad.begin() + static_cast<std::ptrdiff_t>(i), bad.begin() + static_cast<std::ptrdiff_t>(next),
                true);
  }
  if (!edges) return bad;
  const std::vector<bool> inner = bad;
  for (std::size_t i = 1; i < bands.size(); ++i)
    for (const auto& [from, to] : {std::pair(i - 1, i), std::pair(i, i - 1)})
      if (inner[from] && beside(from, to) && !is_reference(bands[to]) &&
          (bands[to].low > 0 || bands[to].axis != Axis::theta))
        bad[to] = true;
  return bad;
}

void Promises::find_cliffs() {
  for (bool any = true; any;) {
    any = false;
    for (const auto& [series, tally] : campaign_.series) {
      const Series& s = *series;
      const CliffTerms terms{
          s.outputs.size(), s.bands(),
          [&](std::size_t output, Region region) { return s.budget(output, region).rule; },
          [&](std::size_t output, std::size_t band) { return is_bad(block(s, output), band); }};
      for (const Cliff& c : cliffs_of(terms, tally.rows))
        if (!c.expected) any = block(s, c.output).bands[c.band].cliff = true;
    }
  }
}

auto Promises::bounds() const -> std::map<std::string, Bounds> {
  std::map<std::string, Bounds> all;
  for (const Operation* o : all_operations()) {
    Bounds b;
    bool others_beyond_pi = false;
    for (const auto& [key, block] : blocks_) {
      if (std::get<0>(key) != o->name || !takes(*o, Quantity::angle)) continue;
      const std::vector<bool> bad = bad_bands(block, false);
      for (std::size_t i = 0; i < bad.size(); ++i) {
        if (!bad[i]) continue;
        const Band& band = block.series->bands()[i];
        b.lower = b.lower || is_tiny(band), b.upper = b.upper || is_huge(band);
        others_beyond_pi = others_beyond_pi || (band.region == Region::beyond_pi && !is_huge(band));
      }
    }
    b.upper = b.upper && !others_beyond_pi;
    if (b.lower || b.upper) all[std::string(o->name)] = b;
  }
  return all;
}

auto Promises::promised() const -> Promised {
  Promised all;
  std::vector<DomainBound> domain;
  for (const auto& own : campaign_.options.selection.limits) domain = own->domain;
  const auto bounded = bounds();
  for (const Operation* o : all_operations())
    if (const auto at = bounded.find(std::string(o->name)); at != bounded.end())
      for (const bool lower : {true, false})
        if ((lower ? at->second.lower : at->second.upper) &&
            std::ranges::none_of(domain, [&](const DomainBound& b) {
              return b.operation == o && b.quantity == Quantity::angle && b.lower == lower;
            }))
          domain.push_back({o, Quantity::angle, lower ? tiny : huge, lower,
                            lower ? "smaller angles fail" : "larger angles fail"});
  for (const DomainBound& b : domain) all.domain += text_of(b);

  Needs needs;
  std::map<std::pair<std::string, std::string>, std::vector<InputRegion>> expected;  // by operation and block
  for (const auto& [key, block] : blocks_) {
    const auto& [operation, name, scalar] = key;
    const auto bound = bounded.find(operation);
    const auto& bands = block.series->bands().all();
    auto& regions = expected[{operation, name}];
    std::vector<bool> bad = bad_bands(block, true);
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const bool outside = bound != bounded.end() && ((bound->second.lower && is_tiny(bands[i])) ||
                                                      (bound->second.upper && is_huge(bands[i])));
      if (!bad[i] && !outside) {
        const Budget& b = block.series->budget(block.output, bands[i].region);
        Need& need = needs[{b.operation, b.block, b.region, b.rule == Rule::forward ? "forward" : "excess"}];
        need.largest = std::max(need.largest, block.bands[i].largest);
      }
      bad[i] = bad[i] && !outside && std::ranges::none_of(regions, [&](const InputRegion& region) {
                 return region.has(bands[i]);  // of another scalar
               });
    }
    for (const auto& [first, last] : runs_of(bands, bad)) {
      OfBand worst;
      for (std::size_t i = first; i <= last; ++i) {
        worst.largest = std::max(worst.largest, block.bands[i].largest);
        if (worst.outcome.empty()) worst.outcome = block.bands[i].outcome;
      }
      const std::string what =
          worst.outcome.empty() ? fmt::format("up to {:.1g} eps", worst.largest) : worst.outcome;
      for (const std::string& inputs : inputs_of(bands, first, last)) {
        regions.push_back(parse_input_region(inputs).value());
        all.expected +=
            fmt::format("{}, {}, {} = {} in {}, to-be-reported\n", operation, name, inputs, what, scalar);
      }
    }
  }
  all.limits = limit_lines(needs, allowance, fmt::format("{:g} times the largest error found", allowance));
  return all;
}

}  // namespace liecheck::properties
