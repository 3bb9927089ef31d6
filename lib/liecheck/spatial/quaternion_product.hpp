#pragma once
// The product of quaternions x y z w, with terms summed in double words. All four numbers are computed at
// once if they fit one register of the target, otherwise one after another.

#include <liecheck/scalar/compensated.hpp>
#include <liecheck/scalar/simd.hpp>
#include <liecheck/spatial/types.hpp>

namespace liecheck {

/// A quaternion x y z w, or a vector padded with a fourth number.
template <Scalar S>
using Quad = Simd<S, 4>;
/// True if a Quad fits one vector register. A few more operations on it then cost little.
template <Scalar S>
inline constexpr bool one_register = Quad<S>::in_register;

/// Selects the numbers of a Quad that a formula computes: all four, or number N alone (see by_lane).
struct AllLanes {};
template <int N>
struct OneLane {};

/// permute returns (q_I, q_J, q_K, q_L). pick returns the lanes of it that its first argument selects.
template <int I, int J, int K, int L, class Q>
[[gnu::always_inline]] inline Q permute(const Q& q) {
  if constexpr (Q::in_register)
    return __builtin_shufflevector(q.v, q.v, I, J, K, L);
  else
    return Q(q.v[I], q.v[J], q.v[K], q.v[L]);
}
template <int I, int J, int K, int L, class Q>
[[gnu::always_inline]] inline Q pick(AllLanes, const Q& q) {
  return permute<I, J, K, L>(q);
}
template <int I, int J, int K, int L, int N, class Q>
[[gnu::always_inline]] inline auto pick(OneLane<N>, const Q& q) {
  constexpr int places[4] = {I, J, K, L};
  return q.v[places[N]];
}
template <class Q, int BITS, Precision P>
[[gnu::always_inline]] inline SplitFactor<Q, BITS, P> at(AllLanes, const SplitFactor<Q, BITS, P>& c) {
  return c;
}
template <int N, class Q, int BITS, Precision P>
[[gnu::always_inline]] inline auto at(OneLane<N>, const SplitFactor<Q, BITS, P>& c) {
  using S = std::remove_cvref_t<decltype(c.value.v[N])>;
  return SplitFactor<S, BITS, P>::of(c.value.v[N], c.high.v[N], c.low.v[N]);
}

/// (q_I, q_J, q_K, q_L) as split factors. Without sigma they are split at a fixed digit, with sigma at the
/// last digit of sigma. With low, the double words q + low are split.
template <Precision P, int I, int J, int K, int L, class Lanes, class Q>
[[gnu::always_inline]] inline auto split_lanes(Lanes lane, const Q& q) {
  const auto a = pick<I, J, K, L>(lane, q);
  return SplitFactor<std::remove_cvref_t<decltype(a)>, 1, P>(a);
}
template <Precision P, int I, int J, int K, int L, class Lanes, class Q>
[[gnu::always_inline]] inline auto split_lanes(Lanes lane, const Q& q, const Q& sigma) {
  const auto a = pick<I, J, K, L>(lane, q);
  return SplitFactor<std::remove_cvref_t<decltype(a)>, 1, P>(a, pick<0, 1, 2, 3>(lane, sigma));
}
template <Precision P, int I, int J, int K, int L, class Lanes, class Q>
[[gnu::always_inline]] inline auto split_lanes(Lanes lane, const Q& q, const Q& low, const Q& sigma) {
  const auto a = pick<I, J, K, L>(lane, q);
  return SplitFactor<std::remove_cvref_t<decltype(a)>, 1, P>(a, pick<I, J, K, L>(lane, low),
                                                             pick<0, 1, 2, 3>(lane, sigma));
}
/// An empty sum of products, for the numbers that `lane` selects.
template <Precision P, class Lanes, class Q>
[[gnu::always_inline]] inline auto empty_sum(Lanes lane, const Q& q) {
  return SplitDot<std::remove_cvref_t<decltype(pick<0, 1, 2, 3>(lane, q))>, 1, P>();
}

/// Computes f(lane), a SplitDot, for all four numbers: at once if they fit one register, otherwise one after
/// another, so that few registers are in use at a time.
template <Scalar S, Precision P, class F>
[[gnu::always_inline]] inline SplitDot<Quad<S>, 1, P> by_lane(F f) {
  if constexpr (one_register<S>) {
    return f(AllLanes());
  } else {
    SplitDot<Quad<S>, 1, P> sum;
    const auto set = [&sum](int i, const auto& lane) __attribute__((always_inline)) {
      sum.high.v[i] = lane.high, sum.low_a.v[i] = lane.low();
    };
    set(0, f(OneLane<0>())), set(1, f(OneLane<1>())), set(2, f(OneLane<2>())), set(3, f(OneLane<3>()));
    return sum;
  }
}

/// The left factor q = (v, w) of a quaternion product, arranged and split for
///     q (r, w') = [w r + v w' + v x r; w w' - v . r].
template <Scalar S, Precision P>
struct LeftFactor {
  using Factor = SplitFactor<Quad<S>, 1, P>;
  Factor w_x, self, y, z;  ///< (w w w -x), q, (y z x -y), (z x y z)
  [[gnu::always_inline]] explicit LeftFactor(const Quad<S>& q)
      : w_x(permute<3, 3, 3, 0>(q) * signs()),
        self(q),
        y(permute<1, 2, 0, 1>(q) * signs()),
        z(permute<2, 0, 1, 2>(q)) {}
  [[gnu::always_inline]] static Quad<S> signs() { return Quad<S>(S(1), S(1), S(1), S(-1)); }
};

/// q_0 + q_1 + q_2 + q_3.
template <class Q>
[[gnu::always_inline]] inline auto sum(const Q& q) {
  return (q.v[0] + q.v[2]) + (q.v[1] + q.v[3]);
}

}  // namespace liecheck
