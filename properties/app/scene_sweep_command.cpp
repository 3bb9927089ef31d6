#include <app/scene_sweep_command.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <app/arguments.hpp>
#include <app/commands.hpp>
#include <app/record_file.hpp>
#include <app/scene_sweep_table.hpp>
#include <app/signals.hpp>
#include <chrono>
#include <liecheck/scene/integrators/registry.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <scenes/benchmark.hpp>
#include <stdexcept>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// Throws std::invalid_argument for an unknown integrator or a wrong number of steps.
SceneSweepOptions options_of(const SceneSweepFlags& f) {
  SceneSweepOptions options = f.options;
  options.stop = &stop_requested;
  for (const std::string& name : options.integrators) scene::methodInfo(name);
  for (const long n : options.steps)
    if (n % 4 != 0)
      throw std::invalid_argument(
          fmt::format("--steps {}: not a multiple of 4: errors are measured at each quarter", n));
  if (f.no_orders || !options.steps.empty()) options.order_scenes = 0;
  if (f.no_times) options.seconds = 0;
  options.peers = !f.no_peers;
  return options;
}

/// The scenes in the files, or the built-in scenes if there are no files.
std::vector<Benchmark> scenes_of(const std::vector<std::string>& files) {
  if (files.empty()) return builtin_benchmarks();
  std::vector<Benchmark> scenes;
  for (const std::string& file : files) {
    const scene::Scene scene = loadScene(file);
    try {
      scenes.push_back(benchmark_of(scene));
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(file + ": " + e.what());
    }
  }
  return scenes;
}

/// Whether a run of liecheck reached the end; true if none was tried.
bool comes_through(const SceneSweep& s) {
  bool tried = false;
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
      fmt::print(stderr, "liecheck: {}: every run diverges: take more steps, or a slower start\n",
                 s.scene.name);
    }
  return lost;
}

int run(const SceneSweepFlags& f) {
  stop_on_signals();
  if (!f.json.empty()) check_writable(f.json);
  const SceneSweepResult r = run_scene_sweep(f);
  print_scene_sweep(r);
  if (!f.json.empty()) write_record(f.json, record_of(r));
  const bool lost = report_lost(r);
  return !r.complete || lost ? incomplete : r.wrong.empty() ? within_budget : property_failed;
}

}  // namespace

SceneSweepResult run_scene_sweep(const SceneSweepFlags& f) {
  SceneSweepOptions options = options_of(f);
  const std::vector<Benchmark> scenes = scenes_of(f.files);
  const auto start = std::chrono::steady_clock::now();
  SceneSweepResult r;
  {
    Progress progress("scene sweep");
    options.progress = [&](double share, const std::string& what) {
      progress.show(share, [&](double) { return what; });
    };
    r.scenes = sweep_scenes(scenes, options);
    r.peers = compare_peers(r.scenes);
    if (options.order_scenes > 0)
      r.wrong = wrong_orders(r.scenes, f.files.empty() ? std::min<std::size_t>(3, options.order_scenes) : 0);
    if (f.files.empty() && options.integrators.empty() && options.steps.empty()) {
      if (!stop_requested) progress.show(0.95, [](double) { return "long spins"; });
      if (!stop_requested) r.spins = long_spins();
      if (!stop_requested) r.flips = dzhanibekov_flips(f.flips, &stop_requested);
    }
  }
  r.complete = !stop_requested;
  r.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return r;
}

Command scene_sweep_command(CLI::App& scene) {
  const auto f = std::make_shared<SceneSweepFlags>();
  Arguments a(
      scene, "sweep",
      "integrators x steps: error against the exact motion, order, drift, time, and other simulators. "
      "Exit 0, 1 an order is wrong, 2 bad input, 3 stopped, or every run of a scene diverges");
  a.list("FILE", f->files, "SCENE", "scenes; default the built-in ones, and long spins");
  a.list("--integrator", f->options.integrators, "NAME", "an integrator, repeatable; default all");
  a.numbers("--steps", f->options.steps, 4, 1u << 30,
            "steps over the whole duration, multiples of 4, repeatable; default: doubled until rounding "
            "dominates")
      .once_for_each_value();
  a.toggle("--no-orders", f->no_orders, "do not measure orders");
  a.toggle("--no-times", f->no_times, "do not measure times");
  a.toggle("--no-peers", f->no_peers, "leave out other simulators");
  a.duration("--for", f->options.seconds, "about how long all timing takes: 30s, 5m; default 20s");
  a.text("--json", f->json, "FILE", "write errors, orders, drift and times to FILE");
  return a.command([f] { return run(*f); });
}

}  // namespace liecheck::properties
