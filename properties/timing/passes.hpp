#pragma once
// What is timed of an operation of a subject, over ranges of its inputs.

#include <functional>
#include <timing/benchmarks.hpp>
#include <timing/cost.hpp>
#include <timing/signature.hpp>

namespace liecheck::properties {

/// passes(what, first, n) is what measures throughput, latency or interface over n inputs from `first`; a Timed of nothing if
/// the subject has no such time.
using Passes = std::function<Timed(Ratio CostSet::*what, std::size_t first, std::size_t n)>;

/// Of a function in this program.
inline Passes function_passes(const Signature& signature, AnyFunction function,
                              const std::shared_ptr<const char>& arguments) {
  return [=](Ratio CostSet::*what, std::size_t first, std::size_t n) -> Timed {
    const auto run = what == &CostSet::throughput ? signature.throughput
                     : what == &CostSet::latency  ? signature.latency
                                                  : nullptr;
    if (!run) return {};
    return {
        [=, from = arguments.get() + first * signature.size, keep = arguments] { run(function, from, n); },
        n};
  };
}

}  // namespace liecheck::properties
