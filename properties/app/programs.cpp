#include <app/programs.hpp>

namespace liecheck::properties {

const Program liecheck_program{
    "liecheck", "finds the numerical bugs in SE(3) and floating-base code before a robot does",
    [](Commands& c, const std::string& typed_line) {
      const auto campaign = [&](CLI::App& parent) { return campaign_command(parent, typed_line); };
      c.heading("test your library");
      c.add({[&](CLI::App& parent) { return test_command(parent, typed_line); }, list_command});
      c.add_group("adapter", "check the adapter of a library from outside: docs/start.md",
                  {adapter_check_command, adapter_serve_command, adapter_tellings_command});
      c.add({campaign, replay_command, report_command, completion_command});
      c.heading("look closer");
      c.add({hard_cases_command, hunt_command, cost_command, environments_command});
      c.heading("in CI");
      c.add({promise_command, compare_command});
      c.heading("robots and scenes");
      c.add({robot_command});
      c.add_group("scene", "simulate a motion that a file describes: docs/scenes.md",
                  {scene_run_command, scene_explain_command, lab_scene_sweep_command, scene_keys_command});
      c.heading("campaigns on many machines");
      c.add({merge_command, export_command});
      c.heading("laboratory");
      c.add({lab_command});
    }};

}  // namespace liecheck::properties
