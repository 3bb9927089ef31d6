// The figures that the page shows: those of report.json, without what would make the page large and nobody reads there.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <reports/html.hpp>
#include <reports/picture.hpp>
#include <reports/summary.hpp>
#include <set>
#include <support/text.hpp>
#include <unordered_map>

namespace liecheck::reports {
namespace {

constexpr std::size_t most_inputs = 16;          ///< numbers of a worst input; that of a tree has hundreds
constexpr std::size_t longest_expression = 120;  ///< of a hard case; longer ones are the numbers of its input

/// What a row without a worst case has.
const Json no_worst = {{"stem", ""},
                       {"case", ""},
                       {"count", 0},
                       {"kappa", nullptr},
                       {"shown", false},
                       {"call", ""},
                       {"input", Json::array()},
                       {"numbers", Json::array()}};

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
                     text_of(row, "operation"), regions[region_of(row)].key);
}

/// A worst case with the keys that all of them have, so that packed() makes columns of them. The address of a case ends with its
/// number; what comes before is the same in many rows.
Json worst_of_page(const Json& worst, bool shown) {
  Json w = no_worst;
  const std::string id = worst["id"];
  const auto dot = std::min(id.rfind('.'), id.size());
  w["stem"] = id.substr(0, dot), w["case"] = id.substr(dot), w["count"] = worst["input"].size();
  w["kappa"] = worst.value("kappa", Json()), w["shown"] = shown;
  shorten(w["kappa"]);
  if (!shown) return w;
  w["call"] = worst.value("call", ""), w["numbers"] = worst.value("numbers", Json::array());
  for (std::size_t i = 0; i < std::min(worst["input"].size(), most_inputs); ++i)
    w["input"].push_back(worst["input"][i]);
  return w;
}

void shorten_results(Json& results, const Digits& digits) {
  const std::vector<std::size_t> worst = worst_rows(results);
  const std::set<std::size_t> shown(worst.begin(), worst.end());
  for (std::size_t i = 0; i < results.size(); ++i) {
    Json& row = results[i];
    row["region"] = regions[region_of(row)].key;
    row["outcome"] = outcome_of(row);
    row["lost"] = std::round(100 * digits.lost(row)) / 100;
    row.erase("reason");
    for (const char* name : {"max_eps", "p99_eps", "median_eps", "max_excess"}) shorten(row[name]);
    row["worst"] = has_worst(row) ? worst_of_page(row["worst"], shown.contains(i)) : no_worst;
  }
}

/// The script knows how a replay line follows from the input, and the input stands below an expression.
void shorten_hard_case(Json& hard) {
  if (hard["expression"].get_ref<const std::string&>().size() > longest_expression) hard["expression"] = "";
  for (Json& cell : hard["cells"]) {
    shorten(cell["error"]), shorten(cell["kappa"]);
    const auto input = hard["input"][cell["scalar"].get<std::string>()].get<std::vector<std::string>>();
    if (cell["replay"] == fmt::format("liecheck replay raw.{}.{}.{}.none.{}",
                                      hard["property"].get<std::string>(), cell["subject"].get<std::string>(),
                                      cell["scalar"].get<std::string>(), fmt::join(input, ",")))
      cell["replay"] = "";
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

Json page_numbers(Json numbers, const Looks& looks) {
  shorten_results(numbers["results"], looks.digits);
  numbers["looks"] = looks.of;
  for (Json& record : numbers["records"]) {
    for (Json& s : record["subjects"])
      s["replay"] = properties::replay_words("ID", s.value("flags", "")), s.erase("flags");
    if (record.contains("cost"))
      for (Json& row : record["cost"]["rows"]) {
        row["sets"] = Json::array({row["sets"].back()});
        shorten(row);
      }
    if (record.contains("scenes")) shorten(record["scenes"]);
    if (record.contains("hard_cases"))
      for (Json& hard : record["hard_cases"]) shorten_hard_case(hard);
  }
  return numbers;
}

}  // namespace liecheck::reports
