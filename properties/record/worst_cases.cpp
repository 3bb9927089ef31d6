// What a record adds for the page: the numbers of worst cases, and the maps of the error.

#include <fmt/format.h>
#include <campaign/error_map.hpp>
#include <campaign/long_sums.hpp>
#include <cstdlib>
#include <failures/calls.hpp>
#include <failures/result.hpp>
#include <record/record.hpp>
#include <support/json_number.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>
#include <support/threads.hpp>

namespace liecheck::properties {

namespace {

using nlohmann::json;

constexpr std::size_t most_numbers = 6;  ///< of a result; those that differ most come first

struct Place {
  const Series* series;
  std::size_t output;
};

/// The series and output of each row of the record, in the order in which record_of() wrote them.
std::vector<Place> places_of(const CampaignResult& campaign) {
  std::vector<Place> all;
  for (const auto& [series, tally] : campaign.series)
    for (const auto& [cell, row] : tally.rows)
      all.push_back({series.get(), static_cast<std::size_t>(cell.first)});
  return all;
}

/// Two digits are enough for a colour.
json rounded_error(double error) {
  if (std::isnan(error)) return {};
  if (std::isinf(error)) return "inf";
  return std::strtod(fmt::format("{:.2g}", error).c_str(), nullptr);
}

}  // namespace

void add_compared_numbers(json& record, const CampaignResult& campaign,
                          const std::vector<std::size_t>& rows) {
  const std::vector<Place> places = places_of(campaign);
  std::vector<ComparedResult> found(rows.size());
  std::atomic<std::size_t> next{0};
  Steps steps("numbers of the worst cases", rows.size());
  run_on_threads(std::max(campaign.options.jobs, 1u), stop_requested, [&] {
    const GivesUpLongSums long_sums;
    for (std::size_t i; (i = next++) < rows.size() && !stop_requested;) {
      const auto& [series, output] = places.at(rows[i]);
      const json& worst = std::as_const(record)["results"][rows[i]]["worst"];
      const CaseId id = CaseId::parse(worst["id"].get<std::string>());
      const Output& of = series->outputs.at(output);
      try {
        found[i] = comparison_of(*series, of, noted(*series, id, output), most_numbers);
      } catch (const GivenUp&) {
        return;
      }
      steps.done(std::string(of.operation));
    }
  });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (found[i].operation.empty()) continue;
    json& worst = record["results"][rows[i]]["worst"];
    worst["call"] = found[i].operation;
    worst["numbers"] = list_of(found[i].numbers, [](const ComparedNumber& n) {
      return json{{"name", n.name}, {"got", n.got}, {"expected", n.expected}};
    });
  }
}

void add_maps(json& record, const CampaignResult& campaign) {
  const auto maps = error_maps(campaign);
  if (maps.empty()) return;
  json& all = record["maps"];
  all["scales"] = map_rows();
  all["angles"] = list_of(map_columns(), [](const AngleColumn& c) {
    return json{{"axis", c.axis == Axis::theta ? "theta" : "pi_minus_theta"}, {"low", c.low}};
  });
  all["panels"] = list_of(maps, [](const ErrorMap& m) {
    const Output& o = m.series->outputs[m.output];
    return json{{"subject", m.series->subject},
                {"scalar", m.series->scalar},
                {"property", m.series->property},
                {"operation", o.operation},
                {"block", o.block},
                {"errors", list_of(m.errors, [](const auto& row) { return list_of(row, rounded_error); })}};
  });
}

}  // namespace liecheck::properties
