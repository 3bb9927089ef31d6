#pragma once
// What a scene may well not mean, though it can be run.

#include <liecheck/scene/scene.hpp>
#include <liecheck/scene_file/values.hpp>

namespace liecheck::scene_file_detail {

/// Adds a line for each, with the scene's file and line.
void addWarnings(const Text& text, const YAML::Node& root, const scene::Scene& scene,
                 std::vector<std::string>& warnings);

}  // namespace liecheck::scene_file_detail
