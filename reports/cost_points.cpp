#include <reports/cost_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace liecheck::reports {

bool other_flags(const Json& row) {
  return row["subject"].get_ref<const std::string&>().find('@') != std::string::npos;
}

bool takes_many(const Json& row) {
  const Json& all = row["sets"].back();
  return all["latency"].is_null() ||
         (row.contains("timed") && row["timed"].get_ref<const std::string&>().ends_with("many"));
}

double error_of_set(const Json& set, double eps) {
  double most = -1;
  for (const Json& b : set["blocks"]) {
    if (b["block"].get_ref<const std::string&>().ends_with("defect")) continue;
    for (const char* outcome : {"not_finite", "wrong_branch", "refused", "unresolved"})
      if (b[outcome] > 0) return std::numeric_limits<double>::infinity();
    if (b["measured"] > 0) most = std::max(most, figure(b["max_eps"]) * eps);
  }
  return most;
}

std::vector<CostPoint> cost_points(const Json& cost, const std::string& set) {
  std::vector<CostPoint> points;
  for (const Json& row : cost["rows"]) {
    if (row["error"].is_null() || other_flags(row)) continue;
    const auto own = set.empty()
                         ? std::prev(row["sets"].end())
                         : std::ranges::find_if(row["sets"], [&](const Json& s) { return s["set"] == set; });
    if (own == row["sets"].end()) continue;
    const double error = set.empty() ? figure(row["error"]) : error_of_set(*own, row["eps"]);
    if (error < 0) continue;
    const auto add = [&](const Json& time, bool dominated, std::size_t batch) {
      points.push_back({row["subject"], row["scalar"], row["operation"], error,
                        time.is_null() ? 0 : time["ns"].get<double>(), row["eps"], dominated, batch});
    };
    const Json &latency = (*own)["latency"], &throughput = (*own)["throughput"];
    const bool many = takes_many(row) && !throughput.is_null();
    if (!many || !latency.is_null()) add(latency, set.empty() && !row["dominated_latency"].is_null(), 1);
    if (many) add(throughput, false, (*own)["inputs"]);
  }
  return points;
}

double digits_of(const CostPoint& p) {
  if (std::isinf(p.error)) return 0;
  return p.error > 0 ? std::max(0.0, -std::log10(p.error)) : std::numeric_limits<double>::infinity();
}

std::vector<CostStep> cost_steps(const std::vector<CostPoint>& points, const std::string& operation) {
  std::vector<const CostPoint*> front;
  for (const CostPoint& p : points)
    if (p.operation == operation && !p.dominated && p.latency > 0 && p.batch == 1) front.push_back(&p);
  std::sort(front.begin(), front.end(), [](auto* a, auto* b) { return a->latency < b->latency; });
  std::vector<CostStep> steps;
  // A step at least halves the error, because a smaller change of a sampled maximum means little. A slower
  // row may have a larger error: if the intervals of two times overlap, neither row dominates.
  const CostPoint* last = nullptr;
  for (const CostPoint* p : front) {
    if (last && !(p->error <= last->error / 2 && p->error < last->error)) continue;
    if (last) steps.push_back({last, p});
    last = p;
  }
  return steps;
}

double shown_digits(const CostPoint& p) {
  return std::min(digits_of(p), -std::log10(p.eps / 2));
}

}  // namespace liecheck::reports
