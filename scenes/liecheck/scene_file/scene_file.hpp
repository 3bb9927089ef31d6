#pragma once
// Scene text (YAML) -> Scene. Every key is checked against the schema of its part. The table in
// fixtures/scenes/README.md is generated from the same schema.

#include <liecheck/scene/scene.hpp>
#include <liecheck/scene_file/scene_error.hpp>

namespace liecheck {

/// The largest size of a scene text.
constexpr std::size_t max_scene_bytes = std::size_t(1) << 22;

/// The scene of a file. Paths in it are relative to its folder, and lead into it or, for a *.urdf, into a folder beside
/// it, or into one of the folders `outside`. Throws SceneError. If `warnings` is given, those of the URDF are added to it.
scene::Scene loadScene(const std::string& path, std::vector<std::string>* warnings = nullptr,
                       const std::vector<std::string>& outside = {});

/// The scene of a text. Messages show source_name as FILE. Its folder is `folder`. Else like loadScene.
scene::Scene loadSceneText(const std::string& text, const std::string& source_name = "scene text",
                           const std::string& folder = ".", std::vector<std::string>* warnings = nullptr,
                           const std::vector<std::string>& outside = {});

/// Every part with its keys, units and defaults, as the Markdown table of fixtures/scenes/README.md.
std::string sceneSchema();

}  // namespace liecheck
