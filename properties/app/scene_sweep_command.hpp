#pragma once
// `liecheck scene sweep`, which a report runs too.

#include <record/scene_sweep.hpp>

namespace liecheck::properties {

struct SceneSweepFlags {
  std::vector<std::string> files;  ///< none: the built-in scenes, and the long spins
  SceneSweepOptions options;
  std::string json;
  std::size_t flips = 6;
  bool no_orders = false, no_times = false, no_peers = false;
};

/// Shows its progress, and stops at stop_requested. Throws SceneError, or std::invalid_argument naming what is wrong.
SceneSweepResult run_scene_sweep(const SceneSweepFlags& flags);

}  // namespace liecheck::properties
