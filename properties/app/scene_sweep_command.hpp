#pragma once
// `liecheck scene sweep`: integrators x steps -> error, order, drift and time, as text and as JSON.

#include <nlohmann/json_fwd.hpp>
#include <scenes/spins.hpp>
#include <scenes/sweep.hpp>

namespace liecheck::properties {

struct SceneSweepFlags {
  std::vector<std::string> files;  ///< none: the built-in scenes, and the long spins
  SceneSweepOptions options;
  std::string json;
  std::size_t flips = 6;
  bool no_orders = false, no_times = false, no_peers = false;
};

struct SceneSweepResult {
  std::vector<SceneSweep> scenes;
  std::vector<std::string> wrong;  ///< orders that are not what was promised
  std::vector<PeerComparison> peers;
  std::vector<LongSpin> spins;
  std::vector<Flips> flips;
  bool complete = false;
  double elapsed = 0;  ///< [s]
};

/// Shows how far it is, and stops at stop_requested. Throws SceneError, or std::invalid_argument naming what is wrong.
SceneSweepResult run_scene_sweep(const SceneSweepFlags& flags);

/// Documented in the README.
nlohmann::json scene_sweep_record(const SceneSweepResult& result);
/// `scenes` of a campaign's record, with costs and motions (scene_show.hpp).
void add_scene_sweep(nlohmann::json& record, const SceneSweepResult& result);

/// The tables and the record. 0; 1 where an order is not what was promised; 3 where it was stopped.
int run_scene_sweep_command(const SceneSweepFlags& flags);

}  // namespace liecheck::properties
