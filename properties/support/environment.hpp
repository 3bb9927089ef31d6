#pragma once
// The machine and the compiler behind a result.

#include <string>

namespace liecheck::properties {

/// Processor, operating system, compiler with its flags, and C library, as JSON.
std::string environment_text();

}  // namespace liecheck::properties
