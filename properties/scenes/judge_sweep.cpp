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
      if (o.halvings < 5)
        wrong.push_back(fmt::format("{} on {}: only {} halvings above the floor", row.integrator,
                                    s.scene.name, o.halvings));
      else if (!(std::abs(o.order - row.promised) <= 0.1))
        wrong.push_back(fmt::format("{} on {}: order {:.3f}, not {}", row.integrator, s.scene.name, o.order,
                                    row.promised));
      else if (s.closed)
        ++count;
    }
  }
  for (const auto& [name, count] : seen)
    if (count < scenes)
      wrong.push_back(
          fmt::format("{}: its order is seen on {} scenes with closed forms, not {}", name, count, scenes));
  return wrong;
}

std::vector<PeerComparison> compare_peers(const std::vector<SceneSweep>& all) {
  std::vector<PeerComparison> compared;
  for (const SceneSweep& s : all)
    for (const SweepSeries& peer : s.series) {
      if (peer.subject == "liecheck") continue;
      PeerComparison c{s.scene.name, peer.subject, peer.integrator, 0, 0, 0, "", false};
      for (const SweepPoint& p : peer.points) {
        if (!p.diverged.empty() || p.time.repetitions == 0) continue;
        double best = 0;
        std::string by;
        for (const SweepSeries& ours : s.series)
          if (ours.subject == "liecheck")
            for (const SweepPoint& q : ours.points)
              if (q.diverged.empty() && q.time.repetitions > 0 && q.error.leading() <= p.error.leading() &&
                  (best == 0 || q.time.median < best))
                best = q.time.median, by = ours.integrator;
        ++c.points;
        if (best == 0) {
          c.unmatched = true;
        } else if (best / p.time.median > c.ratio) {
          c.ratio = best / p.time.median, c.error = p.error.leading(), c.ours = by;
        }
      }
      if (c.points > 0) compared.push_back(c);
    }
  return compared;
}

}  // namespace liecheck::properties
