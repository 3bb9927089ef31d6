#include <campaign/campaign.hpp>

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace liecheck::properties {

namespace {

using nlohmann::json;

json number(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return "inf";
  return x;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line))
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

json environment() {
  utsname u{};
  uname(&u);
  return {{"cpu", processor()},
          {"os", fmt::format("{} {}", u.sysname, u.machine)},
          {"compiler", LIECHECK_COMPILER},
          {"flags", LIECHECK_FLAGS},
          {"fma_contraction", "off"},
          {"libm", fmt::format("glibc {}", gnu_get_libc_version())}};
}

/// DESIGN's table of blocks, as the report prints it.
json blocks() {
  const char* table[][4] = {
      {"rotation", "2 min |Q/|Q| -+ Q_exact|; of a matrix, of its polar factor", "absolute", "rad"},
      {"norm defect", "| |Q|^2 - 1 |", "absolute", "1"},
      {"orthogonality defect", "|R^T R - I|", "absolute", "1"},
      {"rotation vector", "|phi - phi_exact|", "|phi_exact|", "rad"},
      {"translation", "|p - p_exact|", "|p_exact|; integrate: max(|result|, |p0|, |increment|)", "m"},
      {"linear", "|rho - rho_exact|", "|rho_exact|; difference: max(|rho|, |p1 - p0|)", "m"},
      {"jacobian", "|J - J_exact| of the 3x3 rotation block", "|J_exact|", "1"},
      {"coupling", "|C - C_exact| of the 3x3 coupling block", "|C_exact|; beyond pi max(|C|, |rho| min(1, |J|))", "m"},
      {"jump", "|(y+ - y+_exact) - (y- - y-_exact)| over adjacent inputs", "|y_exact|", "1"},
      {"sign", "how far Q0 . Q1 is below zero", "absolute", "1"}};
  json all = json::array();
  for (const auto& b : table) all.push_back({{"block", b[0]}, {"error", b[1]}, {"denominator", b[2]}, {"unit", b[3]}});
  return all;
}

}  // namespace

json record_of(const CampaignResult& r) {
  json subjects_json = json::array(), operations = json::array(), laws = json::array(), rows = json::array();
  std::map<std::pair<std::string, std::string>, std::pair<const Series*, std::set<std::string>>> subjects_seen;
  std::set<std::string> all_operations, properties_seen, operations_seen;
  for (const auto& [series, tally] : r.series)
    for (const Output& o : series->outputs) all_operations.insert(o.operation);
  for (const auto& [series, tally] : r.series) {
    auto& seen = subjects_seen[{series->subject, series->scalar}];
    seen.first = series.get();
    if (properties_seen.insert(series->property).second)
      laws.push_back({{"property", series->property}, {"law", series->law}, {"equation", series->equation},
                      {"source", series->source}});
    for (const auto& [key, row] : tally.rows) {
      const Output& o = series->outputs.at(static_cast<std::size_t>(key.first));
      const Band& b = series->bands()[static_cast<std::size_t>(key.second)];
      const Budget& budget = budget_of(o.operation, o.block, b.region);
      seen.second.insert(o.operation);
      if (operations_seen.insert(o.operation).second)
        operations.push_back({{"operation", o.operation}, {"definition", series->equation}, {"frame", "README, notation"}});
      const CaseId id = series->id(r.options.seed, row.worst_index);
      const bool not_finite = row.not_finite > 0;
      const char* axis = b.axis == Axis::theta ? "theta" : b.axis == Axis::pi_minus_theta ? "pi_minus_theta" : "none";
      rows.push_back(
          {{"subject", series->subject}, {"scalar", series->scalar}, {"property", series->property},
           {"operation", o.operation}, {"block", o.block}, {"band", b.name}, {"axis", axis}, {"low", b.low},
           {"high", b.high}, {"count", row.count}, {"max_eps", not_finite ? json("inf") : number(row.max_error)},
           {"p99_eps", number(row.errors.quantile(0.99))}, {"median_eps", number(row.errors.quantile(0.5))},
           {"max_excess", number(row.max_excess)}, {"budget", budget.limit},
           {"rule", budget.rule == Rule::forward ? "forward" : "excess"}, {"reason", budget.reason},
           {"ill_posed", row.ill_posed}, {"unresolved", row.unresolved}, {"not_finite", row.not_finite},
           {"wrong_branch", row.wrong_branch}, {"refused", row.refused}, {"failed", row.failed},
           {"status", row.failed ? "fail" : row.unresolved ? "unresolved" : row.ill_posed == row.count ? "ill-posed" : "pass"},
           {"worst", {{"id", id.text()}, {"input", series->input(id)}, {"kappa", number(row.worst_kappa)}}}});
    }
  }
  for (const auto& [key, seen] : subjects_seen) {
    std::vector<std::string> not_offered;
    for (const std::string& o : all_operations)
      if (!seen.second.count(o)) not_offered.push_back(o);
    subjects_json.push_back({{"name", key.first}, {"version", seen.first->subject_version}, {"scalar", key.second},
                             {"eps", seen.first->eps}, {"not_offered", not_offered}});
  }
  return {{"version", LIECHECK_VERSION},
          {"generator_version", generator_version},
          {"seed", r.options.seed},
          {"cases", r.options.seconds ? r.total_cases : r.options.cases},
          {"total_cases", r.total_cases},
          {"verdict", r.incomplete ? "incomplete" : r.failed ? "fail" : "pass"},
          {"digest", {{"inputs", r.inputs_digest}, {"results", r.results_digest}}},
          {"robot", {{"name", r.robot.name}, {"hash", r.robot.hash}}},
          {"environment", environment()},
          {"subjects", subjects_json},
          {"absent", absent_subjects()},
          {"blocks", blocks()},
          {"operations", operations},
          {"properties", laws},
          {"results", rows}};
}

}  // namespace liecheck::properties
