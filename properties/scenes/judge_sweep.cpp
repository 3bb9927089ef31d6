#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <scenes/sweep.hpp>

namespace liecheck::properties {

std::vector<std::string> wrong_orders(const std::vector<SceneSweep>& all, std::size_t scenes) {
  std::vector<std::string> wrong;
  std::map<std::string, std::size_t> seen;
  for (const SceneSweep& s : all) {
    for (const OrderRow& row : s.orders) {
      auto& count = seen[row.integrator];
      if (row.exact) continue;
      const ObservedOrder& o = row.observed;
      if (!o.settled) continue;  // its steps are too long here, or its errors too close to rounding errors
      if (!(std::abs(o.order - row.promised) <= 0.1))
        wrong.push_back(fmt::format("{} on {}: order {:.3f}, not {}", row.integrator, s.scene.name, o.order,
                                    row.promised));
      else if (s.closed)
        ++count;
    }
  }
  for (const auto& [name, count] : seen)
    if (count < scenes)
      wrong.push_back(
          fmt::format("{}: its order is right on {} scenes with closed forms, not {}", name, count, scenes));
  return wrong;
}

namespace {

/// The shortest time in which liecheck's series reaches an error of at most `error`. Between two points, the
/// time is interpolated (log-log). Returns 0 if no point has so small an error.
double time_for(const SweepSeries& ours, double MotionError::*of, double error) {
  double best = 0;
  const auto offer = [&](double t) { best = best == 0 || t < best ? t : best; };
  const auto usable = [](const SweepPoint& p) { return p.diverged.empty() && p.time.repetitions > 0; };
  for (std::size_t k = 0; k < ours.points.size(); ++k) {
    const SweepPoint& p = ours.points[k];
    if (!usable(p)) continue;
    const double fine = p.error.*of;
    if (fine <= error) offer(p.time.median);
    if (k == 0 || !usable(ours.points[k - 1]) || !(fine > 0) || !(error > 0)) continue;
    const SweepPoint& coarse = ours.points[k - 1];
    const double a = std::log(coarse.error.*of), b = std::log(fine), e = std::log(error);
    if (b <= e && e < a)
      offer(std::exp(std::log(coarse.time.median) +
                     (a - e) / (a - b) * std::log(p.time.median / coarse.time.median)));
  }
  return best;
}

PeerComparison compare(const SceneSweep& s, const SweepSeries& peer, const ErrorMeasure& measure) {
  PeerComparison c{s.scene.name, peer.subject, peer.integrator, measure.name, 0, 0, 0, "", false};
  for (const SweepPoint& p : peer.points) {
    const double error = p.error.*measure.of;
    if (!p.diverged.empty() || p.time.repetitions == 0 || !std::isfinite(error)) continue;
    double best = 0;
    std::string by;
    for (const SweepSeries& ours : s.series) {
      const double t = ours.subject == "liecheck" ? time_for(ours, measure.of, error) : 0;
      if (t > 0 && (best == 0 || t < best)) best = t, by = ours.integrator;
    }
    ++c.points;
    if (best == 0) {
      c.unmatched = true;
    } else if (best / p.time.median > c.ratio) {
      c.ratio = best / p.time.median, c.error = error, c.ours = by;
    }
  }
  return c;
}

}  // namespace

std::vector<PeerComparison> compare_peers(const std::vector<SceneSweep>& all) {
  std::vector<PeerComparison> compared;
  for (const SceneSweep& s : all)
    for (const SweepSeries& peer : s.series)
      if (peer.subject != "liecheck")
        for (const ErrorMeasure& measure : error_measures)
          if (const PeerComparison c = compare(s, peer, measure); c.points > 0) compared.push_back(c);
  return compared;
}

}  // namespace liecheck::properties
