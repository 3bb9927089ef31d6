#pragma once
// liecheck as a simulator of benchmarks.

#include <scenes/runner.hpp>

namespace liecheck::properties {

/// Returns liecheck's runner; scalar is "double" or "float128". With a tolerance of 0, an adaptive method
/// accepts every step. Throws std::invalid_argument if the method cannot run this scene.
std::unique_ptr<Runner> make_runner(const Benchmark& scene, const std::string& method,
                                    const std::string& scalar);

}  // namespace liecheck::properties
