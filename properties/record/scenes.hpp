#pragma once
// A sweep of scenes as a record: key "scenes" of a campaign's record, documented in docs/record.md.

#include <nlohmann/json_fwd.hpp>
#include <scenes/spins.hpp>
#include <scenes/sweep.hpp>

namespace liecheck::properties {

/// All that `liecheck scene sweep` measures.
struct SceneSweepResult {
  std::vector<SceneSweep> scenes;
  std::vector<std::string> wrong;  ///< one line for each wrong order
  std::vector<PeerComparison> peers;
  std::vector<LongSpin> spins;
  std::vector<Flips> flips;
  bool complete = false;
  double elapsed = 0;  ///< [s]
};

nlohmann::json record_of(const SceneSweepResult& result);

/// Adds the result of a sweep to a campaign's record. Also measures the costs of stages, makes the films that
/// the report shows, and adds both to the record.
void add_scenes(nlohmann::json& record, const SceneSweepResult& result);

}  // namespace liecheck::properties
