#include <fmt/format.h>
#include <algorithm>
#include <app/command.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <numbers>
#include <record/record.hpp>
#include <scenes/stated_truth.hpp>
#include <stdexcept>
#include <support/files.hpp>
#include <support/folder.hpp>
#include <support/progress.hpp>
#include <support/say.hpp>
#include <support/stop.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

struct SceneRunFlags {
  std::string file;
  std::string csv, json;  ///< replace the files that the scene names
  std::string checkpoint, resume;
  std::vector<std::string> outside;
  bool no_estimate = false;
};

std::string head_of(const std::vector<scene::Column>& columns) {
  std::string text;
  for (const auto& c : columns)
    text += (text.empty() ? "" : ",") + csv_field(fmt::format("{} [{}]", c.name, c.unit));
  return text + '\n';
}

/// The samples. Each number is the shortest decimal that reads back as the same double.
std::string csv_of(const scene::Run& run) {
  std::string text = head_of(run.columns);
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    text += fmt::format("{}{}", run.rows[i], (i + 1) % run.columns.size() ? ',' : '\n');
  return text;
}

void print_figures(const scene::Scene& scene, const scene::Run& run) {
  const double h = scene.span.duration / double(scene.span.steps);
  say("{}: {:g} s in {} {} of {:g} s by {}, {:.3g} s on one core\n", scene.name, run.outcome.t,
      run.outcome.steps, scene::methodInfo(scene.integrator).adaptive ? "intervals" : "steps", h,
      scene.integrator, run.seconds);
  if (run.counts.steps > 0)
    say("  {} steps of the method, {} rejected, {} iterations\n", run.counts.steps, run.counts.rejected,
        run.counts.iterations);
  if (run.outcome.events > 0)
    say("  events of contacts, limits or clamps that were located: {}\n", run.outcome.events);
  if (run.outcome.phases.count > 0)
    say("  shorter steps after events, where forces change within a step: {}, the shortest {:.2g} s\n",
        run.outcome.phases.count, run.outcome.phases.shortest);
  if (run.outcome.zeno)
    say("  more than {} events in the step from t = {:g} s (Zeno behaviour): the rest of such a step is "
        "taken without locating them\n",
        scene::methodInfo(scene.integrator).adaptive ? 10000 : 32, *run.outcome.zeno);
  for (const auto& f : run.figures)
    say("  {:<36}{:>24} {}\n", f.name, f.value ? fmt::format("{:.17g}", *f.value) : "-",
        f.unit == "1" ? "" : f.unit);
}

/// Prints the estimated error and what it covers.
void print_estimate(const scene::Estimate& e) {
  const auto row = [](const char* name, double error, double accepted, const char* unit) {
    if (!std::isnan(error))
      say("  {:<36}{:>24.3g} {}{}\n", fmt::format("estimated error, {}", name), error, unit,
          accepted > 0 ? fmt::format(", accepted {:.3g}", accepted) : "");
  };
  row("positions", e.error.position, e.accepted.position, "m");
  row("angles", e.error.angle, e.accepted.angle, "rad");
  row("linear velocities", e.error.linear_velocity, 0, "m/s");
  row("angular velocities", e.error.angular_velocity, 0, "rad/s");
  if (std::isnan(e.error.position) && std::isnan(e.error.angle))
    say("  {:<36}{:>24}\n", "estimated error", "not measured");
  // No method has an order below 1; half of it allows for events.
  say("    by runs with {}, compared at {} states, for {:.0f} % of the run's steps; {}\n", e.by,
      e.checkpoints, 100 * e.cost,
      e.order && *e.order > 0.5 ? fmt::format("order observed: {:.2g}", *e.order)
                                : "no order observed: rounding errors or events prevail");
}

/// Prints the errors of the last state against the closed form that the scene names. Returns false if one exceeds what the
/// scene accepts.
bool print_truth(const scene::Scene& scene, const scene::Run& run, const Truth& truth) {
  const auto exact = [](const VectorX<double>& x) { return std::vector<oracles::Real>(x.begin(), x.end()); };
  const MotionError e = motion_error(scene.model, {exact(run.q), exact(run.v)}, truth.at(run.outcome.t));
  const char* const units[] = {"rad", "m", "rad/s", "m/s"};
  for (std::size_t i = 0; i < std::size(error_measures); ++i)
    if (const double x = e.*error_measures[i].of; !std::isnan(x))
      say("  {:<36}{:>24.3g} {}\n", fmt::format("error at the end, {}", error_measures[i].name), x, units[i]);
  say("    beside the closed form '{}'{}\n", scene.truth,
      run.outcome.t < scene.span.duration * (1 - 1e-9)
          ? fmt::format(" at t = {:g} s, where the run ended; the scene lasts {:g} s", run.outcome.t,
                        scene.span.duration)
          : "");
  if (!run.estimate) return true;
  const scene::StateError& accepted = run.estimate->accepted;
  return !(e.attitude > accepted.angle) && !(e.position > accepted.position);
}

/// Prints each alarm and the notice on stderr.
void print_alarms(const scene::Scene& scene, const scene::Estimate& e) {
  for (const scene::Alarm& a : e.alarms)
    warn(fmt::format("liecheck: {}: at t = {:g} s {}: {}: {}\n", scene.source, a.t, a.what, a.cause,
                     a.remedy));
  if (!e.notice.empty()) warn(fmt::format("note: {}: {}\n", scene.source, e.notice));
}

/// Prints on stderr why the run ended early, and what may help.
void print_early_end(const scene::Scene& scene, const scene::Run& run) {
  if (run.outcome.diverged) {
    const scene::MethodInfo& method = scene::methodInfo(scene.integrator);
    warn(
        fmt::format("liecheck: {}: diverged at step {} of {} (t = {:g} s): {}; the samples until then are "
                    "saved. Take {}\n",
                    scene.source, run.outcome.steps + 1, scene.span.steps, run.outcome.t, run.outcome.why,
                    method.adaptive ? "another tolerance, or softer effects"
                                    : "a smaller step, or radau5, which chooses its steps and is L-stable"));
  }
  if (run.outcome.stopped)
    warn(fmt::format("interrupted at t = {:g} s of {:g} s: the samples until then are saved\n", run.outcome.t,
                     scene.span.duration));
}

/// Throws std::invalid_argument unless an output that the scene names, and no flag, has the ending of its kind, is in the
/// working folder, is not hidden, and is new or begins as this command's outputs do.
void check_own_output(const scene::Scene& scene, const char* key, const std::string& file,
                      std::string_view begin) {
  if (file.empty()) return;
  namespace fs = std::filesystem;
  const auto refuse = [&](const char* why) {
    throw std::invalid_argument(fmt::format("{}: output.{}: '{}' {} --{} FILE writes to any file",
                                            scene.source, key, file, why, key));
  };
  std::error_code error;
  if (!is_inside(".", file)) refuse("is outside of the working folder:");
  const fs::path real = fs::weakly_canonical(fs::absolute(file), error), here = fs::canonical(".", error);
  if (real.extension() != std::string(".") + key) refuse("has another ending than its kind:");
  if (("/" + real.lexically_relative(here).string()).find("/.") != std::string::npos) refuse("is hidden:");
  if (!fs::exists(real, error)) return;
  std::string first(begin.size(), '\0');
  if (!fs::is_regular_file(real, error) ||
      !std::ifstream(real).read(first.data(), static_cast<std::streamsize>(first.size())) || first != begin)
    refuse("exists, and no run of this scene as it is now wrote it: remove it, or");
}

/// Throws std::invalid_argument if two of the three files are the same.
void check_apart(const std::string& csv, const std::string& json, const std::string& checkpoint) {
  if (same_file(csv, json))
    throw std::invalid_argument(csv + " would be the CSV and the JSON: give one another name");
  for (const std::string& output : {csv, json})
    if (same_file(output, checkpoint))
      throw std::invalid_argument(output + " would be the samples and the checkpoint: give one another name");
}

/// The run in a checkpoint. Throws std::invalid_argument naming the file if it is not one of this scene.
scene::SavedRun saved_run(const std::string& file, const scene::Scene& scene) try {
  return scene::savedRunOf(read_whole(file), scene);
} catch (const std::invalid_argument& e) {
  throw std::invalid_argument(file + ": " + e.what());
}

int run(const SceneRunFlags& flags) {
  std::vector<std::string> warnings;
  scene::Scene scene = loadScene(flags.file, &warnings, flags.outside);
  print_warnings(warnings);
  for (const std::string& file : scene.files) keep_files(file, "a file that the scene names");
  if (flags.csv.empty() && !scene.csv.empty())
    check_own_output(scene, "csv", scene.csv, head_of(scene::columnsOf(scene)));
  if (flags.json.empty())
    check_own_output(scene, "json", scene.json, "{\n \"columns\": [\n  {\n   \"name\": \"t\",");
  if (!flags.csv.empty()) scene.csv = flags.csv;
  if (!flags.json.empty()) scene.json = flags.json;
  check_apart(scene.csv, scene.json, flags.checkpoint);
  const std::optional<Truth> truth = stated_truth(scene);
  std::optional<scene::SavedRun> from;
  if (!flags.resume.empty()) from = saved_run(flags.resume, scene);
  double saved = -1;  // the time of the last checkpoint [s]
  scene::Saving saving;
  if (from) saving.from = &*from;
  if (!flags.checkpoint.empty())
    saving.save = [&](const scene::SavedRun& run) {
      write_whole(flags.checkpoint, scene::textOf(run));
      saved = run.last.t;
    };
  stop_on_signals();
  for (const std::string& path : {scene.csv, scene.json, flags.checkpoint})
    if (!path.empty()) check_writable(path);
  std::optional<Progress> progress(std::in_place, scene.name);
  const auto goes_on = [&](double share) {
    progress->show(share, [&](double) {
      return fmt::format("of {:g} s{}", scene.span.duration,
                         share < 1 ? "" : "; now the estimate of its error");
    });
    return !stop_requested.load();
  };
  const scene::Run run = [&] {
    try {
      return scene::run(scene, goes_on, !flags.no_estimate, saving);
    } catch (const std::logic_error& e) {  // a state or a method's memory that no run of the scene has
      if (!from) throw;
      throw std::invalid_argument(flags.resume + ": " + e.what());
    } catch (const scene::StepFailed& e) {
      if (!from) throw;
      throw std::invalid_argument(flags.resume + ": " + e.what());
    }
  }();
  progress.reset();
  const auto write_csv = [&] {
    if (!scene.csv.empty()) write_whole(scene.csv, csv_of(run));
  };
  bool right = true;
  do_both([&] { do_both(write_csv, [&] { write_record_of(scene.json, scene, run); }); },
          [&] {
            print_figures(scene, run);
            if (run.estimate) print_estimate(*run.estimate);
            if (truth) right = print_truth(scene, run, *truth);
          });
  if (run.largest_turn > std::numbers::pi)
    warn(
        fmt::format("warning: a step rotated by {:.3g} rad: beyond pi its result is meaningless; take a "
                    "smaller step\n",
                    run.largest_turn));
  if (!flags.checkpoint.empty() && saved < run.outcome.t)
    warn(fmt::format(
        "warning: {} holds {}: no later state of {}, which uses Newton's method, can be resumed with "
        "the same bits\n",
        flags.checkpoint, saved < 0 ? "nothing" : fmt::format("the state at t = {:g} s", saved),
        scene.integrator));
  print_early_end(scene, run);
  if (run.estimate) print_alarms(scene, *run.estimate);
  if (run.outcome.diverged || run.outcome.stopped) return incomplete;
  if (!right)
    warn(fmt::format("liecheck: {}: the error beside the closed form exceeds what the scene accepts\n",
                     scene.source));
  const bool alarmed = run.largest_turn > std::numbers::pi || (run.estimate && !run.estimate->alarms.empty());
  return !right || alarmed ? property_failed : within_budget;
}

}  // namespace

Command scene_run_command(CLI::App& scene) {
  CommandWith<SceneRunFlags> a(
      scene, "run",
      "simulate a scene. Exit code 0; 1 if its estimated error is too large or a conserved "
      "quantity changes; 2 for bad input; 3 if it diverged or was stopped, with the samples until then "
      "saved");
  a.text("FILE", a->file, "SCENE", "the scene").required();
  a.output("--csv", a->csv, "FILE", "write the samples to FILE, not to the scene's file");
  a.updated(
      "--checkpoint", a->checkpoint, "FILE",
      "save the run to FILE about once a second and at its end or stop; not with quaternion_norm or flips");
  a.updated("--resume", a->resume, "FILE",
            "continue the run of the checkpoint FILE, to the same bits as the whole run");
  a.outside(a->outside);
  a.toggle("--no-estimate", a->no_estimate, "leave out the estimate of the error");
  a.json(a->json, "write samples and figures to FILE, not to the scene's file");
  return a.runs(run);
}

}  // namespace liecheck::properties
