#include <fmt/format.h>
#include <app/command.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <support/say.hpp>

namespace liecheck::properties {

Command scene_keys_command(CLI::App& scene) {
  return Arguments(scene, "keys",
                   "list the keys of bodies, roots, starts, effects, actuations, integrators and observers")
      .command([] {
        say("{}", sceneSchema());
        return within_budget;
      });
}

}  // namespace liecheck::properties
