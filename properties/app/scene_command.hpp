#pragma once
// `liecheck scene run`, `explain` and `keys`.

#include <string>

namespace liecheck::properties {

struct SceneFlags {
  std::string file;
  std::string csv, json;  ///< instead of the scene's own
};

/// Runs a scene, writes what it watches, prints its figures. 0; 3 where it diverged or was stopped, with what was done
/// until then. Throws SceneError.
int run_scene_command(const SceneFlags& flags);

/// Prints the plan: each stage with what it costs here and now, and what was left out. 0. Throws SceneError.
int explain_scene_command(const SceneFlags& flags);

/// Prints every key of a scene file. 0.
int scene_keys_command();

}  // namespace liecheck::properties
