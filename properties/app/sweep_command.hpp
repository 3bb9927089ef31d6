#pragma once
// `liecheck sweep`: the scalar coefficients at every float, as text and as JSON.

#include <coefficients/sweep.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

struct SweepFlags {
  std::vector<std::string> coefficients;
  std::string json;
  unsigned jobs = 1;
  std::uint32_t stride = 1;
};

/// Shows how far it is, and stops at stop_requested. Throws std::invalid_argument naming a coefficient that is
/// not known, before anything runs.
SweepResult run_sweep(const SweepFlags& flags);

/// `version`, `verdict`, `bound` ("upper" or "lower"), `coefficients`, ...
nlohmann::json sweep_record(const SweepResult& result);

/// Puts it into a campaign's record, whose verdict becomes "fail" where a documented bound is false.
void add_sweep(nlohmann::json& record, const SweepResult& result);

/// The table and the record. 0 every documented bound holds, 1 one does not, 3 stopped early.
int run_sweep_command(const SweepFlags& flags);

}  // namespace liecheck::properties
