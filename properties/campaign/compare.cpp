#include <fmt/format.h>
#include <algorithm>
#include <campaign/merge.hpp>
#include <tuple>

namespace liecheck::properties {

namespace {

using Name = std::tuple<std::string, std::string, std::string, std::string, std::string, std::string>;

struct Measured {
  const StoredSeries* series;
  const Row* row;
};

std::map<Name, Measured> by_name(const StoredCampaign& c) {
  std::map<Name, Measured> all;
  for (const StoredSeries& s : c.series)
    for (const auto& [cell, row] : s.tally.rows) {
      const Label& l = s.labels.at(cell);
      all[{s.subject, s.scalar, s.property, l.operation, l.block, l.band}] = {&s, &row};
    }
  return all;
}

/// Ignoring the band: is the operation's block measured at all?
bool measured(const std::map<Name, Measured>& all, const Name& n) {
  const auto [subject, scalar, property, operation, block, band] = n;
  const auto at = all.lower_bound({subject, scalar, property, operation, block, ""});
  return at != all.end() &&
         std::tie(subject, scalar, property, operation, block) ==
             std::tie(std::get<0>(at->first), std::get<1>(at->first), std::get<2>(at->first),
                      std::get<3>(at->first), std::get<4>(at->first));
}

}  // namespace

std::vector<std::string> worse(const StoredCampaign& a, const StoredCampaign& b) {
  const auto before = by_name(a), after = by_name(b);
  std::vector<std::string> lines;
  for (const auto& [name, old] : before) {
    const auto [subject, scalar, property, operation, block, band] = name;
    const auto say = [&, &subject = subject, &scalar = scalar, &property = property, &operation = operation,
                      &block = block, &band = band](const std::string& what) {
      lines.push_back(
          fmt::format("{} {} {}: {}, {}, {}: {}", subject, scalar, property, operation, block, band, what));
    };
    const auto found = after.find(name);
    if (found == after.end()) {
      const bool same = std::any_of(b.series.begin(), b.series.end(), [&](const StoredSeries& s) {
        return s.subject == old.series->subject && s.scalar == old.series->scalar &&
               s.property == old.series->property && s.tally.inputs.sum() == old.series->tally.inputs.sum();
      });
      if (same || !measured(after, name)) say("no longer measured");
      continue;
    }
    const Row &was = *old.row, &is = *found->second.row;
    const bool same_inputs = old.series->tally.inputs.sum() == found->second.series->tally.inputs.sum();
    const auto grew = [&](const char* what, std::uint64_t from, std::uint64_t to) {
      if (same_inputs ? to > from : (from == 0 && to > 0))
        say(fmt::format("{} {} of {} cases, were {} of {}", what, to, is.count, from, was.count));
    };
    grew("failed", was.failed, is.failed);
    grew("unresolved", was.unresolved, is.unresolved);
    grew("ill-posed", was.ill_posed, is.ill_posed);
    if (same_inputs && is.count < was.count)
      say(fmt::format("measured {} times, were {}", is.count, was.count));
    const double factor = same_inputs ? 1.1 : 2.0;
    const auto maximum = [&](const char* what, double from, double to) {
      if (to > from * factor && to > from + 0.5)
        say(fmt::format("{} {:.4g}, was {:.4g} (worst case {}, was {})", what, to, from, is.worst_index,
                        was.worst_index));
    };
    // Under the excess rule an error without its kappa says nothing.
    const bool excess = was.max_excess > 0 || is.max_excess > 0;
    maximum(excess ? "largest excess [eps kappa]" : "largest error [eps]",
            excess ? was.max_excess : was.max_error, excess ? is.max_excess : is.max_error);
  }
  return lines;
}

}  // namespace liecheck::properties
