// The program liecheck-lab: what measures liecheck itself, or exists for its authors.

#include <app/programs.hpp>

#include "lab_commands.hpp"

namespace liecheck::properties {
namespace {

const Program lab_program_of_authors{
    "liecheck-lab", "measures liecheck itself, the harness and the field",
    [](Commands& c, const std::string& typed_line) {
      const auto campaign = [&](CLI::App& parent) { return campaign_command(parent, typed_line); };
      c.heading("its subjects: known bugs, bugs of real libraries, correct implementations");
      c.add({list_command, campaign, replay_command, hard_cases_command, hunt_command, promise_command,
             completion_command});
      // The program runs itself with `adapter serve`, to call a shared library in a process of its own.
      c.add_group("adapter", "check the adapter of a library from outside: docs/start.md",
                  {adapter_check_command, adapter_serve_command});
      c.heading("what the laws find, and whom they accuse");
      c.add({bugs_command, history_command, lattice_command, limits_command});
      c.heading("liecheck's own errors");
      c.add({sweep_command, bounds_command, rounding_command, horizons_command});
      c.add_group("scene", "integrators against exact motions: docs/scenes.md", {scene_sweep_command});
      c.heading("what accuracy costs, also in scalars wider than double; speed of the harness");
      c.add({cost_command, speed_command, wire_command});
      c.heading("the field");
      c.add_with("league", league_command,
                 {league_findings_command, league_changes_command, league_measure_command});
    }};

}  // namespace
}  // namespace liecheck::properties

int main(int argc, char** argv) {
  return liecheck::properties::run_main(argc, argv, liecheck::properties::lab_program_of_authors);
}
