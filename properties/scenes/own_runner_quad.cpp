#include <scenes/own_runner.hpp>

namespace liecheck::properties {

std::unique_ptr<Runner> own_runner_quad(const Benchmark& scene, const std::string& method) {
  return own_runner<Quad>(scene, method, scene.effects_quad());
}

}  // namespace liecheck::properties
