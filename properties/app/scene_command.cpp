#include <app/scene_command.hpp>

#include <fmt/format.h>
#include <app/store_commands.hpp>
#include <cmath>
#include <filesystem>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {
namespace {

using nlohmann::json;

/// Shortest decimal that reads back as the same double.
std::string csv_of(const scene::Run& run) {
  std::string text;
  for (std::size_t i = 0; i < run.columns.size(); ++i)
    text += (i ? "," : "") + csv_field(fmt::format("{} [{}]", run.columns[i].name, run.columns[i].unit));
  text += '\n';
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{}{}", run.rows[i], (i + 1) % run.columns.size() ? ',' : '\n');
  return text;
}

std::string verdict(const scene::Run& run) {
  return run.outcome.diverged ? "diverged" : run.outcome.stopped ? "stopped" : "complete";
}

json json_of(const scene::Scene& scene, const scene::Run& run) {
  json columns = json::array(), rows = json::array(), figures = json::array();
  for (const auto& c : run.columns) columns.push_back({{"name", c.name}, {"unit", c.unit}});
  for (std::size_t i = 0; i + run.columns.size() <= run.rows.size(); i += run.columns.size())
    rows.push_back(
        std::vector<double>(run.rows.begin() + long(i), run.rows.begin() + long(i + run.columns.size())));
  for (const auto& f : run.figures)
    figures.push_back({{"name", f.name}, {"unit", f.unit}, {"value", f.value ? json(*f.value) : json()}});
  return {{"version", LIECHECK_VERSION},
          {"scene", scene.name},
          {"reason", scene.reason},
          {"integrator", scene.integrator},
          {"step", scene.span.duration / double(scene.span.steps)},
          {"verdict", verdict(run)},
          {"why", run.outcome.why},
          {"steps", run.outcome.steps},
          {"of_steps", scene.span.steps},
          {"t", run.outcome.t},
          {"seconds", run.seconds},
          {"columns", columns},
          {"rows", rows},
          {"figures", figures}};
}

void print_figures(const scene::Scene& scene, const scene::Run& run) {
  const double h = scene.span.duration / double(scene.span.steps);
  fmt::print("{}: {} in {} steps of {:g} s by {}, {:.3g} s on one core\n", scene.name,
             fmt::format("{:g} s", run.outcome.t), run.outcome.steps, h, scene.integrator, run.seconds);
  if (run.counts.steps > 0)
    fmt::print("  {} steps of its own, {} rejected, {} iterations\n", run.counts.steps, run.counts.rejected,
               run.counts.iterations);
  for (const auto& f : run.figures)
    fmt::print("  {:<36}{:>24} {}\n", f.name, f.value ? fmt::format("{:.17g}", *f.value) : "-",
               f.unit == "1" ? "" : f.unit);
}

/// Throws std::invalid_argument where two of the scene's files are one.
void check_apart(const std::string& scene, const std::string& csv, const std::string& json) {
  const auto same = [](const std::string& a, const std::string& b) {
    return !a.empty() && !b.empty() &&
           std::filesystem::weakly_canonical(a) == std::filesystem::weakly_canonical(b);
  };
  for (const std::string& output : {csv, json})
    if (same(scene, output))
      throw std::invalid_argument(output + " is the scene itself: give the output another name");
  if (same(csv, json))
    throw std::invalid_argument(csv + " would be the CSV and the JSON: give one another name");
}

}  // namespace

int run_scene_command(const SceneFlags& flags) {
  scene::Scene scene = loadScene(flags.file);
  if (!flags.csv.empty()) scene.csv = flags.csv;
  if (!flags.json.empty()) scene.json = flags.json;
  check_apart(flags.file, scene.csv, scene.json);
  for (const std::string& path : {scene.csv, scene.json})
    if (!path.empty()) check_writable(path);
  std::optional<Progress> progress(std::in_place, scene.name);
  const scene::Run run = scene::run(scene, [&](double share) {
    progress->show(share, [&](double) { return fmt::format("of {:g} s", scene.span.duration); });
    return !stop_requested.load();
  });
  progress.reset();
  print_figures(scene, run);
  if (run.largest_turn > std::numbers::pi)
    fmt::print(stderr,
               "warning: a step turned by {:.3g} rad: beyond half a turn the increments of a step mean "
               "nothing; take "
               "a smaller step\n",
               run.largest_turn);
  if (!scene.csv.empty()) write_whole(scene.csv, csv_of(run));
  if (!scene.json.empty()) write_whole(scene.json, json_of(scene, run).dump(1) + "\n");
  if (run.outcome.diverged) {
    const scene::MethodInfo& method = scene::methodInfo(scene.integrator);
    fmt::print(stderr,
               "liecheck: {}: diverged at step {} of {} (t = {:g} s): {}; what was done until then is kept. "
               "Take {}\n",
               scene.source, run.outcome.steps + 1, scene.span.steps, run.outcome.t, run.outcome.why,
               method.adaptive           ? "another tolerance, or softer effects"
               : method.evaluations == 0 ? "a smaller step"
                                         : "a smaller step, or an implicit method");
  }
  if (run.outcome.stopped)
    fmt::print(stderr, "interrupted at t = {:g} s of {:g} s: what was done until then is kept\n",
               run.outcome.t, scene.span.duration);
  return run.outcome.diverged || run.outcome.stopped ? incomplete : within_budget;
}

int explain_scene_command(const SceneFlags& flags) {
  const scene::Scene scene = loadScene(flags.file);
  const scene::Plan plan = [&] {
    try {
      return scene::plan(scene, true);
    } catch (const scene::StepFailed& e) {
      throw std::invalid_argument(scene.source + ": a step from the start fails: " + e.what() +
                                  ": take a smaller step or a slower start");
    }
  }();
  fmt::print("{}: {}\n", scene.name, scene.reason.empty() ? "no reason given" : scene.reason);
  fmt::print("{} of nq {}, nv {}; {} steps of {:g} s by {}, watched {} times\n\n",
             plan.lone_body ? "a lone rigid body" : "a tree", scene.model.nq, scene.model.nv,
             scene.span.steps, scene.span.duration / double(scene.span.steps), scene.integrator,
             (scene.span.steps + scene.span.every - 1) / scene.span.every + 1);
  fmt::print("{:<34}{:<12}{:>10}  {}\n", "stage", "each", "ns", "because");
  for (const auto& s : plan.stages) {
    fmt::print("{:<34}{:<12}{:>10}  {}\n", s.name, s.when,
               s.nanoseconds ? fmt::format("{:.1f}", *s.nanoseconds) : "-", s.why);
    if (!s.equation.empty()) fmt::print("    {}\n", s.equation);
  }
  fmt::print("\n{:<34}{}\n", "left out", "because");
  for (const auto& l : plan.left_out) fmt::print("{:<34}{}\n", l.name, l.why);
  return within_budget;
}

int scene_keys_command() {
  fmt::print("{}", sceneSchema());
  return within_budget;
}

}  // namespace liecheck::properties
