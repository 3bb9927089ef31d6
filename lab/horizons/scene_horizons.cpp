// Scenes whose motion has a closed form, over as many steps as a walk has calls.

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <horizons/scene_horizons.hpp>
#include <limits>
#include <mutex>
#include <optional>
#include <integrators/builtin.hpp>
#include <integrators/make_runner.hpp>
#include <scenes/runner.hpp>
#include <scenes/truth.hpp>
#include <support/stop.hpp>
#include <support/threads.hpp>

namespace liecheck::properties {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
/// The step [s]. gauss12 is exact to rounding with it.
constexpr double step = 0x1p-6;
constexpr const char* method = "gauss12";
/// A run is looked at after so many of its 1000 equal parts.
constexpr int looks[] = {1, 3, 10, 32, 100, 316, 1000};

/// | |Q|^2 - 1 | of the free-flyer's or spherical joint's quaternion; 0 if there is none.
double norm_defect(const Benchmark& scene, const Moment& m) {
  const std::size_t first = scene.robot.nv == 6 ? 3 : 0;
  if (scene.robot.nq == scene.robot.nv) return 0;
  oracles::Real sum = -1;
  for (std::size_t i = first; i < first + 4; ++i) sum += m.q[i] * m.q[i];
  return std::fabs(static_cast<double>(sum));
}

Horizon measured(Benchmark scene, std::uint64_t steps, const std::function<void(double)>& progress) {
  const std::uint64_t part = std::max<std::uint64_t>(1, (steps + 999) / 1000);
  scene.duration = static_cast<double>(1000 * part) * step;
  const auto truth = truth_of(scene);
  const auto runner = make_runner(scene, method, "double");
  runner->stop = &stop_requested;
  Horizon h{"liecheck", "double", "scene " + scene.name, {}};
  double norm = 0;
  std::uint64_t parts = 0;
  runner->run({static_cast<long>(1000 * part), 0}, 1000, [&](double t, const Moment& m) {
    norm = larger(norm, norm_defect(scene, m));
    if (std::ranges::count(looks, static_cast<int>(parts)))
      h.points.push_back(
          {parts * part, norm / eps, motion_error(scene.robot, m, truth->at(t)).leading() / eps});
    progress(static_cast<double>(parts++) / 1000);
  });
  fit_growth(h, 1);
  return h;
}

}  // namespace

bool measure_scene_horizons(const HorizonOptions& o, const std::function<void(const Horizon&)>& report) {
  if (!std::ranges::count(o.walks, "scene")) return true;
  if (!std::ranges::count(o.subjects, "liecheck") || !std::ranges::count(o.scalars, "double")) {
    if (o.left_out) o.left_out("scene is a walk of liecheck in double");
    return true;
  }
  std::vector<Benchmark> scenes;
  for (Benchmark& scene : builtin_benchmarks())
    if (const auto truth = truth_of(scene); truth && truth->closed) scenes.push_back(std::move(scene));
  std::vector<std::optional<Horizon>> found(scenes.size());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  run_on_threads(o.jobs, stop, [&] {
    for (std::size_t i = next++; i < scenes.size() && !stop && !stop_requested; i = next++) try {
        found[i] = measured(scenes[i], o.steps, [&](double share) {
          const std::lock_guard lock(mutex);
          if (o.progress) o.progress("liecheck double scene 0", share);
        });
      } catch (const Stopped&) {
      }
  });
  for (const auto& h : found) {
    if (!h) return false;
    report(*h);
  }
  return true;
}

}  // namespace liecheck::properties
