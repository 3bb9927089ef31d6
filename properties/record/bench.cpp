#include <record/bench.hpp>

#include <algorithm>
#include <support/environment.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {

using nlohmann::json;

namespace {

template <class Condition>
std::size_t count(const std::vector<BugRow>& rows, const Condition& condition) {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), condition));
}

}  // namespace

std::size_t BugBench::bugs() const {
  return rows.size() - alikes();
}
std::size_t BugBench::killed() const {
  return count(rows, [](const BugRow& r) { return !r.alike() && r.killed; });
}
std::size_t BugBench::alikes() const {
  return count(rows, [](const BugRow& r) { return r.alike(); });
}
std::size_t BugBench::refused_alikes() const {
  return count(rows, [](const BugRow& r) { return r.alike() && r.killed; });
}

json record_of(const BugBench& b) {
  json rows = json::array();
  for (const BugRow& row : b.rows) {
    json weaker = json::object();
    for (const auto& [name, seen] : row.weaker_styles) weaker[name] = seen;
    rows.push_back({{"name", row.name},
                    {"fault", row.fault},
                    {"origin", row.origin},
                    {"killed", row.killed},
                    {"by", row.by},
                    {"cases", row.cases},
                    {"seconds", row.seconds},
                    {"weaker_styles", weaker}});
  }
  return {{"version", LIECHECK_VERSION},
          {"seed", b.seed},
          {"scalar", b.scalar},
          {"seconds_each", b.seconds_each},
          {"verdict", !b.complete  ? "incomplete"
                      : b.passed() ? "pass"
                                   : "fail"},
          {"bugs", rows}};
}

json record_of(const SpeedBench& b) {
  json rows = json::array();
  for (const auto& [name, rate] : b.rates) rows.push_back({{"name", name}, {"cases_per_second", rate}});
  return {{"version", LIECHECK_VERSION},
          {"verdict", b.falsified ? "fail" : "pass"},
          {"seed", b.seed},
          {"environment", environment()},
          {"rows", rows},
          {"all_laws", number(b.all_laws)},
          {"tree_laws", number(b.tree_laws)},
          {"exp6_over_rapidcheck", number(b.exp6_over_rapidcheck)},
          {"two_jobs_over_one", number(b.two_jobs_over_one)}};
}

}  // namespace liecheck::properties
