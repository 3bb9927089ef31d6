#pragma once
// The command `league tellings`.

#include <app/command.hpp>

namespace liecheck::properties {

Command league_tellings_command(CLI::App& league);

}  // namespace liecheck::properties
