#include <fmt/format.h>
#include <app/command.hpp>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <scenes/stated_truth.hpp>
#include <stdexcept>
#include <support/progress.hpp>
#include <support/say.hpp>

namespace liecheck::properties {

namespace {

const char* what_moves(scene::SystemKind kind) {
  switch (kind) {
    case scene::SystemKind::ThrownBody:
      return "a lone rigid body with its translation in closed form";
    case scene::SystemKind::LoneBody:
      return "a lone rigid body";
    case scene::SystemKind::LoneJoint:
      return "one joint";
    default:
      return "a tree";
  }
}

struct SceneExplainFlags {
  std::string file;
  std::vector<std::string> outside;
  bool count = false;
};

void print_plan(const scene::Scene& scene, const scene::Plan& plan) {
  say("{}: {}\n", scene.name, scene.reason.empty() ? "no reason given" : scene.reason);
  const bool adaptive = scene::methodInfo(scene.integrator).adaptive;
  say("{} of nq {}, nv {}; {} {} of {:g} s by {}, sampled {} times\n\n", what_moves(plan.kind),
             scene.model.nq, scene.model.nv, scene.span.steps, adaptive ? "intervals" : "steps",
             scene.span.duration / double(scene.span.steps), scene.integrator,
             (scene.span.steps + scene.span.every - 1) / scene.span.every + 1);
  say("evaluations of the acceleration in {}: {:g}, counted over the first ones\n\n",
             adaptive ? "an interval" : "a step", plan.evaluations);
  say("{:<38} {:<11} {:>9}  {}\n", "stage", "each", "ns", "because");
  for (const auto& s : plan.stages) {
    say("{:<38} {:<11} {:>9}  {}\n", s.name, s.when,
               s.nanoseconds ? fmt::format("{:.1f}", *s.nanoseconds) : "-", s.why);
    if (!s.equation.empty()) say("    {}\n", s.equation);
  }
  say("\n{:<38} {}\n", "left out", "because");
  for (const auto& l : plan.left_out) say("{:<38} {}\n", l.name, l.why);
  std::fflush(stdout);
}

int run(const SceneExplainFlags& f) try {
  std::vector<std::string> warnings;
  const scene::Scene scene = loadScene(f.file, &warnings, f.outside);
  print_warnings(warnings);
  stated_truth(scene);
  Progress progress("counting instructions");
  double stages = 0, counted = 0;
  const scene::Plan plan = scene::plan(
      scene,
      scene::Measuring{
          .every = f.count,
          .seconds = f.count ? 1e9 : 2,
          .timed =
              [&](const scene::Plan& timed) {
                print_plan(scene, timed);
                stages = double(timed.stages.size());
              },
          .counts = [&](const scene::Stage& stage) { progress.show(counted++ / stages, stage.name); }});
  say("\n{:<38} {:<11} {:>12}  {}\n", "stage", "each", "instructions",
             f.count ? "all counted" : "counted in a sample of calls, to about 2 %; --count counts all");
  for (const auto& s : plan.stages)
    say("{:<38} {:<11} {:>12}\n", s.name, s.when,
               s.instructions ? fmt::format("{}", *s.instructions) : "not counted");
  return within_budget;
} catch (const scene::StepFailed& e) {
  throw std::invalid_argument(f.file + ": a step from the start fails: " + e.what() +
                              ": take a smaller step or a slower start");
}

}  // namespace

Command scene_explain_command(CLI::App& scene) {
  CommandWith<SceneExplainFlags> a(
      scene, "explain",
      "show the plan of a scene: stages, their times and instructions, and what was left out and why. Exit "
      "code 0; 2 for bad input");
  a.text("FILE", a->file, "SCENE", "the scene").required();
  a.outside(a->outside);
  a.toggle("--count", a->count,
           "count every instruction, which takes minutes for a large robot, instead of a sample within two "
           "seconds");
  return a.runs(run);
}

}  // namespace liecheck::properties
