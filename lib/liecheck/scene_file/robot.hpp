#pragma once
// The robot of a scene and where it starts.

#include <liecheck/scene/scene.hpp>
#include <liecheck/scene_file/values.hpp>

namespace liecheck::scene_file_detail {

/// `robot` and `frames`: scene.model, q neutral, v zero. A URDF is looked for in folder.
void readRobot(const Text& text, const YAML::Node& root, const std::string& folder, scene::Scene& scene);

/// `initial`: scene.q, scene.v.
void readStart(const Text& text, const YAML::Node& initial, scene::Scene& scene);

/// What `root` may be.
const std::vector<std::string>& rootNames();

}  // namespace liecheck::scene_file_detail
