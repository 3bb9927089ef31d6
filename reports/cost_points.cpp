#include <reports/cost_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace liecheck::reports {

bool other_flags(const Json& row) {
  return row["subject"].get_ref<const std::string&>().find('@') != std::string::npos;
}

std::vector<CostPoint> cost_points(const Json& cost) {
  std::vector<CostPoint> points;
  for (const Json& row : cost["rows"]) {
    if (row["error"].is_null() || other_flags(row)) continue;
    const Json& latency = row["sets"].back()["latency"];
    points.push_back({row["subject"], row["scalar"], row["operation"], figure(row["error"]),
                      latency.is_null() ? 0 : latency["ns"].get<double>(),
                      !row["dominated_latency"].is_null()});
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
    if (p.operation == operation && !p.dominated && p.latency > 0) front.push_back(&p);
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

}  // namespace liecheck::reports
