#include <fmt/format.h>
#include <app/command.hpp>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <stdexcept>

namespace liecheck::properties {

namespace {

/// The plan of a scene, with the time of each stage measured on this machine.
scene::Plan measured_plan(const scene::Scene& scene) try {
  return scene::plan(scene, true);
} catch (const scene::StepFailed& e) {
  throw std::invalid_argument(scene.source + ": a step from the start fails: " + e.what() +
                              ": take a smaller step or a slower start");
}

struct Flags {
  std::string file;
};

int run(const Flags& f) {
  std::vector<std::string> warnings;
  const scene::Scene scene = loadScene(f.file, &warnings);
  print_warnings(warnings);
  const scene::Plan plan = measured_plan(scene);
  fmt::print("{}: {}\n", scene.name, scene.reason.empty() ? "no reason given" : scene.reason);
  fmt::print("{} of nq {}, nv {}; {} steps of {:g} s by {}, sampled {} times\n\n",
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

}  // namespace

Command scene_explain_command(CLI::App& scene) {
  CommandWith<Flags> a(
      scene, "explain",
      "show the plan of a scene: stages, their times, and what was left out and why. Exit code 0; 2 for bad "
      "input");
  a.text("FILE", a->file, "SCENE", "the scene").required();
  return a.runs(run);
}

}  // namespace liecheck::properties
