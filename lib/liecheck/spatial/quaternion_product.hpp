#pragma once
// The products of quaternions x y z w and of vectors, with terms summed in double words. All numbers are
// computed at once if they fit vector registers of the target, otherwise one after another.

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

/// Selects the numbers that a formula computes: all four, or number N alone (see by_lane).
struct AllLanes {};
template <int N>
struct OneLane {};

namespace quad_detail {

/// (q_I, q_J) of numbers in two registers.
template <int I, int J, class V>
[[gnu::always_inline]] inline auto half(const V& q) {
  const auto& i = I < 2 ? q.low : q.high;
  const auto& j = J < 2 ? q.low : q.high;
  return __builtin_shufflevector(i, j, I % 2, 2 + J % 2);
}

}  // namespace quad_detail

/// permute returns (q_I, q_J, q_K, q_L). pick returns the lanes of it that its first argument selects.
template <int I, int J, int K, int L, class S>
[[gnu::always_inline]] inline auto permute(const Simd<S, 4>& q) {
  using Q = Simd<S, 4>;
  if constexpr (Q::in_register)
    return Q(__builtin_shufflevector(q.v, q.v, I, J, K, L));
  else if constexpr (Q::in_halves)
    return Q(typename Q::Vector{quad_detail::half<I, J>(q.v), quad_detail::half<K, L>(q.v)});
  else
    return Q(q.v[I], q.v[J], q.v[K], q.v[L]);
}
template <int I, int J, int K, int L, class S>
[[gnu::always_inline]] inline auto pick(AllLanes, const Simd<S, 4>& q) {
  return permute<I, J, K, L>(q);
}
template <int I, int J, int K, int L, int N, class S>
[[gnu::always_inline]] inline S pick(OneLane<N>, const Simd<S, 4>& q) {
  constexpr int places[4] = {I, J, K, L};
  return q.v[places[N]];
}
/// The same of split factors.
template <int I, int J, int K, int L, class Lanes, class Q, int BITS, Precision P>
[[gnu::always_inline]] inline auto pick(Lanes lane, const SplitFactor<Q, BITS, P>& c) {
  const auto value = pick<I, J, K, L>(lane, c.value);
  return SplitFactor<std::remove_cvref_t<decltype(value)>, BITS, P>::of(value, pick<I, J, K, L>(lane, c.high),
                                                                        pick<I, J, K, L>(lane, c.low));
}

/// Computes f(lane), a SplitDot, for all four numbers: at once if they fit two registers, otherwise one after
/// another, so that few registers are in use at a time.
template <class Q, Precision P, class F>
[[gnu::always_inline]] inline SplitDot<Q, 1, P> by_lane(F f) {
  if constexpr (Q::in_register || Q::in_halves) {
    return f(AllLanes());
  } else {
    SplitDot<Q, 1, P> sum;
    const auto set = [&sum, &f ]<int N>(OneLane<N> lane) __attribute__((always_inline)) {
      const auto one = f(lane);
      sum.high.v[N] = one.high, sum.low_a.v[N] = one.low();
    };
    set(OneLane<0>()), set(OneLane<1>()), set(OneLane<2>()), set(OneLane<3>());
    return sum;
  }
}
/// a b.
template <class V, int BITS, Precision P>
[[gnu::always_inline]] inline auto times(const SplitFactor<V, BITS, P>& a, const SplitFactor<V, BITS, P>& b) {
  return SplitDot<V, BITS, P>::product(a, b);
}

/// q_0 + q_1 + q_2 + q_3.
template <class Q>
[[gnu::always_inline]] inline auto sum(const Q& q) {
  return (q.v[0] + q.v[2]) + (q.v[1] + q.v[3]);
}

/// q b or q* b of quaternions in two registers each. The parts of b = (x y, z w) need no permutation:
///     first = w (x y) + y (z w) + (-a_1, a_0),  a = z (x y) - x (z w)
///     last = w (z w) - y (x y) + (c_1, -c_0),   c = x (x y) + z (z w)      with the factors x y z w of q
template <Scalar S, Precision P, int SIGN>
[[gnu::always_inline]] inline SplitDot<Quad<S>, 1, P> product_in_halves(const SplitFactor<Quad<S>, 1, P>& q,
                                                                        const SplitFactor<Quad<S>, 1, P>& b) {
  using Pair = Simd<S, 2>;
  using Factor = SplitFactor<Pair, 1, P>;
  const auto all = [&q](int i) __attribute__((always_inline)) {
    return Factor::of(Pair(q.value.v[i]), Pair(q.high.v[i]), Pair(q.low.v[i]));
  };
  const Factor x = all(0), y = all(1), z = all(2), w = all(3);
  const Factor xy = Factor::of(Pair(b.value.v.low), Pair(b.high.v.low), Pair(b.low.v.low)),
               zw = Factor::of(Pair(b.value.v.high), Pair(b.high.v.high), Pair(b.low.v.high));
  auto first = times(w, xy), last = times(w, zw);
  if constexpr (SIGN > 0)
    first.add_product(y, zw), last.subtract_product(y, xy);
  else
    first.subtract_product(y, zw), last.add_product(y, xy);
  const auto a = times(z, xy).subtract_product(x, zw), c = times(x, xy).add_product(z, zw);
  const Pair sign(S(-SIGN), S(SIGN));
  const auto turned = [&sign](const Pair& n) __attribute__((always_inline)) {
    return sign * Pair(__builtin_shufflevector(n.v, n.v, 1, 0));
  };
  const auto joined = [](const Pair& l, const Pair& h) __attribute__((always_inline)) {
    return Quad<S>(typename Quad<S>::Vector{l.v, h.v});
  };
  SplitDot<Quad<S>, 1, P> sum;
  sum.high = joined(first.high + turned(a.high), last.high - turned(c.high));
  if constexpr (P != Precision::fast) {
    sum.low_a = joined(first.low(), last.low());
    sum.low_b = joined(turned(a.low()), -turned(c.low()));
  }
  return sum;
}

/// q b = [w r + w' v + v x r; w w' - v . r] for q = (v, w) and b = (r, w') in double words; q* b for SIGN =
/// -1.
template <Scalar S, Precision P, int SIGN = 1>
[[gnu::always_inline]] inline SplitDot<Quad<S>, 1, P> product(const SplitFactor<Quad<S>, 1, P>& q,
                                                              const SplitFactor<Quad<S>, 1, P>& b) {
  if constexpr (Quad<S>::in_halves) return product_in_halves<S, P, SIGN>(q, b);
  using Factor = SplitFactor<Quad<S>, 1, P>;
  const auto signs = [](const Factor& c, int x, int y, int z, int w) __attribute__((always_inline)) {
    const Quad<S> sign{S(x), S(y), S(z), S(w)};
    return Factor::of(c.value * sign, c.high * sign, c.low * sign);
  };
  // Permutations by pairs, which exchange two registers, are free.
  const Factor c = signs(pick<1, 0, 3, 2>(AllLanes(), b), SIGN, -SIGN, SIGN, -SIGN);  // (y, -x, w', -z)
  const Factor by_y = signs(pick<2, 3, 0, 1>(AllLanes(), b), SIGN, SIGN, -SIGN, -SIGN),
               by_z = signs(c, -1, -1, 1, 1);
  return by_lane<Quad<S>, P>([&](auto l) __attribute__((always_inline)) {
    return times(pick<3, 3, 3, 3>(l, q), pick<0, 1, 2, 3>(l, b))
        .add_product(pick<0, 0, 0, 0>(l, q), pick<2, 3, 0, 1>(l, c))
        .add_product(pick<1, 1, 1, 1>(l, q), pick<0, 1, 2, 3>(l, by_y))
        .add_product(pick<2, 2, 2, 2>(l, q), pick<0, 1, 2, 3>(l, by_z));
  });
}

/// q = (v, w) or q*, for SIGN = 1 or -1, applied to x + x_low..., whose fourth number is not used:
///     x + 2 (SIGN w t + v x t) / |q|^2,  t = v x x.
/// sigma is 2^(digits/2 + 1) times a bound of |x|, |q|^2 = 1 + excess with |excess| <= sqrt(eps)/2. Error 1 eps of
/// the bound.
template <Precision P, int SIGN, class V, class S, class... Low>
[[gnu::always_inline]] inline V rotated(const SplitFactor<V, 1, P>& q, const S& excess, const V& sigma,
                                        const V& x, const Low&... x_low) {
  using Factor = SplitFactor<V, 1, P>;
  // The fourth numbers are those that cost no instruction in two registers.
  const auto cross = [](auto l, const Factor& a, const Factor& b) __attribute__((always_inline)) {
    return times(pick<1, 2, 0, 1>(l, a), pick<2, 0, 1, 1>(l, b))
        .subtract_product(pick<2, 0, 1, 1>(l, a), pick<1, 2, 0, 1>(l, b));
  };
  Factor p(x, sigma);
  ((p = p.plus(x_low)), ...);
  const auto t = by_lane<V, P>([&](auto l) __attribute__((always_inline)) { return cross(l, q, p); });
  const Factor f(t.high, t.low(), sigma);
  const auto r = by_lane<V, P>([&](auto l) __attribute__((always_inline)) {
    auto sum = cross(l, q, f);
    const auto w = pick<3, 3, 3, 3>(l, q), along = pick<0, 1, 2, 3>(l, f);
    if constexpr (SIGN > 0) return sum.add_product(w, along);
    return sum.subtract_product(w, along);
  });
  // 2 r.high is added to p.high without a rounding error.
  const V correction(mul_add(excess, excess, S(-excess))), low = mul_add(correction, r.value(), r.low());
  return (p.high + (r.high + r.high)) + (p.low + (low + low));
}

/// |q|^2 - 1 as a double word. Error eps/16 of |q|^2 for |q|^2 < 2.
template <class Q, Precision P>
[[gnu::always_inline]] inline auto norm_excess(const SplitFactor<Q, 1, P>& q) {
  const auto squares = SplitDot<Q, 1, P>::square(q);
  const auto high = sum(squares.high);
  using S = std::remove_cvref_t<decltype(high)>;
  return DoubleWord<S>(high - S(1), sum(squares.low_a));
}

}  // namespace liecheck
