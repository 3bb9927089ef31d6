#include <reports/regions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <reports/summary.hpp>
#include <sstream>

namespace liecheck::reports {

std::size_t region_of(const Json& row) {
  const auto& band = row["band"].get_ref<const std::string&>();
  const double low = row["low"].is_number() ? row["low"].get<double>() : 0,
               high = row["high"].is_number() ? row["high"].get<double>() : 0;
  if (row["axis"] == "theta") return high <= 1.001e-8 ? 0 : high <= 1.001e-2 ? 1 : 2;
  if (band.starts_with("generic")) return 2;
  if (row["axis"] == "pi_minus_theta") return low >= 0.999e-8 ? 3 : 4;
  return band == "beyond pi" || band == "near 2pi k" || band == "huge" ? 5 : 6;
}

bool is_ordinary(const Json& row) {
  if (row["axis"] == "none") return row["band"] != "near 2pi k" && row["band"] != "huge";
  const double low = row["low"].get<double>(), high = row["high"].get<double>();
  return low >= 0.999e-8 || (row["axis"] == "theta" ? high == 0 : low == 0);
}

bool is_over_budget(const Json& row) {
  return row["status"] == "fail" || row["status"] == "expected";
}

std::string outcome_of(const Json& row) {
  if (row["not_finite"] > 0 || row["max_eps"].is_string()) return "NaN or Inf";
  const bool fails = is_over_budget(row);
  if (row["wrong_branch"] > 0 || (fails && row["block"] == "sign")) return "wrong branch";
  if (!fails || judged(row) > row["budget"].get<double>()) return "";
  return row["refused"] > 0 ? "refused" : "bad call";
}

const char* mark_of(const std::string& outcome) {
  return outcome == "NaN or Inf" ? "N" : outcome == "wrong branch" ? "B" : outcome == "refused" ? "R" : "!";
}

double severity(const Json& row) {
  const double lost = judged(row);
  return (row["status"] == "fail" ? 1e6
          : is_over_budget(row)   ? 5e5
                                  : 0) +
         (row["not_finite"] > 0 || !std::isfinite(lost) ? 3e3 : 0) +
         (outcome_of(row) == "wrong branch" ? 2e3 : 0) +
         (lost > 1 && std::isfinite(lost) ? std::log10(lost) : 0);
}

Digits::Digits(const Merged& merged) {
  for (const Json& record : merged.records)
    for (const Json& s : list_in(record, "subjects")) eps_[{s["name"], s["scalar"]}] = s["eps"].get<double>();
}

double Digits::all(const Json& row) const {
  const auto eps = eps_.find({row["subject"], row["scalar"]});
  return -std::log10(eps == eps_.end() || eps->second <= 0 ? 0x1p-52 : eps->second);
}

double Digits::lost(const Json& row) const {
  const double error = judged(row);
  const std::string outcome = outcome_of(row);
  if (outcome == "NaN or Inf" || outcome == "wrong branch" || !std::isfinite(error)) return all(row);
  return std::clamp(std::log10(std::max(error, 1.0)), 0.0, all(row));
}

std::string Digits::words(const Json& row) const {
  if (const std::string outcome = outcome_of(row); !outcome.empty()) return outcome;
  const std::string missing = fmt::format("{:.1f}", lost(row)), whole = fmt::format("{:.1f}", all(row));
  return missing == whole ? fmt::format("all {} digits lost", whole)
                          : fmt::format("{} of {} digits lost", missing, whole);
}

std::vector<HardCase> hard_cases(const Merged& merged) {
  std::vector<HardCase> all;
  std::map<std::array<std::string, 3>, std::size_t> places;
  std::set<std::string> extreme;  // bands
  for (const Json& row : merged.results)
    if (!is_ordinary(row)) extreme.insert(row["band"]);
  for (const Json& record : merged.records)
    for (const Json& hard : list_in(record, "hard_cases"))
      for (const Json& cell : hard["cells"]) {
        const auto [place, is_new] =
            places.try_emplace({hard["name"], cell["subject"], cell["scalar"]}, all.size());
        if (is_new) all.push_back({hard["name"], hard["class"], cell["subject"], cell["scalar"]});
        HardCase& c = all[place->second];
        const auto verdict = static_cast<std::size_t>(
            std::ranges::find(hard_verdicts, cell["verdict"].get_ref<const std::string&>()) -
            hard_verdicts.begin());
        const bool failed = cell["failed"].get<bool>();
        if (failed && !extreme.contains(cell["band"])) c.ordinary = true;
        if (is_new || std::pair(failed, verdict) > std::pair(c.failed, c.verdict))
          c.failed = failed, c.verdict = verdict, c.operation = cell["operation"], c.block = cell["block"];
      }
  return all;
}

std::string hard_words(const std::vector<HardCase>& cases, const std::string& subject) {
  const auto of = [&](const HardCase& c) { return subject.empty() || c.subject == subject; };
  const auto all = std::ranges::count_if(cases, of);
  const auto failed = std::ranges::count_if(cases, [&](const HardCase& c) { return of(c) && c.failed; });
  if (all == 0) return "";
  return failed == 0 ? fmt::format("none of {} hard cases fails", all)
                     : fmt::format("{} of {} hard cases fail", failed, all);
}

bool is_wrong_verdict(std::size_t verdict) {
  const std::string_view name = hard_verdicts.at(verdict);
  return name != "stable" && name != "refused" && name != "ill-posed";
}

std::string hard_counts(const std::vector<HardCase>& cases) {
  std::string all;
  for (std::size_t v = 0; v < hard_verdicts.size(); ++v)
    if (const auto n = std::ranges::count(cases, v, &HardCase::verdict); n > 0) {
      const auto failed =
          std::ranges::count_if(cases, [&](const HardCase& c) { return c.verdict == v && c.failed; });
      all += fmt::format("{}{} {}", all.empty() ? "" : ", ", n, hard_verdicts[v]);
      if (failed > 0 && failed < n)
        all += fmt::format(" ({} of them permitted or expected)", n - failed);
      else if (failed == 0 && is_wrong_verdict(v))
        all += " (permitted or expected)";
    }
  return all;
}

std::string FindingText::line(const std::string& name) const {
  const auto at = std::ranges::find(lines, name, [](const auto& one) { return one.first; });
  return at == lines.end() ? "" : at->second;
}

bool FindingText::is_refusal() const {
  return title.find(": refused in ") != title.npos && title.find("lost") == title.npos &&
         title.find("NaN") == title.npos;
}

FindingText parts_of(const std::string& finding) {
  FindingText all;
  std::istringstream lines(finding);
  std::getline(lines, all.title);
  if (const auto at = all.title.find("  "); at != std::string::npos) all.title.erase(0, at + 2);
  for (std::string line; std::getline(lines, line);) {
    const auto end = line.find(' ', 3);  // "   where    theta < 1", with a name of at most 8 letters
    const bool named = line.size() > 12 && line.starts_with("   ") && line[3] != ' ' && end < 12 &&
                       line.find_first_not_of(' ', end) == 12;
    if (named)
      all.lines.emplace_back(line.substr(3, end - 3), line.substr(12));
    else if (line.ends_with("'s own program:"))
      all.lines.emplace_back("program", "");
    else if (!all.lines.empty())
      all.lines.back().second += '\n' + (line.starts_with("            ") ? line.substr(12) : line);
  }
  for (auto& [name, words] : all.lines) {  // without empty lines around a program
    words.erase(0, std::min(words.find_first_not_of('\n'), words.size()));
    words.erase(words.find_last_not_of('\n') + 1);
  }
  return all;
}

}  // namespace liecheck::reports
