#pragma once
// Runs this program in a process of its own.

#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The standard output of this program with the arguments. If `stop` becomes true, ends the process and returns
/// nothing. Throws std::runtime_error if the process cannot be started, ends with an exit code above `most`, or still runs
/// after longest_s.
std::optional<std::string> output_of_own_process(std::vector<std::string> arguments,
                                                 const std::atomic<bool>& stop,
                                                 double longest_s = std::numeric_limits<double>::infinity(),
                                                 int most = 0);

}  // namespace liecheck::properties
