#pragma once
// The program liecheck-lab beside this one, if it is built (lab/). It has the subjects and the measurements that
// exist for the authors of liecheck.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The path of liecheck-lab; empty if it is not there.
std::string lab_program();

/// If the command line is `lab ARGUMENTS...`, or a campaign, replay, hunt, promise or run of the hard cases with a
/// subject of the laboratory, runs liecheck-lab with these arguments in the place of this program. Returns the exit code
/// if liecheck-lab is not there, and nothing if the command line is another one.
std::optional<int> run_in_lab(int argc, char** argv);

/// The record that liecheck-lab writes to `file` with these arguments and --json; the file is removed. Null if it
/// wrote none. A stop request is passed on to it. Call it only if lab_program() is not empty.
nlohmann::json record_of_lab(std::vector<std::string> arguments, const std::string& file);

}  // namespace liecheck::properties
