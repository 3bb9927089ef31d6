#pragma once
// The scenes that a sweep runs if no scene is given.

#include <integrators/builtin.hpp>
#include <scenes/benchmark.hpp>

namespace liecheck::properties {

/// Their exact motions are known (scenes/truth.hpp).
std::vector<Benchmark> builtin_benchmarks();

}  // namespace liecheck::properties
