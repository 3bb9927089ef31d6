#include <campaign/needs.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <oracles/undecided.hpp>

namespace liecheck::properties {

std::map<std::string, Needs> needs_of(const CampaignResult& campaign) {
  std::map<std::string, Needs> needs;
  for (const auto& [series, tally] : campaign.series)
    for (const auto& [cell, row] : tally.rows) {
      const auto output = static_cast<std::size_t>(cell.first);
      const Region region = series->bands()[static_cast<std::size_t>(cell.second)].region;
      const Budget& b = series->budget(output, region);
      const bool forward = b.rule == Rule::forward;
      Need& need = needs[series->subject][{b.operation, b.block, b.region, forward ? "forward" : "excess"}];
      const std::uint64_t broken = row.judged() - row.errors.count();
      const double largest = forward ? row.max_error : row.max_excess;
      if ((broken && !need.broken) || (!need.broken && largest >= need.largest))
        need.worst = series->id(campaign.options.seed, row.worst_index).text();
      need.largest = std::max(need.largest, largest);
      need.limit = b.limit;
      need.broken += broken, need.unmeasured += row.unresolved + row.unmeasured;
    }
  return needs;
}

std::string limit_lines(const Needs& needs, double factor, const std::string& reason) {
  std::string text;
  for (const auto& [key, need] : needs)
    if (need.largest > oracles::error_accuracy)
      text += fmt::format("{}, {}, {}, {} = {:.3g}, {}\n", key.operation, key.block, key.region, key.rule,
                          factor * need.largest, reason);
  return text;
}

std::string limits_text(const std::string& subject, const Needs& needs, const std::string& reason) {
  return fmt::format("version = 1\nsubject = {}\n\n[limits]\n{}", subject,
                     limit_lines(needs, allowance, reason));
}

}  // namespace liecheck::properties
