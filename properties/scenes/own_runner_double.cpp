#include <scenes/own_runner.hpp>

namespace liecheck::properties {

std::unique_ptr<Runner> make_runner(const Benchmark& scene, const std::string& method,
                                    const std::string& scalar) {
  if (scalar == "float128") return own_runner_quad(scene, method);
  if (scalar != "double") throw std::invalid_argument("a scene runs in double or float128, not in " + scalar);
  return own_runner<double>(scene, method, scene.effects());
}

}  // namespace liecheck::properties
