#pragma once
// A campaign as a store would hold it.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <store/stored_campaign.hpp>
#include <utility>

namespace liecheck::properties {

inline StoredCampaign stored_from(CampaignResult r) {
  StoredCampaign c;
  c.spec = spec_of(r.options, r.robot, r.series);
  for (SeriesResult& s : r.series) {
    StoredSeries stored{name_of(*s.series), std::move(s.tally), {}, {}};
    for (const auto& [cell, row] : stored.tally.rows) {
      const Output& o = s.series->outputs.at(static_cast<std::size_t>(cell.first));
      stored.labels[cell] = {std::string(o.operation), std::string(o.block),
                             s.series->bands()[static_cast<std::size_t>(cell.second)].name};
      if (row.failed > 0)
        stored.failures[cell] = {
            row.worst_index,
            fmt::format("{}", fmt::join(s.series->input(s.series->id(c.spec.seed, row.worst_index)), ","))};
    }
    c.series.push_back(std::move(stored));
  }
  return c;
}

}  // namespace liecheck::properties
