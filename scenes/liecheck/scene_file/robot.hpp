#pragma once
// The robot and the initial state of a scene.

#include <liecheck/scene/scene.hpp>
#include <liecheck/scene_file/values.hpp>

namespace liecheck::scene_file_detail {

/// Reads `robot` and `frames` into scene.model. Sets q to neutral, v to 0.
/// Adds the warnings of the URDF to `warnings`.
void readRobot(const Text& text, const YAML::Node& root, scene::Scene& scene,
               std::vector<std::string>& warnings);

/// Reads `initial` into scene.q and scene.v.
void readStart(const Text& text, const YAML::Node& initial, scene::Scene& scene);

}  // namespace liecheck::scene_file_detail
