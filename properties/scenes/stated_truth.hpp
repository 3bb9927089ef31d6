#pragma once
// The closed form that a scene names by its key `truth`.

#include <liecheck/scene/scene.hpp>
#include <scenes/truth.hpp>
#include <stdexcept>

namespace liecheck::properties {

/// Empty if the scene names none. Throws std::invalid_argument naming the scene if it is not that of the motion.
inline std::optional<Truth> stated_truth(const scene::Scene& scene) try {
  if (scene.truth.empty()) return {};
  return named_truth(benchmark_of(scene), scene.truth);
} catch (const std::invalid_argument& e) {
  throw std::invalid_argument(scene.source + ": " + e.what());
}

}  // namespace liecheck::properties
