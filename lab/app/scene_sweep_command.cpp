#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <integrators/builtin.hpp>
#include <liecheck/scene/integrators/registry.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <results/scenes.hpp>
#include <scenes/stated_truth.hpp>
#include <stdexcept>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>

#include "lab_commands.hpp"

namespace liecheck::properties {

namespace {

struct SceneSweepFlags {
  std::vector<std::string> files;  ///< empty: the built-in scenes, and the long spins
  std::vector<std::string> outside;
  SceneSweepOptions options;
  std::string json;
  bool no_orders = false, no_times = false, no_peers = false, for_report = false;
};

/// Throws std::invalid_argument for an unknown integrator or a wrong number of steps.
SceneSweepOptions options_of(const SceneSweepFlags& f) {
  SceneSweepOptions options = f.options;
  for (const std::string& name : options.integrators) scene::methodInfo(name);
  for (const long n : options.steps)
    if (n % 4 != 0)
      throw std::invalid_argument(
          fmt::format("--steps {}: not a multiple of 4: errors are measured at each quarter", n));
  if (f.no_orders || !options.steps.empty()) options.order_scenes = 0;
  if (f.no_times) options.seconds = 0;
  options.peers = !f.no_peers;
  if (f.for_report) {
    options.order_scenes = 3, options.order_seconds = 6;
    options.longest = 0.004, options.seconds = 12, options.repetitions = 7;
  }
  return options;
}

/// The scenes in the files, or the built-in scenes if there are no files.
std::vector<Benchmark> scenes_of(const std::vector<std::string>& files,
                                 const std::vector<std::string>& outside) {
  if (files.empty()) return builtin_benchmarks();
  std::vector<Benchmark> scenes;
  for (const std::string& file : files) {
    std::vector<std::string> warnings;
    const scene::Scene scene = loadScene(file, &warnings, outside);
    print_warnings(warnings);
    for (const std::string& named : scene.files) keep_files(named, "a file that a scene names");
    stated_truth(scene);
    try {
      scenes.push_back(benchmark_of(scene));
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(file + ": " + e.what());
    }
  }
  return scenes;
}

/// Whether at least one run of liecheck reached the end. Also true if no run was tried.
bool comes_through(const SceneSweep& s) {
  bool tried = s.truth.starts_with("none: ");  // not even the reference did
  for (const SweepSeries& series : s.series)
    if (series.subject == "liecheck")
      for (const SweepPoint& point : series.points) {
        if (point.diverged.empty()) return true;
        tried = true;
      }
  return !tried;
}

/// Prints the scenes on which every run of liecheck diverges. Returns whether there are any.
bool report_lost(const SceneSweepResult& r) {
  bool lost = false;
  for (const SceneSweep& s : r.scenes)
    if (!comes_through(s)) {
      lost = true;
      warn(fmt::format("liecheck: {}: every run diverges: take more steps, or a slower start\n",
                       s.scene.name));
    }
  return lost;
}

std::string error_text(double e) {
  return std::isfinite(e) ? fmt::format("{:.1e}", e) : "-";
}

/// The shortest time [us per simulated second] of a point with at most this error, or "-" if there is none.
std::string time_at(const SweepSeries& s, double error) {
  double best = 0;
  for (const SweepPoint& p : s.points)
    if (p.diverged.empty() && p.time.repetitions > 0 && p.error.leading() <= error &&
        (best == 0 || p.time.median < best))
      best = p.time.median;
  return best > 0 ? fmt::format("{:.3g}", best / 1000) : "-";
}

/// All errors that the scene has, each with its measure.
std::string errors_text(const MotionError& e) {
  std::string text;
  for (const ErrorMeasure& m : error_measures)
    if (!std::isnan(e.*m.of)) text += fmt::format("{}{:.0e} ({})", text.empty() ? "" : ", ", e.*m.of, m.name);
  return text;
}

/// The measure of leading().
const char* leading_measure(const SceneSweep& s) {
  for (const SweepSeries& series : s.series)
    for (const SweepPoint& p : series.points)
      if (!std::isnan(p.error.attitude)) return "attitude";
  return "position";
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
    say("  order of {:<20} exact here\n", row.integrator);
    return;
  }
  const ObservedOrder& o = row.observed;
  say("  order of {:<20} {:>2}: {:>7.3f} over {} halvings in {}, errors {:.1e} to {:.1e}, floor {}{}\n",
      row.integrator, row.promised, o.order, o.halvings, row.scalar, o.halvings ? row.errors[o.first] : 0.0,
      o.halvings ? row.errors[o.first + std::size_t(o.halvings)] : 0.0,
      o.floor ? fmt::format("{:.0e}", *o.floor) : "not reached", o.settled ? "" : "; not settled");
}

void print_scene(const SceneSweep& s) {
  say("\n{}: {}; {} s\n  truth: {}{}\n", s.scene.name, s.scene.what, s.scene.duration, s.truth,
      s.closed           ? ", a closed form"
      : s.series.empty() ? ""
                         : ", which agree to " + errors_text(s.disagreement));
  for (const LeftOut& l : s.left_out) say("  {} cannot run it: {}\n", l.peer, l.why);
  say("  {:<30}{:>9}  {:<44}{:<20}{}\n", "", "smallest",
      fmt::format("µs per simulated s, {} error at most", leading_measure(s)), "energy, error 1e-3",
      "momentum");
  say("  {:<30}{:>9}{:>8}{:>9}{:>9}{:>9}{:>9}  {:>9} {:>8}  {:>9} {:>8}\n", "method", "error", "1e-2", "1e-4",
      "1e-6", "1e-8", "1e-10", "slope/s", "osc.", "slope/s", "osc.");
  for (const SweepSeries& series : s.series) {
    const SweepPoint* p = shown_point(series);
    say("  {:<30}{:>9}{:>8}{:>9}{:>9}{:>9}{:>9}  {}  {}\n",
        series.subject == "liecheck" ? series.integrator : series.subject + " " + series.integrator,
        error_text(series.smallest) + (series.at_floor || std::isinf(series.smallest) ? "" : "+"),
        time_at(series, 1e-2), time_at(series, 1e-4), time_at(series, 1e-6), time_at(series, 1e-8),
        time_at(series, 1e-10), drift_text(p ? p->energy : Drift()), drift_text(p ? p->momentum : Drift()));
    for (const SweepPoint& point : series.points)
      if (!point.diverged.empty()) {
        say("  {:<30}with {} steps: {}\n", "", point.effort.steps, point.diverged);
        break;
      }
  }
  for (const OrderRow& row : s.orders) print_order(row);
}

void print_spins(const SceneSweepResult& r) {
  if (!r.spins.empty()) {
    say("\na triaxial torque-free body, {} turns: attitude error; limit: turns * 2 pi eps = {:.1e} rad\n",
        r.spins[0].turns, r.spins[0].limit);
    for (const LongSpin& s : r.spins)
      say("  {:<10} order {:>2}, {:>4} steps a turn: {:.2e} rad, {:>7.2f} x the limit, {:.2f} s\n",
          s.integrator, s.order, s.steps_per_turn, s.error, s.error / s.limit, s.seconds);
  }
  if (r.flips.empty()) return;
  say("\nDzhanibekov's body, omega0 = (d, 1, d) rad/s: relative error of the times of its flips by "
      "gauss12\n");
  for (const Flips& f : r.flips) {
    say("  d = {:<6.0e} {:<9}", f.perturbation, f.scalar);
    for (double e : f.relative) say(" {:>8}", std::isinf(e) ? "lost" : fmt::format("{:.1e}", e));
    say("  right to 1e-6: {} of {}, until {:.1f} s\n", f.predicted, f.relative.size(), f.horizon);
  }
}

void print_peers(const SceneSweepResult& r) {
  if (r.peers.empty()) return;
  say("\nother simulators: liecheck's time over theirs, at an error that is no larger, by each measure of "
      "the error: the\n"
      "  largest ratio of all their points, with the 95 % confidence interval, and the number of points at "
      "which liecheck\n"
      "  is behind\n");
  for (const PeerComparison& c : r.peers)
    say("  {:<20} {:<28}{:<17}{}{}\n", c.scene, c.peer + " " + c.integrator, c.measure,
        c.ours.empty()
            ? ""
            : fmt::format("{:>6.3f} [{:.3f}, {:.3f}] at {:.1e} by {}, behind at {} of {}{}", c.ratio, c.low,
                          c.high, c.error, c.ours, c.behind, c.points, c.unmatched ? "; " : ""),
        c.unmatched ? "one of its points is more accurate than all of ours" : "");
}

void print_scene_sweep(const SceneSweepResult& r) {
  say("error: the largest error of the attitude [rad] at the ends of the four quarters of the duration, or\n"
      "  of the position [m] if nothing rotates. + means that a smaller step would reduce it.\n"
      "time: time of the fastest run with at most this error [microseconds per simulated second].\n"
      "drift: slope of the least-squares line and largest distance from it, relative to the start.\n");
  for (const std::string& name : absent_peers()) say("{}: absent from this build\n", name);
  for (const SceneSweep& s : r.scenes) print_scene(s);
  print_spins(r);
  print_peers(r);
  say("\n{} scenes in {:.1f} s{}\n", r.scenes.size(), r.elapsed,
      r.complete ? "" : "; interrupted: only what was done");
  for (const std::string& line : r.wrong) say("wrong order: {}\n", line);
}

SceneSweepResult swept(const SceneSweepFlags& f) {
  SceneSweepOptions options = options_of(f);
  options.stop = &stop_requested;
  const std::vector<Benchmark> scenes = scenes_of(f.files, f.outside);
  if (!f.json.empty()) check_writable(f.json);
  stop_on_signals();
  Progress progress("scene sweep");
  options.progress = [&](double share, const std::string& what) { progress.show(share, what); };
  SceneSweepResult r;
  r.for_report = f.for_report;
  r.scenes = sweep_scenes(scenes, options);
  if (!stop_requested) r.peers = compare_peers(r.scenes);
  if (options.order_scenes > 0 && !stop_requested)
    r.wrong = wrong_orders(r.scenes, f.files.empty() ? std::min<std::size_t>(3, options.order_scenes) : 0);
  if (f.files.empty() && options.integrators.empty() && options.steps.empty()) {
    if (!stop_requested) progress.show(0.95, "long spins");
    if (!stop_requested) r.spins = long_spins(1000, &stop_requested);
    if (!stop_requested) r.flips = dzhanibekov_flips(f.for_report ? 3 : 6, &stop_requested);
  }
  r.complete = !stop_requested;
  r.elapsed = progress.elapsed();
  return r;
}

int run(const SceneSweepFlags& f) {
  const SceneSweepResult r = swept(f);
  do_both([&] { write_record_of(f.json, r); }, [&] { print_scene_sweep(r); });
  const bool lost = report_lost(r);
  return !r.complete || lost ? incomplete : r.wrong.empty() ? within_budget : property_failed;
}

}  // namespace

Command scene_sweep_command(CLI::App& scene) {
  CommandWith<SceneSweepFlags> a(
      scene, "sweep",
      "compare integrators and numbers of steps: error against the exact motion, order, drift, time, beside "
      "other "
      "simulators. "
      "Exit code 0; 1 if an order is wrong; 2 for bad input; 3 if stopped or if every run of a scene "
      "diverges");
  a.list("FILE", a->files, "SCENE", "scenes; default the built-in ones, and long spins");
  a.outside(a->outside);
  a.list("--integrator", a->options.integrators, "NAME", "an integrator, repeatable; default all");
  a.numbers("--steps", a->options.steps, 4, 1u << 30,
            "steps over the whole duration, multiples of 4, repeatable; default: doubled until rounding "
            "dominates");
  a.toggle("--no-orders", a->no_orders, "do not measure orders");
  a.toggle("--no-times", a->no_times, "do not measure times");
  a.toggle("--no-peers", a->no_peers, "leave out other simulators");
  a.duration("--for", a->options.seconds, "about how long all timing takes: 30s, 5m; default 20s");
  a.toggle(
      "--for-report", a->for_report,
      "measure as much as 'liecheck report' shows, in about 40 s, with the costs of stages and with films");
  a.json(a->json, "write errors, orders, drift and times to FILE");
  return a.runs(run);
}

}  // namespace liecheck::properties
