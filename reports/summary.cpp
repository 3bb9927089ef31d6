#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <reports/summary.hpp>
#include <set>

namespace liecheck::reports {

double judged(const Json& row) {
  return figure(row["rule"] == "excess" ? row["max_excess"] : row["max_eps"]);
}

namespace {
/// The error divided by the budget; infinite for NaN, Inf and a wrong branch.
double ratio(const Json& row) {
  const double value = judged(row);
  if (!std::isfinite(value) || row["not_finite"] > 0 || row["wrong_branch"] > 0)
    return std::numeric_limits<double>::infinity();
  return value / std::max(row["budget"].get<double>(), std::numeric_limits<double>::min());
}
bool any_hard_case_open(const Merged& merged) {
  for (const Json& record : merged.records)
    for (const Json& hard : list_in(record, "hard_cases"))
      for (const Json& cell : hard["cells"])
        if (cell["verdict"] == "unresolved" || cell.value("open", false)) return true;
  return false;
}
}  // namespace

bool worse(const Json& a, const Json& b) {
  const double ra = ratio(a), rb = ratio(b);
  if (ra != rb) return ra > rb;
  return std::pair(a["not_finite"], a["wrong_branch"]) > std::pair(b["not_finite"], b["wrong_branch"]);
}

std::string word(const Standing& s) {
  return s.failed                  ? "fail"
         : s.open + s.not_measured ? "incomplete"
         : s.passed + s.expected   ? "pass"
                                   : "no verdict";
}

std::string verdict(const Merged& merged) {
  const auto any = [&](const char* word) {
    const auto has = [&](const Json& r) { return r["verdict"] == word; };
    return std::ranges::any_of(merged.records, has) ||
           std::ranges::any_of(merged.measurements,
                               [&](const auto& kind) { return std::ranges::any_of(kind.second, has); });
  };
  if (any("fail")) return "fail";
  const auto all = standings(merged);
  const bool open = any("incomplete") || merged.results.empty() || any_hard_case_open(merged) ||
                    std::any_of(all.begin(), all.end(), [](const Standing& s) {
                      const std::string standing = word(s);
                      return standing == "incomplete" || standing == "no verdict";
                    });
  return open ? "incomplete" : "pass";
}

std::vector<Standing> standings(const Merged& merged) {
  std::vector<Standing> all;
  std::map<std::pair<std::string, std::string>, std::size_t> index;
  const auto of = [&](const std::string& subject, const std::string& scalar) -> Standing& {
    const auto [it, fresh] = index.emplace(std::pair(subject, scalar), all.size());
    if (fresh) all.emplace_back().subject = subject, all.back().scalar = scalar;
    return all[it->second];
  };
  for (const Json& record : merged.records)
    for (const Json& s : record["subjects"]) {
      Standing& standing = of(s["name"], s["scalar"]);
      standing.version = s["version"];
      standing.eps = s["eps"];
      for (const std::string name : s["not_offered"]) standing.not_offered.add(name);
    }
  for (const Json& record : merged.records)
    for (const Json& entry : list_in(record, "not_measured"))
      ++of(entry["subject"], entry["scalar"]).not_measured;
  for (const Json& row : merged.results) {
    Standing& s = of(row["subject"], row["scalar"]);
    const std::string status = row["status"];
    ++(status == "pass"        ? s.passed
       : status == "fail"      ? s.failed
       : status == "expected"  ? s.expected
       : status == "empty"     ? s.empty
       : status == "ill-posed" ? s.ill_posed
                               : s.open);
    s.not_finite += row["not_finite"].get<std::uint64_t>();
    s.wrong_branch += row["wrong_branch"].get<std::uint64_t>();
    const bool was_judged = status == "pass" || status == "fail";
    if (was_judged && (!s.worst || worse(row, *s.worst))) s.worst = &row;
  }
  return all;
}

std::vector<const Json*> worst_offenders(const Merged& merged, std::size_t limit) {
  std::vector<const Json*> failing;
  for (const Json& row : merged.results)
    if (row["status"] == "fail") failing.push_back(&row);
  std::stable_sort(failing.begin(), failing.end(),
                   [](const Json* a, const Json* b) { return worse(*a, *b); });
  std::vector<const Json*> chosen;
  std::set<std::vector<std::string>> seen;
  for (const Json* row : failing) {
    if (chosen.size() == limit) break;
    const Json& r = *row;
    const std::vector<std::string> key = {r["subject"], r["scalar"], r["property"], r["operation"],
                                          r["block"]};
    if (seen.insert(key).second) chosen.push_back(row);
  }
  return chosen;
}

}  // namespace liecheck::reports
