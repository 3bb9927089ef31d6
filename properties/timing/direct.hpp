#pragma once
// Times of adapters: of a shared library by its own loops, or by calls of its functions; of a program by its own loops.

#include <adapters/liecheck_adapter.h>
#include <adapters/subjects.hpp>
#include <array>
#include <cstring>
#include <timing/passes.hpp>

namespace liecheck::properties {

/// A function of an adapter and the numbers of its calls.
template <class S>
struct AdapterCalls {
  std::string adapter;  ///< as it was given
  std::string operation, scalar;
  adapters::OperationSizes sizes;
  std::vector<S> inputs;

  std::size_t count() const { return inputs.size() / sizes.inputs; }

  /// Calls of the function through the interface: as many at once as it has room for if `many`, otherwise one by one, and the
  /// address of the next arguments depends on the last result, as in signature.hpp.
  void through_interface(const adapters::CFunction& function, bool many, std::size_t first,
                         std::size_t n) const {
    std::array<S, 512> results{};
    std::array<unsigned char, 512> status{};
    const std::size_t zero = timing_detail::opaque_zero(), each = many ? results.size() / sizes.results : 1;
    const S* x = inputs.data() + first * sizes.inputs;
    for (std::size_t done = 0; done < n; done += each) {
      const std::size_t now = std::min(each, n - done);
      function(now, x, results.data(), status.data());
      asm volatile("" : : "r"(results.data()) : "memory");
      std::uint32_t bits = 0;
      for (const std::size_t i : {std::size_t(0), sizes.results / 2, sizes.results - 1}) {
        std::uint32_t word;
        std::memcpy(&word, &results[i], sizeof word);
        bits ^= word;
      }
      x += now * sizes.inputs + (bits & zero);
    }
  }
};

/// Of a shared library, in this process, into which it is loaded.
template <class S>
Passes library_passes(const AdapterCalls<S>& given) {
  const auto calls = std::make_shared<const AdapterCalls<S>>(given);
  const std::string file = adapters::library_in(calls->adapter);
  const auto function = adapters::function_of_library(file, calls->operation, calls->scalar);
  const liecheck_loops* const loops = adapters::loops_of_library(file, calls->operation, calls->scalar);
  std::shared_ptr<void> prepared;
  if (loops)
    prepared = {loops->prepare(function.context, calls->count(), calls->inputs.data()), [loops](void* p) {
                  if (p) loops->release(p);
                }};
  return [=](Ratio CostSet::*what, std::size_t first, std::size_t n) -> Timed {
    const bool many = what == &CostSet::throughput;
    if (what == &CostSet::interface && !loops) return {};
    if (what == &CostSet::interface || !loops)
      return {[=] { calls->through_interface(function, many, first, n); }, n};
    if (!prepared) return {};  // it refuses all inputs
    return {[=] { (many ? loops->throughput : loops->latency)(prepared.get(), first, n); }, n};
  };
}

/// Of a program, which is running. One by one, it makes 64 calls at most: a program may take microseconds for each.
template <class S>
Passes program_passes(const AdapterCalls<S>& given, const std::string& offered) {
  const auto calls = std::make_shared<const AdapterCalls<S>>(given);
  return [=](Ratio CostSet::*what, std::size_t first, std::size_t n) -> Timed {
    const char* const how = what == &CostSet::throughput ? "many"
                            : what == &CostSet::latency  ? "one"
                                                         : "nothing";
    if (what == &CostSet::throughput && offered.find("many") == offered.npos) return {};
    n = what == &CostSet::throughput ? n : std::min<std::size_t>(n, 64);
    return {nullptr, n, [=](std::size_t passes) {
              const std::span<const S> inputs(calls->inputs.data() + first * calls->sizes.inputs,
                                              n * calls->sizes.inputs);
              return adapters::timed_outside(calls->adapter, how,
                                             {calls->sizes, sizeof(S) == 8, n, std::as_bytes(inputs), {}, {}},
                                             passes);
            }};
  };
}

}  // namespace liecheck::properties
