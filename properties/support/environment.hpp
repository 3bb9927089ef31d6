#pragma once
// The machine and the compiler behind a result.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace liecheck::properties {

/// Processor, operating system, compiler with its flags, and C library; documented in docs/record.md.
nlohmann::json environment();

/// The same as text.
std::string environment_text();

/// The frequency governor of the first core; "not told" in a virtual machine that has none.
std::string frequency_governor();

}  // namespace liecheck::properties
