#pragma once
// Scene text (YAML) -> Scene. Every key is checked against the schema of its part; README.md of fixtures/scenes has the
// table, made from the same schema.

#include <liecheck/scene/scene.hpp>

namespace liecheck {

/// A scene that cannot be read, or asks for what makes no sense. what() is one line: `FILE:LINE: what is wrong, and what
/// to write instead`, or `FILE: ...` and line() 0 where no line is at fault.
class SceneError : public std::runtime_error {
 public:
  SceneError(const std::string& file, int line, const std::string& what);
  const std::string& file() const { return file_; }
  int line() const { return line_; }

 private:
  std::string file_;
  int line_;
};

/// A text longer than this is refused.
constexpr std::size_t max_scene_bytes = std::size_t(1) << 20;
/// So is a scene whose samples hold more numbers than this: 400 MB.
constexpr double max_scene_numbers = 5e7;

/// The scene of a file, and of the URDF that it names, relative to its folder. Throws SceneError.
scene::Scene loadScene(const std::string& path);

/// The scene of a text; source_name stands for FILE in messages, folder is where a URDF is looked for. Throws SceneError.
scene::Scene loadSceneText(const std::string& text, const std::string& source_name = "scene text",
                           const std::string& folder = ".");

/// Every part with its keys, units and defaults, as the Markdown table of fixtures/scenes/README.md.
std::string sceneSchema();

}  // namespace liecheck
