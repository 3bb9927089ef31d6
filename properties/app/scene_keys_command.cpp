#include <fmt/format.h>
#include <app/command.hpp>
#include <liecheck/scene_file/scene_file.hpp>

namespace liecheck::properties {

Command scene_keys_command(CLI::App& scene) {
  return Arguments(scene, "keys", "list every key that a scene may have").command([] {
    fmt::print("{}", sceneSchema());
    return within_budget;
  });
}

}  // namespace liecheck::properties
