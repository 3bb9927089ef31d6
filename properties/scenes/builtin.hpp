#pragma once
// The built-in scenes, which a sweep runs if no scene is given. Their exact motions are known (truth.hpp).

#include <scenes/benchmark.hpp>

namespace liecheck::properties {

std::vector<Benchmark> builtin_benchmarks();

}  // namespace liecheck::properties
