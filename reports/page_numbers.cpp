// The figures that the page shows: those of report.json, without what would make the page large and nobody reads there.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <reports/html.hpp>
#include <reports/summary.hpp>
#include <set>
#include <string_view>
#include <unordered_map>

namespace liecheck::reports {
namespace {

constexpr std::size_t most_inputs = 24;  ///< numbers of a worst input; that of a tree has hundreds

/// Seven regions of the angle; page_numbers() names that of each row.
std::string_view region_of(const Json& row) {
  const std::string band = row["band"];
  const double low = row["low"].is_number() ? row["low"].get<double>() : 0,
               high = row["high"].is_number() ? row["high"].get<double>() : 0;
  if (row["axis"] == "theta") return high <= 1.001e-7 ? "zero" : high <= 1.001e-2 ? "small" : "moderate";
  if (band.starts_with("generic")) return "moderate";
  if (row["axis"] == "pi_minus_theta") return low >= 0.999e-7 ? "near-pi" : "pi";
  return band == "beyond pi" || band == "near 2pi k" || band == "huge" ? "beyond" : "all";
}

/// Larger is worse: failing rows first, then by outcome, then by the digits lost.
double severity(const Json& row) {
  const double lost = judged(row);
  return (row["status"] == "fail" ? 1e6 : 0) + (row["not_finite"] > 0 || !std::isfinite(lost) ? 3e3 : 0) +
         (row["wrong_branch"] > 0 ? 2e3 : 0) + (lost > 1 && std::isfinite(lost) ? std::log10(lost) : 0);
}

/// All fractions with four digits; a chart or a table shows three.
void shorten(Json& value) {
  if (value.is_number_float() && std::isfinite(value.get<double>()))
    value = std::strtod(fmt::format("{:.4g}", value.get<double>()).c_str(), nullptr);
  else if (value.is_structured())
    for (Json& part : value) shorten(part);
}

/// The cell of the page to which a row belongs.
std::string cell_of(const Json& row) {
  return fmt::format("{}\n{}\n{}\n{}", text_of(row, "subject"), text_of(row, "scalar"),
                     text_of(row, "operation"), region_of(row));
}

void shorten_results(Json& results) {
  const std::vector<std::size_t> worst = worst_rows(results);
  const std::set<std::size_t> shown(worst.begin(), worst.end());
  for (std::size_t i = 0; i < results.size(); ++i) {
    Json& row = results[i];
    row["region"] = region_of(row);
    row.erase("reason");
    for (const char* name : {"max_eps", "p99_eps", "median_eps", "max_excess"}) shorten(row[name]);
    if (!has_worst(row)) continue;
    Json& w = row["worst"];
    if (w.contains("kappa")) shorten(w["kappa"]);
    w["count"] = w["input"].size();
    w["shown"] = shown.contains(i);
    if (!shown.contains(i)) {
      w["input"] = Json::array();
      w.erase("numbers"), w.erase("call");
    } else if (w["input"].size() > most_inputs) {
      w["input"].erase(w["input"].begin() + most_inputs, w["input"].end());
    }
  }
}

}  // namespace

std::vector<std::size_t> worst_rows(const Json& results) {
  std::unordered_map<std::string, std::size_t> worst;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!has_worst(results[i])) continue;
    const auto [place, is_new] = worst.emplace(cell_of(results[i]), i);
    if (!is_new && severity(results[i]) > severity(results[place->second])) place->second = i;
  }
  std::vector<std::size_t> rows;
  for (const auto& [cell, row] : worst) rows.push_back(row);
  std::sort(rows.begin(), rows.end());
  return rows;
}

Json page_numbers(Json numbers) {
  shorten_results(numbers["results"]);
  for (Json& record : numbers["records"]) {
    if (record.contains("cost"))
      for (Json& row : record["cost"]["rows"]) {
        row["sets"] = Json::array({row["sets"].back()});
        shorten(row);
      }
    if (record.contains("scenes")) shorten(record["scenes"]);
    if (record.contains("hard_cases"))
      for (Json& hard : record["hard_cases"])
        for (Json& cell : hard["cells"]) shorten(cell["error"]), shorten(cell["kappa"]);
  }
  return numbers;
}

}  // namespace liecheck::reports
