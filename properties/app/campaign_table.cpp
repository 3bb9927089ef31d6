#include <app/campaign_table.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/coverage_report.hpp>
#include <support/text.hpp>
#include <app/store_commands.hpp>
#include <limits>
#include <map>
#include <tuple>

namespace liecheck::properties {

namespace {

/// A line for each property, of its series that reached least; all of it where asked for.
void print_coverage(const CampaignResult& r, bool verbose) {
  fmt::print("\n{:<24}{:<20}{}\n", "coverage", "", "of what the generator must reach");
  std::map<std::string, std::tuple<bool, std::size_t, std::string, std::string>> least;
  for (const auto& [series, tally] : r.series) {
    const auto all = coverage_of(*series, tally);
    const auto missing = std::any_of(all.begin(), all.end(), [](const Covered& c) { return c.missing(); });
    const auto unseen = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const Covered& c) { return c.count == 0; }));
    auto& l = least[series->property];
    if (std::get<3>(l).empty() || std::tuple(missing, unseen) > std::tuple(std::get<0>(l), std::get<1>(l)))
      l = {missing, unseen, series->subject + " in " + series->scalar,
           coverage_line(all, tally.coverage.cases())};
    if (!verbose) continue;
    fmt::print("{} {} in {}, {} cases\n", series->property, series->subject, series->scalar,
               tally.coverage.cases());
    for (const Covered& c : all)
      fmt::print("  {:<44}{:>10}  {:>8.4f} %{}\n", c.what, c.count,
                 100.0 * static_cast<double>(c.count) /
                     static_cast<double>(std::max<std::uint64_t>(1, tally.coverage.cases())),
                 c.missing()  ? "  NOT COVERED"
                 : c.required ? ""
                              : "  not required of so few cases");
  }
  for (const auto& [property, l] : least)
    fmt::print("{:<24}{:<20}{}\n", property, std::get<2>(l), std::get<3>(l));
}

}  // namespace

int print_campaign(const CampaignResult& r, bool verbose) {
  constexpr int shown_failures = 6;
  int failures = 0;
  fmt::print("{:<24}{:<15}{:<10}{:>9}  {:>11}  {}\n", "property", "subject", "scalar", "cases", "worst",
             "status");
  for (const auto& [series, tally] : r.series) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double worst = 0;
    bool failed = false;
    std::uint64_t unresolved = 0;
    std::string limit;
    for (const auto& [key, row] : tally.rows) {
      const Output& o = series->outputs.at(static_cast<std::size_t>(key.first));
      const Budget& b = budget_of(series->subject, o.operation, o.block,
                                  series->bands()[static_cast<std::size_t>(key.second)].region);
      // an unresolved case is the one to replay, and has no figure
      const double measured = b.rule == Rule::forward ? row.max_error : row.max_excess;
      worst =
          std::max(worst, (row.failed || row.worst_score < infinity ? row.worst_score : measured) / b.limit);
      failed = failed || row.failed > 0;
      unresolved += row.unresolved;
    }
    fmt::print("{:<24}{:<15}{:<10}{:>9}  {:>10.3g}x  {}{}\n", series->property, series->subject,
               series->scalar, tally.cases, worst, failed || !tally.disagreed.empty() ? "FAIL" : "pass",
               unresolved ? fmt::format(", {} unresolved", unresolved) : "");
  }
  fmt::print(
      "worst: the largest error found as a multiple of its budget, a lower bound of the true maximum\n");
  for (const auto& [series, tally] : r.series) {
    // The worst band of each output stands for it.
    std::map<int, std::pair<int, const Row*>> worst;
    for (const auto& [key, row] : tally.rows) {
      auto& w = worst[key.first];
      if (row.failed && (!w.second || row.worst_score > w.second->worst_score)) w = {key.second, &row};
    }
    for (const auto& [output, band_row] : worst) {
      if (!band_row.second) continue;
      if (failures++ < shown_failures)
        fmt::print("\n{}", describe_failure(*series, r.options.seed, output, band_row.first, *band_row.second,
                                            r.robot));
    }
  }
  if (failures > shown_failures)
    fmt::print("\n{} more operations and blocks failed; --json FILE records them all\n",
               failures - shown_failures);
  std::uint64_t fast = 0, checked = 0, disagreed = 0;
  for (const auto& [series, tally] : r.series) {
    fast += tally.fast, checked += tally.checked, disagreed += tally.disagreed.size();
    for (const std::uint64_t index : tally.disagreed)
      fmt::print("ORACLES DISAGREE: {}\n", series->id(r.options.seed, index).text());
  }
  fmt::print(
      "\noracles: {:.2f} % of the cases decided in ball arithmetic, the rest at 50 and 100 digits; {} of the "
      "decided ones measured again at those, {} disagree\n",
      r.total_cases ? 100.0 * static_cast<double>(fast) / static_cast<double>(r.total_cases) : 0.0, checked,
      disagreed);
  print_coverage(r, verbose);
  fmt::print("\nseed {}, {} cases in {:.1f} s, robot {}{} ({})\n", r.options.seed, r.total_cases, r.elapsed,
             printable(r.robot.name), r.robot.fixed ? ", fixed" : "", r.robot.hash);
  fmt::print("inputs  {}\nresults {}\n", r.inputs_digest, r.results_digest);
  fmt::print("verdict {}\n", r.incomplete ? "incomplete" : r.failed ? "fail" : "pass");
  return r.incomplete ? incomplete : r.failed ? property_failed : within_budget;
}

}  // namespace liecheck::properties
