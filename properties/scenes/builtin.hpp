#pragma once
// The scenes of a sweep that names none: exact motions, numbers that are exact in double.

#include <scenes/benchmark.hpp>

namespace liecheck::properties {

std::vector<Benchmark> builtin_benchmarks();

}  // namespace liecheck::properties
