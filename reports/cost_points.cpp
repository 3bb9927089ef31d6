#include <reports/cost_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace liecheck::reports {

bool other_flags(const Json& row) {
  return row["subject"].get_ref<const std::string&>().find('@') != std::string::npos;
}

std::vector<CostPoint> cost_points(const Json& cost) {
  const auto median = [](const Json& spread) {
    return spread.is_null() ? 0.0 : spread["median"].get<double>();
  };
  const auto text = [](const Json& name) { return name.is_null() ? std::string() : name.get<std::string>(); };
  std::vector<CostPoint> points;
  for (const Json& row : cost["rows"]) {
    if (row["error"].is_null() || other_flags(row)) continue;
    const Json& all = row["sets"].back();
    points.push_back({row["subject"], row["scalar"], row["operation"], figure(row["error"]),
                      median(all["latency_ns"]), median(all["throughput_ns"]), text(row["dominated_latency"]),
                      text(row["dominated_throughput"])});
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
    if (p.operation == operation && p.dominated_latency.empty() && p.latency > 0) front.push_back(&p);
  std::sort(front.begin(), front.end(), [](auto* a, auto* b) { return a->latency < b->latency; });
  std::vector<CostStep> steps;
  // A step at least halves the error, because a maximum over a sample is not more precise than that. If the
  // intervals of two times overlap, neither row dominates, and the slower row may have the larger error.
  const CostPoint* last = nullptr;
  for (const CostPoint* p : front) {
    if (last && !(p->error <= last->error / 2 && p->error < last->error)) continue;
    if (last) steps.push_back({last, p});
    last = p;
  }
  return steps;
}

std::vector<CostCandidate> cost_candidates(const std::vector<CostPoint>& points,
                                           const std::vector<std::string>& operations) {
  std::vector<CostCandidate> all;
  for (const CostPoint& first : points) {
    CostCandidate c{first.subject, first.scalar, 0, 0};
    if (operations.empty() || first.operation != operations.front()) continue;
    std::size_t offered = 0;
    for (const CostPoint& p : points)
      if (p.subject == c.subject && p.scalar == c.scalar && p.latency > 0 &&
          std::find(operations.begin(), operations.end(), p.operation) != operations.end())
        ++offered, c.error = std::max(c.error, p.error), c.latency += p.latency;
    if (offered == operations.size()) all.push_back(c);
  }
  return all;
}

const CostCandidate* fastest_within(const std::vector<CostCandidate>& all, double error) {
  const CostCandidate* best = nullptr;
  for (const CostCandidate& c : all)
    if (c.error <= error && (!best || c.latency < best->latency)) best = &c;
  return best;
}

const CostCandidate* most_accurate(const std::vector<CostCandidate>& all, const std::string& scalar) {
  const CostCandidate* best = nullptr;
  for (const CostCandidate& c : all)
    if (c.scalar == scalar && (!best || c.error < best->error)) best = &c;
  return best;
}

}  // namespace liecheck::reports
