#pragma once
// Every command of the program, each in a file of its name. A function adds its command to the program or to
// the group of commands "bench" or "scene".

#include <app/command.hpp>
#include <string>

namespace liecheck::properties {

Command list_command(CLI::App& program);
/// typed_line: the whole command line, quoted for a shell.
Command campaign_command(CLI::App& program, const std::string& typed_line);
Command hard_cases_command(CLI::App& program);
Command hunt_command(CLI::App& program);
Command bench_bugs_command(CLI::App& bench);
Command bench_speed_command(CLI::App& bench);
Command sweep_command(CLI::App& program);
Command robot_command(CLI::App& program);
Command cost_command(CLI::App& program);
Command scene_run_command(CLI::App& scene);
Command scene_explain_command(CLI::App& scene);
Command scene_sweep_command(CLI::App& scene);
Command scene_keys_command(CLI::App& scene);
Command replay_command(CLI::App& program);
Command report_command(CLI::App& program);
Command merge_command(CLI::App& program);
Command export_command(CLI::App& program);
Command compare_command(CLI::App& program);

}  // namespace liecheck::properties
