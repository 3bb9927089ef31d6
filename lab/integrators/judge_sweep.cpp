#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <integrators/sweep.hpp>
#include <map>

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

/// The shortest time in which liecheck's series reaches an error of at most `error`, without repetitions if
/// no point has so small an error. Between two points, the time is interpolated (log-log). `doubt` is added
/// to its errors.
Spread time_for(const SweepSeries& ours, double MotionError::*of, double error, double doubt) {
  Spread best;
  const auto offer = [&](const Spread& t) {
    if (best.repetitions == 0 || t.median < best.median) best = t;
  };
  const auto usable = [](const SweepPoint& p) { return p.diverged.empty() && p.time.repetitions > 0; };
  for (std::size_t k = 0; k < ours.points.size(); ++k) {
    const SweepPoint& p = ours.points[k];
    if (!usable(p)) continue;
    const double fine = p.error.*of + doubt;
    if (fine <= error) offer(p.time);
    if (k == 0 || !usable(ours.points[k - 1]) || !(fine > 0) || !(error > 0)) continue;
    const SweepPoint& coarse = ours.points[k - 1];
    const double a = std::log(coarse.error.*of + doubt), b = std::log(fine), e = std::log(error);
    if (!(b <= e && e < a)) continue;
    const double share = (a - e) / (a - b);
    const auto between = [&](double from, double to) { return from * std::pow(to / from, share); };
    Spread t = p.time;
    t.median = between(coarse.time.median, t.median);
    t.low = between(coarse.time.low, t.low), t.high = between(coarse.time.high, t.high);
    offer(t);
  }
  return best;
}

PeerComparison compare(const SceneSweep& s, const SweepSeries& peer, const ErrorMeasure& measure) {
  PeerComparison c;
  c.scene = s.scene.name, c.peer = peer.subject, c.integrator = peer.integrator, c.measure = measure.name;
  const double known = s.disagreement.*measure.of, doubt = std::isfinite(known) ? known : 0;
  for (const SweepPoint& p : peer.points) {
    // Errors of 64 eps and less [m, rad, m/s, rad/s] are rounding errors, and count as equal.
    const double error = std::max(p.error.*measure.of, 0x1p-46);
    if (!p.diverged.empty() || p.time.repetitions == 0 || !(error >= 10 * doubt && error <= 1)) continue;
    Spread best;
    std::string by;
    for (const SweepSeries& ours : s.series) {
      if (ours.subject != "liecheck") continue;
      const Spread t = time_for(ours, measure.of, error, doubt);
      if (t.repetitions > 0 && (best.repetitions == 0 || t.median < best.median))
        best = t, by = ours.integrator;
    }
    ++c.points;
    if (best.repetitions == 0) {
      c.unmatched = true;
      continue;
    }
    const double ratio = best.median / p.time.median;
    c.behind += ratio > 1;
    if (ratio > c.ratio)
      c.ratio = ratio, c.low = best.low / p.time.high, c.high = best.high / p.time.low, c.error = error,
      c.ours = by;
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
