#pragma once
// The commands of the laboratory, each in a file of its name.

#include <app/command.hpp>

namespace liecheck::properties {

Command bounds_command(CLI::App& lab);
Command bugs_command(CLI::App& lab);
Command history_command(CLI::App& lab);
Command horizons_command(CLI::App& lab);
Command lattice_command(CLI::App& lab);
Command limits_command(CLI::App& lab);
Command rounding_command(CLI::App& lab);
Command scene_sweep_command(CLI::App& scene);
Command speed_command(CLI::App& lab);
Command sweep_command(CLI::App& lab);
Command wire_command(CLI::App& lab);
Command league_command(CLI::App& lab);
Command league_changes_command(CLI::App& league);
Command league_findings_command(CLI::App& league);
Command league_measure_command(CLI::App& league);

}  // namespace liecheck::properties
