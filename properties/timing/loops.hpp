#pragma once
// The timed loops over a set of inputs, for throughput and for latency. All subjects use the same code.

#include <cstring>
#include <functional>
#include <memory>
#include <subjects/subject.hpp>
#include <tuple>
#include <vector>

namespace liecheck::properties {

/// Each function makes one pass over `calls` inputs.
struct Loops {
  std::function<void()> throughput, latency;
  std::size_t calls = 0;
};

namespace timing_detail {

/// Returns 0, which the compiler cannot know.
inline std::size_t opaque_zero() {
  volatile std::size_t zero = 0;
  return zero;
}

/// Bits of the first, a middle and the last number of a result. The last is written last, and the middle one
/// belongs to the other block of a vector or Jacobian.
template <class S, class M>
std::size_t bits_of_numbers(const M& m) {
  const auto word = [&](int i) {
    std::uint32_t w;
    std::memcpy(&w, m.data() + i, sizeof w);
    return w;
  };
  const int n = static_cast<int>(m.size());
  return word(0) ^ word(n / 2) ^ word(n - 1);
}
template <class S, int R, int C>
std::size_t bits_of(const Eigen::Matrix<S, R, C>& m) {
  return bits_of_numbers<S>(m);
}
template <class S>
std::size_t bits_of(const Pose<S>& X) {
  return bits_of_numbers<S>(X.R) ^ bits_of_numbers<S>(X.p);
}
template <class S>
std::size_t bits_of(const Body<S>& I) {
  return bits_of_numbers<S>(I.c) ^ bits_of_numbers<S>(I.I_C);
}
template <class S>
std::size_t bits_of(const S& x) {
  std::uint32_t w;
  std::memcpy(&w, &x, sizeof w);
  return w;
}

template <class S, int R, int C>
const S& first_number(const Eigen::Matrix<S, R, C>& m) {
  return m(0, 0);
}
template <class S>
const S& first_number(const Pose<S>& X) {
  return X.R(0, 0);
}
template <class S>
const S& first_number(const Body<S>& I) {
  return I.mass;
}
template <class S, int R, int C>
void fill(Eigen::Matrix<S, R, C>& m, const S& x) {
  m.setConstant(x);
}
template <class S>
void fill(Pose<S>& X, const S& x) {
  X.R.setConstant(x), X.p.setConstant(x);
}
template <class S>
void fill(Body<S>& I, const S& x) {
  I.mass = x, I.c.setConstant(x), I.I_C.setConstant(x);
}
template <class S>
void fill(S& y, const S& x) {
  y = x;
}

/// The shortest operation with its signature: every number of the result is the first number of the input.
template <class R, class A, class... Rest>
R call_only(const A& a, const Rest&...) {
  R r;
  fill(r, first_number(a));
  return r;
}

}  // namespace timing_detail

/// Inputs shared by all subjects, so that no subject has them closer in the caches than another.
template <class... A>
using SharedInputs = std::shared_ptr<const std::vector<std::tuple<A...>>>;

/// Loops that call f on the inputs first ... first + n - 1.
template <class R, class... A>
Loops loops_of(R (*f)(const A&...), const SharedInputs<A...>& inputs, std::size_t first, std::size_t n) {
  Loops loops;
  loops.calls = n;
  loops.throughput = [=] {
    const auto* x = inputs->data() + first;
    for (const auto* const end = x + n; x != end; ++x) {
      const R r = std::apply(f, *x);
      asm volatile("" : : "r"(&r) : "memory");
    }
  };
  loops.latency = [=] {
    const std::size_t zero = timing_detail::opaque_zero();
    const auto* x = inputs->data() + first;
    for (std::size_t i = 0; i < n; ++i) {
      const R r = std::apply(f, *x);
      x += 1 + (timing_detail::bits_of(r) & zero);
    }
  };
  return loops;
}

}  // namespace liecheck::properties
