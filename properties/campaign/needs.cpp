#include <campaign/needs.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <oracles/ball_error.hpp>
#include <sstream>
#include <stdexcept>

namespace liecheck::properties {

std::map<std::string, Needs> needs_of(const CampaignResult& campaign) {
  std::map<std::string, Needs> needs;
  for (const auto& [series, tally] : campaign.series)
    for (const auto& [cell, row] : tally.rows) {
      const Output& o = series->outputs.at(static_cast<std::size_t>(cell.first));
      const Region region = series->bands()[static_cast<std::size_t>(cell.second)].region;
      const Budget& b = budget_of(series->subject, o.operation, o.block, region);
      const bool forward = b.rule == Rule::forward;
      Need& need = needs[series->subject][{b.operation, b.block, b.region, forward ? "forward" : "excess"}];
      const std::uint64_t broken = row.judged() - row.errors.count();
      const double largest = forward ? row.max_error : row.max_excess;
      if ((broken && !need.broken) || (!need.broken && largest >= need.largest))
        need.worst = series->id(campaign.options.seed, row.worst_index).text();
      need.largest = std::max(need.largest, largest);
      need.budget = b.limit;
      need.broken += broken, need.unresolved += row.unresolved;
    }
  return needs;
}

OwnLimits limits_for(const Needs& needs) {
  OwnLimits limits;
  for (const auto& [key, need] : needs)
    if (need.largest > oracles::error_accuracy) limits[key] = allowance * need.largest;
  return limits;
}

std::string text_of(const std::string& subject, const OwnLimits& limits, const std::string& reason) {
  std::string text = fmt::format("version = 1\nsubject = {}\n\n[limits]\n", subject);
  for (const auto& [key, limit] : limits)
    text += fmt::format("{}, {}, {}, {} = {:.3g}, {}\n", key.operation, key.block, key.region, key.rule,
                        limit, reason);
  return text;
}

OwnLimits parse_limits(const std::string& text) {
  OwnLimits limits;
  std::istringstream in(text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::istringstream cells(line);
    LimitKey key;
    double limit = 0;
    if (line.find(',') == line.npos) continue;  // the head of the file
    std::getline(cells, key.operation, ','), std::getline(cells >> std::ws, key.block, ',');
    std::getline(cells >> std::ws, key.region, ','), std::getline(cells >> std::ws, key.rule, '=');
    if (!(cells >> limit)) throw std::runtime_error(fmt::format("line {}: not a limit: '{}'", number, line));
    key.rule.pop_back();
    limits[key] = limit;
  }
  return limits;
}

std::vector<Accusation> accusations(const Needs& found, const OwnLimits& limits) {
  std::vector<Accusation> all;
  for (const auto& [key, need] : found) {
    const auto own = limits.find(key);
    const double limit = own != limits.end() ? own->second : need.budget;
    if (need.broken || need.unresolved || !(need.largest <= limit)) all.push_back({key, need, limit});
  }
  return all;
}

}  // namespace liecheck::properties
