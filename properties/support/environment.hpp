#pragma once
// The machine and the compiler that produced a result.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace liecheck::properties {

/// Processor, operating system, compiler with its flags, and C library; documented in docs/record.md.
nlohmann::json environment();

/// environment() as JSON text.
std::string environment_text();

/// The environment and the frequency governor on one line, for a terminal.
std::string environment_line();

/// The frequency governor of the first core, or "unknown" if there is none, as in virtual machines.
std::string frequency_governor();

}  // namespace liecheck::properties
