#pragma once
// Loops over calls of one operation, for `liecheck cost`. They are compiled with the adapter, so what they time is the
// library as its user compiles it. Included by liecheck_adapter.hpp.

#include <liecheck_adapter.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

// Functions that keep objects, and tables of functions, are hidden: two libraries in one process whose structs have the same name would
// share the objects.
#ifdef __GNUC__
#define LIECHECK_HIDDEN [[gnu::visibility("hidden")]]
#else
#define LIECHECK_HIDDEN
#endif

namespace liecheck::adapter {

/// f(object, in, out) compiles for I numbers of S and R numbers of S.
template <class F, class Object, class S, std::size_t I, std::size_t R>
concept Computes = requires(const F& f, Object& object, std::span<const S, I> in, std::span<S, R> out) {
  f(object, in, out);
};

/// P()(object, in) is a call with its arguments, in the library's own types, and P()(object, in)() makes the call.
template <class P, class Object, class S, std::size_t I>
concept Prepares = requires(const P& p, Object& object, std::span<const S, I> in) {
  p(object, in)();
};

/// A call by numbers, of F()(object, in, out).
template <class F, class Object, class S, std::size_t I, std::size_t R>
struct CallByNumbers {
  Object* object;
  std::array<S, I> in;
  std::array<S, R> operator()() const {
    std::array<S, R> out;
    F()(*object, std::span<const S, I>(in), std::span<S, R>(out));
    return out;
  }
};

/// The result of a call, computed: an expression of Eigen is not before eval(), which copies anything else.
template <class Call>
auto result_of(const Call& call) {
  using Result = decltype(call());
  if constexpr (requires { call().eval(); }) {
    if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(call().eval())>, Result>)
      return call().eval();
    else
      return call();
  } else {
    return call();
  }
}

/// Some bits of numbers in all quarters of a result.
template <class Result>
std::size_t bits_of(const Result& result) {
  const void* from = &result;
  std::size_t size = sizeof result;
  if constexpr (requires { *result.data(), result.size(); })
    from = result.data(), size = static_cast<std::size_t>(result.size()) * sizeof *result.data();
  const auto word = [&](std::size_t quarter) {
    std::uint32_t bits;
    std::memcpy(&bits, static_cast<const char*>(from) + quarter * size / 4 / sizeof bits * sizeof bits,
                sizeof bits);
    return bits;
  };
  return word(0) ^ word(1) ^ word(2) ^ word(3);
}

/// The loops over calls that Make()(object, in) makes.
template <class Make, class Object, class S, std::size_t I, bool own_types>
struct LIECHECK_HIDDEN Loops {
  using Call = decltype(Make()(std::declval<Object&>(), std::declval<std::span<const S, I>>()));
  using Calls = std::vector<Call>;

  /// In place of a call that throws stands the one before, or the first one that does not.
  static void* prepare(void* object, std::size_t n, const void* inputs) {
    auto* const all = new Calls;
    all->reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      try {
        Call call = Make()(*static_cast<Object*>(object),
                           std::span<const S, I>(static_cast<const S*>(inputs) + I * i, I));
        result_of(call);
        while (all->size() <= i) all->push_back(call);
      } catch (...) {
        if (!all->empty()) all->push_back(Call(all->back()));
      }
    }
    if (!all->empty()) return all;
    delete all;
    return nullptr;
  }
  static void release(void* calls) { delete static_cast<Calls*>(calls); }
  static void throughput(const void* calls, std::size_t first, std::size_t n) {
    const Call* call = static_cast<const Calls*>(calls)->data() + first;
    for (const Call* const end = call + n; call != end; ++call) {
      const auto result = result_of(*call);
      asm volatile("" : : "r"(&result) : "memory");
    }
  }
  /// The address of the next call depends on the last result.
  static void latency(const void* calls, std::size_t first, std::size_t n) {
    volatile std::size_t unknown = 0;
    const std::size_t zero = unknown;
    const Call* call = static_cast<const Calls*>(calls)->data() + first;
    for (std::size_t i = 0; i < n; ++i) call += 1 + (bits_of(result_of(*call)) & zero);
    asm volatile("" : : "r"(call));  // or the compiler leaves out calls without an effect
  }
  static constexpr liecheck_loops all = {own_types, &prepare, &release, &throughput, &latency};
};

/// The loops in the library's own types if P prepares calls, otherwise by numbers; null as above.
struct AllLoops {
  using type = const liecheck_loops*;
  template <class F, class P, class Object, class S, std::size_t I, std::size_t R>
  static const liecheck_loops* in() {
    constexpr auto by_numbers = [](Object& object, std::span<const S, I> numbers) {
      CallByNumbers<F, Object, S, I, R> call{&object, {}};
      std::copy(numbers.begin(), numbers.end(), call.in.begin());
      return call;
    };
    if constexpr (Prepares<P, Object, S, I>)
      return &Loops<P, Object, S, I, true>::all;
    else if constexpr (Computes<F, Object, S, I, R>)
      return &Loops<decltype(by_numbers), Object, S, I, false>::all;
    else
      return nullptr;
  }
};

}  // namespace liecheck::adapter
