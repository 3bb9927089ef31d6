#include <campaign/expected.hpp>

#include <fmt/format.h>
#include <campaign/cliffs.hpp>

namespace liecheck::properties {

namespace {

const ExpectedFailure* line_of(const Series& series, const Rows::Cell& cell) {
  return series.expected(static_cast<std::size_t>(cell.first), static_cast<std::size_t>(cell.second));
}

}  // namespace

bool fails(const Series& series, const Rows::Cell& cell, const Row& row) {
  return row.failed > 0 && !line_of(series, cell);
}

bool fails(const Series& series, const Judged& judged) {
  return judged.failed && !series.expected(judged.residual.output, judged.residual.band);
}

std::vector<Expectation> expectations_of(const CampaignResult& campaign) {
  std::vector<Expectation> all;
  std::map<const ExpectedFailure*, std::size_t> place;
  for (const auto& [series, tally] : campaign.series) {
    if (!series->own) continue;
    for (const ExpectedFailure& line : series->own->expected)
      if (place.try_emplace(&line, all.size()).second) all.push_back({series->subject, line});
    for (const auto& [cell, row] : tally.rows)
      if (const ExpectedFailure* line = line_of(*series, cell)) {
        Expectation& e = all[place.at(line)];
        e.measured += row.judged(), e.failed += row.failed;
      }
    for (const Cliff& c : cliffs_of(*series, tally))
      if (const ExpectedFailure* line = series->expected(c.output, c.band)) all[place.at(line)].cliff = true;
  }
  return all;
}

std::string text_of(const Expectation& e) {
  return fmt::format("expected failure{}: {}, {} {} at {}: {} of {} cases{}: {} ({})",
                     e.passed() ? " that passed" : "", e.subject, e.line.operation, e.line.block,
                     e.line.inputs.text, e.failed, e.measured, e.cliff ? ", a cliff" : "", e.line.reason,
                     e.line.link);
}

}  // namespace liecheck::properties
