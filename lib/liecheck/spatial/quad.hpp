#pragma once
// Four numbers as one: a quaternion x y z w, or a vector with a fourth number beside it. In one vector register where the
// target has it; a product of quaternions is then four of its products.

#include <liecheck/scalar/compensated.hpp>
#include <liecheck/spatial/pack.hpp>
#include <liecheck/spatial/types.hpp>

namespace liecheck {

namespace quad_detail {

template <Scalar S>
[[gnu::always_inline]] inline S fused(const S& a, const S& b, const S& c) {
  return mul_add(a, b, c);
}

/// One by one: of any scalar.
template <Scalar S>
struct Array4 {
  using Lane = S;
  S v[4];
  Array4() = default;
  [[gnu::always_inline]] Array4(const S& x) : v{x, x, x, x} {}
  [[gnu::always_inline]] Array4(int x) : Array4(S(x)) {}
  [[gnu::always_inline]] Array4(const S& a, const S& b, const S& c, const S& d) : v{a, b, c, d} {}
  template <class F>
  [[gnu::always_inline]] static Array4 each(F f) {
    return Array4(f(0), f(1), f(2), f(3));
  }
  [[gnu::always_inline]] friend Array4 operator+(const Array4& a, const Array4& b) {
    return each([&](int i) { return S(a.v[i] + b.v[i]); });
  }
  [[gnu::always_inline]] friend Array4 operator-(const Array4& a, const Array4& b) {
    return each([&](int i) { return S(a.v[i] - b.v[i]); });
  }
  [[gnu::always_inline]] friend Array4 operator-(const Array4& a) {
    return each([&](int i) { return S(-a.v[i]); });
  }
  [[gnu::always_inline]] friend Array4 operator*(const Array4& a, const Array4& b) {
    return each([&](int i) { return S(a.v[i] * b.v[i]); });
  }
  [[gnu::always_inline]] friend Array4 mul_add(const Array4& a, const Array4& b, const Array4& c) {
    return each([&](int i) { return fused<S>(a.v[i], b.v[i], c.v[i]); });
  }
};

template <class S>
struct Four {
  using type = Array4<S>;
};
template <std::floating_point S>
requires(sizeof(S) * 4 <= register_bytes) struct Four<S> {
  using type = Pack<S, 4>;
};

}  // namespace quad_detail

template <Scalar S>
using Quad = typename quad_detail::Four<S>::type;
/// Is it one register? Then a few of its operations cost little.
template <Scalar S>
inline constexpr bool one_register = !std::is_same_v<Quad<S>, quad_detail::Array4<S>>;

/// (a, b, c, d).
template <Scalar S>
[[gnu::always_inline]] inline Quad<S> quad(const S& a, const S& b, const S& c, const S& d) {
  if constexpr (one_register<S>)
    return typename Quad<S>::Vector{a, b, c, d};
  else
    return Quad<S>(a, b, c, d);
}

/// All four at once, or number N of them: what a formula is written for, see `by_lane`.
struct AllLanes {};
template <int N>
struct OneLane {};

/// (q_I, q_J, q_K, q_L), or number N of that.
template <int I, int J, int K, int L, class Q>
[[gnu::always_inline]] inline Q permute(const Q& q) {
  if constexpr (requires { typename Q::Vector; })
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
[[gnu::always_inline]] inline Cut<Q, BITS, P> at(AllLanes, const Cut<Q, BITS, P>& c) {
  return c;
}
template <int N, class Q, int BITS, Precision P>
[[gnu::always_inline]] inline auto at(OneLane<N>, const Cut<Q, BITS, P>& c) {
  using S = std::remove_cvref_t<decltype(c.value.v[N])>;
  return Cut<S, BITS, P>::of(c.value.v[N], c.head.v[N], c.tail.v[N]);
}

/// (q_I, q_J, q_K, q_L) cut at a fixed place; at `places`; and q + low at those.
template <Precision P, int I, int J, int K, int L, class Lane, class Q>
[[gnu::always_inline]] inline auto cut(Lane lane, const Q& q) {
  const auto a = pick<I, J, K, L>(lane, q);
  return Cut<std::remove_cvref_t<decltype(a)>, 1, P>(a);
}
template <Precision P, int I, int J, int K, int L, class Lane, class Q>
[[gnu::always_inline]] inline auto cut(Lane lane, const Q& q, const Q& places) {
  const auto a = pick<I, J, K, L>(lane, q);
  return Cut<std::remove_cvref_t<decltype(a)>, 1, P>(a, pick<0, 1, 2, 3>(lane, places));
}
template <Precision P, int I, int J, int K, int L, class Lane, class Q>
[[gnu::always_inline]] inline auto cut(Lane lane, const Q& q, const Q& low, const Q& places) {
  const auto a = pick<I, J, K, L>(lane, q);
  return Cut<std::remove_cvref_t<decltype(a)>, 1, P>(a, pick<I, J, K, L>(lane, low),
                                                     pick<0, 1, 2, 3>(lane, places));
}
/// An empty sum of what `lane` holds.
template <Precision P, class Lane, class Q>
[[gnu::always_inline]] inline auto empty_sum(Lane lane, const Q& q) {
  return CutSum<std::remove_cvref_t<decltype(pick<0, 1, 2, 3>(lane, q))>, 1, P>();
}

/// f(lane), a CutSum: of all four where they share a register, else one after another, so that few numbers are in
/// use at a time.
template <Scalar S, Precision P, class F>
[[gnu::always_inline]] inline CutSum<Quad<S>, 1, P> by_lane(F f) {
  if constexpr (one_register<S>) {
    return f(AllLanes());
  } else {
    CutSum<Quad<S>, 1, P> sum;
    const auto set = [&sum](int i, const auto& lane) __attribute__((always_inline)) {
      sum.high.v[i] = lane.high, sum.low_a.v[i] = lane.low();
    };
    set(0, f(OneLane<0>())), set(1, f(OneLane<1>())), set(2, f(OneLane<2>())), set(3, f(OneLane<3>()));
    return sum;
  }
}

/// What is multiplied from the left by a quaternion q [x y z w], each number cut: the product with (r, w') is
///     q r = [w r + v w' + v x r; w w' - v . r].
template <Scalar S, Precision P>
struct LeftFactor {
  using C = Cut<Quad<S>, 1, P>;
  C w_x, self, y, z;  ///< (w w w -x), q, (y z x -y), (z x y z)
  [[gnu::always_inline]] explicit LeftFactor(const Quad<S>& q)
      : w_x(permute<3, 3, 3, 0>(q) * signs()),
        self(q),
        y(permute<1, 2, 0, 1>(q) * signs()),
        z(permute<2, 0, 1, 2>(q)) {}
  [[gnu::always_inline]] static Quad<S> signs() { return quad<S>(S(1), S(1), S(1), S(-1)); }
};

/// q_0 + q_1 + q_2 + q_3.
template <class Q>
[[gnu::always_inline]] inline auto sum(const Q& q) {
  return (q.v[0] + q.v[2]) + (q.v[1] + q.v[3]);
}

}  // namespace liecheck
