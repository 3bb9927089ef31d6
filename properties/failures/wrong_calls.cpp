#include <failures/wrong_calls.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <campaign/campaign.hpp>
#include <map>

namespace liecheck::properties {

namespace {

/// Whether an output is of an operation, or formed from it.
bool is_of(const Output& output, const Series& series, const std::string& operation) {
  return output.operation == operation ||
         std::ranges::count(series.formed_from(*output.record), operation) > 0;
}

enum class Found { unmeasured, right, wrong };

/// What the laws find of an operation. It is wrong even where a limits file expects it.
Found found_of(const CampaignResult& campaign, const std::string& subject, const std::string& operation) {
  Found found = Found::unmeasured;
  for (const auto& [series, tally] : campaign.series) {
    if (series->subject != subject) continue;
    for (const auto& [cell, row] : tally.rows) {
      if (!is_of(series->outputs[static_cast<std::size_t>(cell.first)], *series, operation)) continue;
      if (row.failed > 0) return Found::wrong;
      if (row.inside() > 0) found = Found::right;
    }
  }
  return found;
}

}  // namespace

std::vector<WrongCall> wrong_calls_beside(const CampaignResult& campaign,
                                          const std::vector<ProbedOperation>& probed,
                                          std::vector<std::string>& remarks) {
  std::vector<WrongCall> all;
  std::map<std::string, std::vector<std::string>> wrong_ones;  // by subject
  for (const auto& [subject, operation, sentence, wrong] : probed) {
    if (!wrong) continue;
    const Found found = found_of(campaign, subject, operation);
    if (found == Found::unmeasured) remarks.push_back(sentence);
    if (found != Found::right) continue;
    std::vector<std::string>& operations = wrong_ones[subject];
    if (operations.empty()) all.push_back({subject, sentence});
    if (std::ranges::find(operations, operation) == operations.end()) operations.push_back(operation);
  }
  for (const auto& [subject, operations] : wrong_ones)
    if (operations.size() > 1)
      all.push_back({subject, fmt::format("{} {} wrong there, too",
                                          fmt::join(operations.begin() + 1, operations.end(), ", "),
                                          operations.size() == 2 ? "is" : "are")});
  return all;
}

}  // namespace liecheck::properties
