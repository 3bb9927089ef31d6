#pragma once
// Calls a function R(const A&...) from code that does not know the types R and A. It makes and reads the
// arguments, and runs passes of calls over them. The calls of a pass wait for one another (latency) or do not
// (throughput). The passes are the same code for every subject.

#include <cstdint>
#include <cstring>
#include <memory>
#include <operations/numbers.hpp>
#include <oracles/number.hpp>
#include <tuple>
#include <vector>

namespace liecheck::properties {

/// The exact values of an operation's arguments or of its result, in the order of its layouts. Matrices are
/// row by row.
using WideNumbers = std::vector<oracles::Real100>;

/// The exact value of a number.
template <class S>
oracles::Real100 wide(const S& x) {
  if constexpr (requires { x._hi(); })  // a double-double of QD
    return oracles::Real100(x._hi()) + oracles::Real100(x._lo());
  else
    return oracles::exact<oracles::Real100>(x);
}

/// A function of a subject, without its type.
using AnyFunction = void (*)();

struct Signature {
  /// Makes the arguments of all calls, one std::tuple<A...> each, from numbers in the order of the layouts.
  std::shared_ptr<const char> (*arguments)(const std::vector<std::vector<double>>& numbers);
  std::size_t size;  ///< of one std::tuple<A...> in bytes
  /// A pass over the arguments of n calls.
  void (*throughput)(AnyFunction, const char* arguments, std::size_t n);
  void (*latency)(AnyFunction, const char* arguments, std::size_t n);
  /// One call; appends the exact values of its arguments to `in`, and those of its result to `out`. Null in float and
  /// double, whose errors the laws measure.
  void (*call)(AnyFunction, const char* arguments, WideNumbers& in, WideNumbers& out);
  /// The shortest function of this signature: each number of its result is the first of its arguments.
  AnyFunction call_only;
};

namespace timing_detail {

/// Calls visit(matrix or scalar) for each part of a value, in the order of its layout.
template <class Value>
void for_each_part(Value& v, auto visit) {
  if constexpr (requires { v.I_C; })  // a body
    visit(v.mass), visit(v.c), visit(v.I_C);
  else if constexpr (requires { v.p; })  // a pose
    visit(v.R), visit(v.p);
  else
    visit(v);
}
/// Returns 0; the compiler cannot know this value.
inline std::size_t opaque_zero() {
  volatile std::size_t zero = 0;
  return zero;
}

/// Some bits of the first, a middle and the last number of each part of a result. The last number is usually
/// written last. In a Jacobian or spatial vector, the middle number is in another block than the first.
template <class R>
std::size_t bits_of(const R& result) {
  std::size_t bits = 0;
  for_each_part(result, [&](const auto& part) {
    const auto add = [&](const auto& number) {
      const void* from = &number;
      if constexpr (requires { number.backend().data()->_mpfr_d; })
        from = number.backend().data()->_mpfr_d;  // an MPFR number begins with its precision
      std::uint32_t word;
      std::memcpy(&word, from, sizeof word);
      bits ^= word;
    };
    if constexpr (requires { part.rows(); })
      for (const auto i : {Eigen::Index(0), part.size() / 2, part.size() - 1}) add(part.data()[i]);
    else
      add(part);
  });
  return bits;
}

template <class R, class A, class... Rest>
R call_only(const A& a, const Rest&...) {
  R r;
  const auto* first = [&] {
    if constexpr (requires { a.mass; })
      return &a.mass;
    else if constexpr (requires { a.p; })
      return a.R.data();
    else if constexpr (requires { a.data(); })
      return a.data();
    else
      return &a;
  }();
  for_each_part(r, [&](auto& part) {
    if constexpr (requires { part.rows(); })
      part.setConstant(*first);
    else
      part = *first;
  });
  return r;
}

/// One deleter for arguments of every type, so that std::shared_ptr is instantiated once.
struct Release {
  void (*release)(const char*);
  void operator()(const char* p) const { release(p); }
};

template <class S, class R, class... A>
struct Passes {
  using Arguments = std::tuple<A...>;
  using Function = R (*)(const A&...);

  static std::shared_ptr<const char> arguments(const std::vector<std::vector<double>>& numbers) {
    auto* const all = new Arguments[numbers.size()];
    const auto release = [](const char* p) { delete[] reinterpret_cast<const Arguments*>(p); };
    std::shared_ptr<const char> kept(reinterpret_cast<const char*>(all), Release{release});
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double* next = numbers[i].data();
      std::apply([&](A&... a) { (for_each_number(a, [&](S& x) { x = S(*next++); }), ...); }, all[i]);
    }
    return kept;
  }
  static void throughput(AnyFunction function, const char* arguments, std::size_t n) {
    const auto f = reinterpret_cast<Function>(function);
    const auto* x = reinterpret_cast<const Arguments*>(arguments);
    for (const auto* const end = x + n; x != end; ++x) {
      const R r = std::apply(f, *x);
      asm volatile("" : : "r"(&r) : "memory");
    }
  }
  /// The address of the next arguments depends on the last result.
  static void latency(AnyFunction function, const char* arguments, std::size_t n) {
    const auto f = reinterpret_cast<Function>(function);
    const std::size_t zero = opaque_zero();
    const auto* x = reinterpret_cast<const Arguments*>(arguments);
    for (std::size_t i = 0; i < n; ++i) {
      const R r = std::apply(f, *x);
      x += 1 + (bits_of(r) & zero);
    }
  }
  static void call(AnyFunction function, const char* arguments, WideNumbers& in, WideNumbers& out) {
    const auto& x = *reinterpret_cast<const Arguments*>(arguments);
    const auto append_to = [](WideNumbers& all) {
      return [&](const S& number) { all.push_back(wide(number)); };
    };
    std::apply([&](const A&... a) { (for_each_number(a, append_to(in)), ...); }, x);
    const R r = std::apply(reinterpret_cast<Function>(function), x);
    for_each_number(r, append_to(out));
  }
};

}  // namespace timing_detail

/// S is the scalar of the arguments. It represents their numbers exactly.
template <class S, class R, class... A>
Signature signature_of(R (*)(const A&...)) {
  using P = timing_detail::Passes<S, R, A...>;
  Signature s{&P::arguments,  sizeof(std::tuple<A...>),
              &P::throughput, &P::latency,
              nullptr,        reinterpret_cast<AnyFunction>(&timing_detail::call_only<R, A...>)};
  if constexpr (!std::is_floating_point_v<S>) s.call = &P::call;
  return s;
}

}  // namespace liecheck::properties
