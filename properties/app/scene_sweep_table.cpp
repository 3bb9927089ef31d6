#include <app/scene_sweep_table.hpp>

#include <fmt/format.h>
#include <cmath>

namespace liecheck::properties {

namespace {

std::string error_text(double e) {
  return std::isfinite(e) ? fmt::format("{:.1e}", e) : "-";
}

/// The time of the fastest point with an error of at most `error` [us].
std::string time_at(const SweepSeries& s, double error) {
  double best = 0;
  for (const SweepPoint& p : s.points)
    if (p.diverged.empty() && p.time.repetitions > 0 && p.error.leading() <= error &&
        (best == 0 || p.time.median < best))
      best = p.time.median;
  return best > 0 ? fmt::format("{:.3g}", best / 1000) : "-";
}

std::string drift_text(const Drift& d) {
  return d.samples ? fmt::format("{:>9.1e} {:>8.1e}", d.slope, d.oscillation)
                   : fmt::format("{:>9} {:>8}", "-", "-");
}

/// The point whose drift is shown: the first with an error of at most 1e-3, or the most accurate one.
const SweepPoint* shown_point(const SweepSeries& s) {
  const SweepPoint* best = nullptr;
  for (const SweepPoint& p : s.points) {
    if (!p.diverged.empty()) continue;
    if (!best || p.error.leading() < best->error.leading()) best = &p;
    if (p.error.leading() <= 1e-3) return &p;
  }
  return best;
}

void print_order(const OrderRow& row) {
  if (row.exact) {
    fmt::print("  order of {:<20} exact here\n", row.integrator);
    return;
  }
  const ObservedOrder& o = row.observed;
  fmt::print(
      "  order of {:<20} {:>2}: {:>7.3f} over {} halvings in {}, errors {:.1e} to {:.1e}, floor {}{}\n",
      row.integrator, row.promised, o.order, o.halvings, row.scalar, o.halvings ? row.errors[o.first] : 0.0,
      o.halvings ? row.errors[o.first + std::size_t(o.halvings)] : 0.0,
      o.floor ? fmt::format("{:.0e}", *o.floor) : "not reached", o.settled ? "" : "; not settled");
}

void print_scene(const SceneSweep& s) {
  fmt::print("\n{}: {}; {} s\n  truth: {}{}\n", s.scene.name, s.scene.what, s.scene.duration, s.truth,
             s.closed ? ", a closed form" : fmt::format(", which agree to {:.0e}", s.disagreement));
  fmt::print("  {:<30}{:>9}  {:<44}{:<20}{}\n", "", "smallest", "µs for each simulated second, error at most",
             "energy, error 1e-3", "momentum");
  fmt::print("  {:<30}{:>9}{:>8}{:>9}{:>9}{:>9}{:>9}  {:>9} {:>8}  {:>9} {:>8}\n", "method", "error", "1e-2",
             "1e-4", "1e-6", "1e-8", "1e-10", "slope/s", "osc.", "slope/s", "osc.");
  for (const SweepSeries& series : s.series) {
    const SweepPoint* p = shown_point(series);
    fmt::print("  {:<30}{:>9}{:>8}{:>9}{:>9}{:>9}{:>9}  {}  {}\n",
               series.subject == "liecheck" ? series.integrator : series.subject + " " + series.integrator,
               error_text(series.smallest) + (series.at_floor || std::isinf(series.smallest) ? "" : "+"),
               time_at(series, 1e-2), time_at(series, 1e-4), time_at(series, 1e-6), time_at(series, 1e-8),
               time_at(series, 1e-10), drift_text(p ? p->energy : Drift()),
               drift_text(p ? p->momentum : Drift()));
    for (const SweepPoint& point : series.points)
      if (!point.diverged.empty()) {
        fmt::print("  {:<30}with {} steps: {}\n", "", point.effort.steps, point.diverged);
        break;
      }
  }
  for (const OrderRow& row : s.orders) print_order(row);
}

void print_spins(const SceneSweepResult& r) {
  if (!r.spins.empty()) {
    fmt::print(
        "\na triaxial torque-free body, {} turns: attitude error; the limit, turns 2 pi eps, is {:.1e} rad\n",
        r.spins[0].turns, r.spins[0].limit);
    for (const LongSpin& s : r.spins)
      fmt::print("  {:<10} order {:>2}, {:>4} steps a turn: {:.2e} rad, {:>7.2f} x the limit, {:.2f} s\n",
                 s.integrator, s.order, s.steps_per_turn, s.error, s.error / s.limit, s.seconds);
  }
  if (r.flips.empty()) return;
  fmt::print(
      "\nDzhanibekov's body, omega0 = (d, 1, d) rad/s: relative error of the times of its flips by "
      "gauss12\n");
  for (const Flips& f : r.flips) {
    fmt::print("  d = {:<6.0e} {:<9}", f.perturbation, f.scalar);
    for (double e : f.relative) fmt::print(" {:>8}", std::isinf(e) ? "lost" : fmt::format("{:.1e}", e));
    fmt::print("  right to 1e-6: {} of {}, until {:.1f} s\n", f.predicted, f.relative.size(), f.horizon);
  }
}

void print_peers(const SceneSweepResult& r) {
  if (r.peers.empty()) return;
  fmt::print(
      "\nother simulators: the largest ratio of our time to theirs over all their points, at an error that "
      "is no larger\n");
  for (const PeerComparison& c : r.peers)
    fmt::print("  {:<14}{:<32}{:>6.3f} at {:.1e} by {}{}\n", c.scene, c.peer + " " + c.integrator, c.ratio,
               c.error, c.ours, c.unmatched ? "; one of its points is more accurate than all of ours" : "");
}

}  // namespace

void print_scene_sweep(const SceneSweepResult& r) {
  fmt::print(
      "error: the largest at four quarters of the duration, against the exact motion: of the attitude\n"
      "  [rad], or of the position [m] if nothing rotates; + means that a smaller step would reduce it.\n"
      "  Time: of the fastest run with at most this error [microseconds per simulated second].\n"
      "  Drift: relative; slope of the least-squares line, and largest distance from it\n");
  for (const std::string& name : absent_peers()) fmt::print("{}: absent from this build\n", name);
  for (const SceneSweep& s : r.scenes) print_scene(s);
  print_spins(r);
  print_peers(r);
  fmt::print("\n{} scenes in {:.1f} s{}\n", r.scenes.size(), r.elapsed,
             r.complete ? "" : "; interrupted: only what was done");
  for (const std::string& line : r.wrong) fmt::print("wrong order: {}\n", line);
}

}  // namespace liecheck::properties
