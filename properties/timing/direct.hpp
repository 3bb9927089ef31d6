#pragma once
// The functions of an adapter that is a shared library, called directly, one input a call, so that they can be timed.

#include <adapters/adapter.hpp>
#include <algorithm>
#include <array>
#include <timing/signature.hpp>

namespace liecheck::properties {

/// A function of an adapter. AnyFunction is the address of one of these.
struct DirectFunction {
  adapters::CFunction function;
  std::size_t inputs, results;  ///< numbers of a call
};

template <class S>
struct DirectPasses {
  static std::shared_ptr<const char> arguments(const std::vector<std::vector<double>>& numbers) {
    const auto all = std::make_shared<std::vector<S>>();
    for (const auto& one : numbers)
      for (const double x : one) all->push_back(static_cast<S>(x));
    return {all, reinterpret_cast<const char*>(all->data())};
  }
  static void throughput(AnyFunction function, const char* arguments, std::size_t n) {
    pass(function, arguments, n, [](const S*, std::size_t) { return std::size_t(0); });
  }
  /// The address of the next arguments depends on the last result, as in signature.hpp.
  static void latency(AnyFunction function, const char* arguments, std::size_t n) {
    const std::size_t zero = timing_detail::opaque_zero();
    pass(function, arguments, n, [zero](const S* results, std::size_t size) {
      std::uint32_t bits = 0;
      for (const std::size_t i : {std::size_t(0), size / 2, size - 1}) {
        std::uint32_t word;
        std::memcpy(&word, results + i, sizeof word);
        bits ^= word;
      }
      return bits & zero;
    });
  }

 private:
  static void pass(AnyFunction function, const char* arguments, std::size_t n, auto step) {
    const auto& direct = *reinterpret_cast<const DirectFunction*>(function);
    const auto* x = reinterpret_cast<const S*>(arguments);
    std::array<S, 512> results{};
    unsigned char status = 0;
    for (std::size_t i = 0; i < n; ++i) {
      direct.function(1, x, results.data(), &status);
      asm volatile("" : : "r"(results.data()) : "memory");
      x += direct.inputs + step(results.data(), direct.results);
    }
  }
};

/// `inputs` numbers a call.
template <class S>
Signature direct_signature(std::size_t inputs) {
  using P = DirectPasses<S>;
  return {&P::arguments, sizeof(S) * inputs, &P::throughput, &P::latency, nullptr, nullptr};
}

}  // namespace liecheck::properties
