#include <integrators/make_runner.hpp>
#include <integrators/sweep.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <integrators/reference.hpp>
#include <liecheck/scene/integrators/registry.hpp>
#include <limits>
#include <timing/benchmarks.hpp>

namespace liecheck::properties {
namespace {

constexpr long quarters = 4;

/// Processor time of this thread [s]: a busy machine must not shorten what is measured.
double processor_time() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}
double since(double start) {
  return processor_time() - start;
}

MotionError error_of_run(Runner& runner, const Benchmark& s, const Reference& exact, const Effort& effort,
                         long* made) {
  MotionError worst = MotionError::none();
  std::size_t k = 0;
  *made = runner.run(effort, quarters, [&](double, const Moment& m) {
    if (k > 0) worst.take_larger(motion_error(s.robot, m, exact.at[k]));
    ++k;
  });
  return worst;
}

/// The number of steps of the coarsest run: at least 16, and one per radian at the fastest initial rate. For
/// orders above 8: at least 4, and one per three radians. At most 4096.
long first_steps(const Benchmark& s, int order) {
  double fastest = s.v0.size() ? s.v0.cwiseAbs().maxCoeff() : 0;
  long n = order > 8 ? quarters : 16;
  while (double(n) < fastest * s.duration / (order > 8 ? 3 : 1) && n < 4096) n *= 2;
  return n;
}

struct Measured {
  SweepPoint point;
  double seconds = 0;
};

Measured measure(Runner& runner, const Benchmark& s, const Reference& exact, const Effort& effort) {
  Measured m;
  m.point.effort = effort;
  try {
    const double start = processor_time();
    runner.pass(effort);
    m.seconds = since(start);
    m.point.error = error_of_run(runner, s, exact, effort, &m.point.steps);
    const long per_quarter = std::max(1L, std::min(32L, effort.steps / quarters));
    long parts = per_quarter;  // the largest divisor of a quarter's steps up to per_quarter
    while ((effort.steps / quarters) % parts != 0) --parts;
    if (effort.tolerance == 0) {
      const Drifts drifts = drifts_of(runner, s, effort, quarters * parts);
      m.point.energy = drifts.energy, m.point.momentum = drifts.momentum;
    }
    if (!std::isfinite(m.point.error.leading())) m.point.diverged = "the error is not a number";
  } catch (const Diverged& e) {
    m.point.diverged = e.what();
    m.point.error = MotionError::none();
  }
  return m;
}

/// The points of one method, from coarse to fine, with their runner.
struct Line {
  SweepSeries series;
  std::shared_ptr<Runner> runner;
  std::vector<bool> timed;
};

void measure_line(Line& line, const Benchmark& s, const Reference& exact, const SceneSweepOptions& o,
                  double longest) {
  std::vector<Effort> asked;
  if (line.series.adaptive) {
    for (double tolerance = 1e-2; tolerance > 1e-14; tolerance /= 10) asked.push_back({quarters, tolerance});
  } else if (!o.steps.empty()) {
    for (long n : o.steps) asked.push_back({n, 0});
  } else {
    for (long n = first_steps(s, line.series.order); n <= 1L << 20; n *= 2) asked.push_back({n, 0});
  }
  line.runner->stop = o.stop;
  double& smallest = line.series.smallest = std::numeric_limits<double>::infinity();
  int no_better = 0;
  for (const Effort& effort : asked) {
    const Measured m = measure(*line.runner, s, exact, effort);
    line.series.points.push_back(m.point);
    line.timed.push_back(m.point.diverged.empty() && m.seconds <= longest);
    if (m.point.diverged.empty()) {
      const double e = m.point.error.leading();
      no_better = e < 0.7 * smallest ? 0 : no_better + 1;
      smallest = std::min(smallest, e);
      if (no_better >= 2 && (smallest < 1e-6 || smallest < 10 * exact.disagreement.leading()))
        line.series.at_floor = true;
    }
    if (o.steps.empty() && (line.series.at_floor || m.seconds > longest)) break;
  }
}

/// Adds a line for each method of a peer, or says why the peer cannot run the scene.
void add_peer(const Peer& peer, const Benchmark& s, std::vector<Line>& lines,
              std::vector<LeftOut>& left_out) try {
  if (const std::string why = peer.why_not(s); !why.empty()) throw std::invalid_argument(why);
  for (const PeerMethod& m : peer.methods(s))
    lines.push_back(
        {{peer.name, peer.version, m.name, m.order, m.adaptive, {}, 0, false}, peer.make(s, m.name), {}});
} catch (const std::invalid_argument& e) {
  left_out.push_back({peer.name, e.what()});
}

OrderRow measure_order(const Benchmark& s, const Reference& exact, const scene::MethodInfo& method,
                       const SceneSweepOptions& o) {
  OrderRow row{method.name, method.order >= 4 ? "float128" : "double", method.order, false, {}, {}, {}};
  const double eps = row.scalar == "double" ? 0x1p-52 : 0x1p-112;
  const auto runner = make_runner(s, method.name, row.scalar);
  runner->stop = o.stop;
  const double start = processor_time();
  for (long n = first_steps(s, method.order); n <= 1L << 18; n *= 2) {
    long made = 0;
    double error = std::numeric_limits<double>::infinity();
    try {
      error = error_of_run(*runner, s, exact, {n, 0}, &made).leading();
    } catch (const Diverged&) {  // the step is too long
    }
    row.errors.push_back(error), row.steps.push_back(n);
    if (row.errors.size() == 2 && std::max(row.errors[0], row.errors[1]) < 1e4 * eps) {
      row.exact = true;
      return row;
    }
    row.observed = observe_order(row.errors, method.order, 5, eps);
    if (row.observed.settled || row.observed.floor || error < 100 * eps || since(start) > o.order_seconds)
      break;
  }
  return row;
}

/// Times every run that is short enough, as nanoseconds per simulated second.
void measure_times(std::vector<Line>& lines, double duration, const Interleaving& how) {
  std::vector<Timed> timed;
  std::vector<SweepPoint*> points;
  for (Line& line : lines) {
    line.runner->stop = nullptr;  // a timed run is short
    for (std::size_t k = 0; k < line.series.points.size(); ++k) {
      if (!line.timed[k]) continue;
      SweepPoint& p = line.series.points[k];
      timed.push_back({[runner = line.runner, &p] {
                         try {
                           runner->pass(p.effort);
                         } catch (const Diverged& e) {
                           p.diverged = e.what();
                         }
                       },
                       1});
      points.push_back(&p);
    }
  }
  auto repetitions = run_interleaved(timed, how);
  keep_undisturbed(repetitions);
  for (std::size_t k = 0; k < timed.size(); ++k) {
    std::vector<double> times;
    for (const Repetition& r : repetitions[k]) times.push_back(r.ns / duration);
    points[k]->time = spread_of(times);
  }
}

}  // namespace

std::vector<SceneSweep> sweep_scenes(const std::vector<Benchmark>& scenes, const SceneSweepOptions& o) {
  for (const std::string& name : o.integrators) scene::methodInfo(name);
  const auto runs = [&](const scene::MethodInfo& m, const Benchmark& s) {
    const bool wanted = o.integrators.empty() || std::ranges::count(o.integrators, m.name);
    return wanted && (!m.lone_body_only || scene::LoneBody<double>::fits(s.robot));
  };
  const auto stopped = [&] { return o.stop && *o.stop; };
  std::vector<SceneSweep> all;
  std::map<std::string, std::size_t> shown;  // closed forms on which a method's order was settled
  for (std::size_t i = 0; i < scenes.size() && !stopped(); ++i) {
    const Benchmark& s = scenes[i];
    const auto progress = [&](double share, const std::string& what) {
      o.progress((double(i) + share) / double(scenes.size()), s.name + ", " + what);
    };
    SceneSweep sweep{s, "", false, {}, {}, {}, {}};
    std::vector<Line> lines;
    try {
      const Reference exact =
          reference_of(s, quarters, o.stop, [&](const std::string& what) { progress(0, what); });
      sweep.truth = exact.name, sweep.closed = exact.closed, sweep.disagreement = exact.disagreement;
      for (const scene::MethodInfo& m : scene::methodInfos())
        if (runs(m, s))
          lines.push_back({{"liecheck", "", m.name, m.order, m.adaptive, {}, 0, false},
                           make_runner(s, m.name, "double"),
                           {}});
      if (o.peers)
        for (const Peer& peer : peers()) add_peer(peer, s, lines, sweep.left_out);
      const double longest =
          std::max(o.longest, o.seconds / double(4 * scenes.size() * lines.size() * o.repetitions));
      for (Line& line : lines) {
        progress(0.5 * double(&line - lines.data()) / double(lines.size()), line.series.integrator);
        measure_line(line, s, exact, o, longest);
      }
      if (exact.closed || exact.disagreement.leading() < 1e-30)
        for (const scene::MethodInfo& m : scene::methodInfos()) {
          if (!runs(m, s) || shown[m.name] >= o.order_scenes) continue;
          progress(0.5, std::string("order of ") + m.name);
          sweep.orders.push_back(measure_order(s, exact, m, o));
          shown[m.name] += exact.closed && sweep.orders.back().observed.settled;
        }
      if (o.seconds > 0)
        measure_times(lines, s.duration,
                      {o.seconds / double(scenes.size()), o.repetitions, o.stop,
                       [&](double share) { progress(0.6 + 0.4 * share, "times"); }});
    } catch (const Stopped&) {     // what was measured before is kept
    } catch (const Diverged& e) {  // of the reference
      sweep.truth = std::string("none: ") + e.what();
    }
    for (Line& line : lines)
      if (!line.series.points.empty()) sweep.series.push_back(std::move(line.series));
    if (!sweep.series.empty() || !stopped()) all.push_back(std::move(sweep));
  }
  return all;
}

}  // namespace liecheck::properties
