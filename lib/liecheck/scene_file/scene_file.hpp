#pragma once
// Scene text (YAML) -> Scene. Every key is checked against the schema of its part; the table in fixtures/scenes/README.md
// is made from the same schema.

#include <liecheck/scene/scene.hpp>
#include <liecheck/scene_file/scene_error.hpp>

namespace liecheck {

/// The largest size of a scene text.
constexpr std::size_t max_scene_bytes = std::size_t(1) << 20;
/// The largest count of numbers in the samples of a scene: 400 MB.
constexpr double max_scene_numbers = 5e7;

/// The scene of a file, and of the URDF that it names, relative to its folder. Throws SceneError.
scene::Scene loadScene(const std::string& path);

/// The scene of a text; source_name stands for FILE in messages, the path of a URDF is relative to folder. Throws SceneError.
scene::Scene loadSceneText(const std::string& text, const std::string& source_name = "scene text",
                           const std::string& folder = ".");

/// Every part with its keys, units and defaults, as the Markdown table of fixtures/scenes/README.md.
std::string sceneSchema();

}  // namespace liecheck
