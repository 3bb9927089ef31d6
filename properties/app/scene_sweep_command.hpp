#pragma once
// `liecheck scene sweep`, which a report also runs.

#include <record/scene_sweep.hpp>

namespace liecheck::properties {

struct SceneSweepFlags {
  std::vector<std::string> files;  ///< empty: the built-in scenes, and the long spins
  SceneSweepOptions options;
  std::string json;
  std::size_t flips = 6;
  bool no_orders = false, no_times = false, no_peers = false;
};

/// Shows progress, and stops once stop_requested is set. Throws SceneError or std::invalid_argument.
SceneSweepResult run_scene_sweep(const SceneSweepFlags& flags);

}  // namespace liecheck::properties
