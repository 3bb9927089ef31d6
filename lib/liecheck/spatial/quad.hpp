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

#if defined(__AVX__)
constexpr int bytes = 32;
#else
constexpr int bytes = 16;
#endif
template <class S>
struct Four {
  using type = Array4<S>;
};
template <std::floating_point S>
requires(sizeof(S) * 4 <= bytes) struct Four<S> {
  using type = Pack<S, 4>;
};

}  // namespace quad_detail

template <Scalar S>
using Quad = typename quad_detail::Four<S>::type;

/// (a, b, c, d).
template <Scalar S>
[[gnu::always_inline]] inline Quad<S> quad(const S& a, const S& b, const S& c, const S& d) {
  if constexpr (std::is_same_v<Quad<S>, quad_detail::Array4<S>>)
    return Quad<S>(a, b, c, d);
  else
    return typename Quad<S>::Vector{a, b, c, d};
}

/// (q_I, q_J, q_K, q_L).
template <int I, int J, int K, int L, class Q>
[[gnu::always_inline]] inline Q permute(const Q& q) {
  if constexpr (requires { typename Q::Vector; })
    return __builtin_shufflevector(q.v, q.v, I, J, K, L);
  else
    return Q(q.v[I], q.v[J], q.v[K], q.v[L]);
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
