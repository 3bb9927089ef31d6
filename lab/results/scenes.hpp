#pragma once
// A sweep of scenes as a record: key "scenes" of a campaign's record, documented in docs/record.md.

#include <integrators/spins.hpp>
#include <integrators/sweep.hpp>
#include <nlohmann/json_fwd.hpp>

namespace liecheck::properties {

/// All that `liecheck-lab scene sweep` measures.
struct SceneSweepResult {
  std::vector<SceneSweep> scenes;
  std::vector<std::string> wrong;  ///< one line for each wrong order
  std::vector<PeerComparison> peers;
  std::vector<LongSpin> spins;
  std::vector<Flips> flips;
  /// Also what the report shows beside the sweep: the costs of stages, and films of motions.
  bool for_report = false;
  bool complete = false;
  double elapsed = 0;  ///< [s]
};

nlohmann::json record_of(const SceneSweepResult& result);

}  // namespace liecheck::properties
