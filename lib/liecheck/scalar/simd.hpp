#pragma once
// N numbers that one operation processes at once, in one vector register if they fit, otherwise in an array.

#include <liecheck/scalar/scalar.hpp>
#include <utility>

namespace liecheck {

/// Size of a vector register of the target [bytes].
#if defined(__AVX__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif

namespace simd_detail {

/// mul_add of S, found by argument-dependent look-up if S has its own.
template <Scalar S>
[[gnu::always_inline]] inline S fused(const S& a, const S& b, const S& c) {
  return mul_add(a, b, c);
}

template <class S, int N>
inline constexpr bool in_register = std::floating_point<S> && sizeof(S) * N <= register_bytes;

template <class S, int N>
struct Storage {
  typedef S type[N];
};
template <class S, int N>
requires in_register<S, N>
struct Storage<S, N> {
  typedef S type __attribute__((vector_size(sizeof(S) * N)));
  typedef S unaligned __attribute__((vector_size(sizeof(S) * N), aligned(sizeof(S)), may_alias));
};

}  // namespace simd_detail

/// N numbers v[i]. In each lane, every operation gives the same bits as the operation on S.
template <class S, int N>
struct Simd {
  using Lane = S;
  using SideBySide = void;
  static constexpr int size = N;
  static constexpr bool in_register = simd_detail::in_register<S, N>;
  using Vector = typename simd_detail::Storage<S, N>::type;
  Vector v;

  Simd() = default;
  /// The same number N times.
  [[gnu::always_inline]] Simd(const S& x) {
    if constexpr (in_register)
      v = x - Vector{};
    else
      *this = each([&](int) -> const S& { return x; });
  }
  [[gnu::always_inline]] Simd(int x) : Simd(S(x)) {}
  Simd(Vector x) requires in_register : v(x) {}
  template <class... A>
  requires(sizeof...(A) == N && N > 1) [[gnu::always_inline]] Simd(const A&... a) : v{a...} {}

  /// load and store accept memory of any alignment.
  [[gnu::always_inline]] static Simd load(const S* from) requires in_register {
    return Vector(*reinterpret_cast<const typename simd_detail::Storage<S, N>::unaligned*>(from));
  }
  [[gnu::always_inline]] void store(S* to) const requires in_register {
    *reinterpret_cast<typename simd_detail::Storage<S, N>::unaligned*>(to) = v;
  }

  [[gnu::always_inline]] friend Simd operator+(const Simd& a, const Simd& b) {
    if constexpr (in_register)
      return a.v + b.v;
    else
      return each([&](int i) __attribute__((always_inline)) { return S(a.v[i] + b.v[i]); });
  }
  [[gnu::always_inline]] friend Simd operator-(const Simd& a, const Simd& b) {
    if constexpr (in_register)
      return a.v - b.v;
    else
      return each([&](int i) __attribute__((always_inline)) { return S(a.v[i] - b.v[i]); });
  }
  [[gnu::always_inline]] friend Simd operator-(const Simd& a) {
    if constexpr (in_register)
      return -a.v;
    else
      return each([&](int i) __attribute__((always_inline)) { return S(-a.v[i]); });
  }
  [[gnu::always_inline]] friend Simd operator*(const Simd& a, const Simd& b) {
    if constexpr (in_register)
      return a.v * b.v;
    else
      return each([&](int i) __attribute__((always_inline)) { return S(a.v[i] * b.v[i]); });
  }
  [[gnu::always_inline]] friend Simd operator/(const Simd& a, const Simd& b) {
    if constexpr (in_register)
      return a.v / b.v;
    else
      return each([&](int i) __attribute__((always_inline)) { return S(a.v[i] / b.v[i]); });
  }
  Simd& operator+=(const Simd& b) { return *this = *this + b; }
  Simd& operator*=(const Simd& b) { return *this = *this * b; }

  /// (f(0), ..., f(N - 1)). The compiler can merge the N operations into one vector instruction.
  template <class F>
  [[gnu::always_inline]] static Simd each(F f) {
    if constexpr (in_register) {
      Simd r;
      for (int i = 0; i < N; ++i) r.v[i] = f(i);
      return r;
    } else {
      return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
        return Simd(f(I)...);
      }
      (std::make_integer_sequence<int, N>());
    }
  }
  /// Argument-dependent look-up chooses it over the generic mul_add. It is fused if mul_add of S is.
  [[gnu::always_inline]] friend Simd mul_add(const Simd& a, const Simd& b, const Simd& c) {
#if defined(__FMA__)
    if constexpr (std::floating_point<S>)
      return each([&](int i) __attribute__((always_inline)) { return std::fma(a.v[i], b.v[i], c.v[i]); });
#endif
    if constexpr (in_register)
      return a.v * b.v + c.v;
    else
      return each([&](int i) __attribute__((always_inline)) {
        return simd_detail::fused<S>(a.v[i], b.v[i], c.v[i]);
      });
  }
  [[gnu::always_inline]] friend Simd sqrt(const Simd& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::sqrt(a.v[i]); });
  }
  [[gnu::always_inline]] friend Simd fabs(const Simd& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::fabs(a.v[i]); });
  }
  [[gnu::always_inline]] friend Simd copysign(const Simd& a, const Simd& b) {
    return each([&](int i) __attribute__((always_inline)) { return std::copysign(a.v[i], b.v[i]); });
  }
  friend Simd sin(const Simd& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::sin(a.v[i]); });
  }
  friend Simd cos(const Simd& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::cos(a.v[i]); });
  }
  friend Simd atan2(const Simd& a, const Simd& b) {
    return each([&](int i) __attribute__((always_inline)) { return std::atan2(a.v[i], b.v[i]); });
  }
  friend Simd ldexp(const Simd& a, int e) {
    return a * Simd(std::ldexp(S(1), e));
  }
  /// isfinite(a) and a < b are true if they hold in all N lanes.
  friend bool isfinite(const Simd& a) {
    bool all = true;
    for (int i = 0; i < N; ++i) all = all && std::isfinite(a.v[i]);
    return all;
  }
  friend bool operator<(const Simd& a, const Simd& b) {
    bool all = true;
    for (int i = 0; i < N; ++i) all = all && a.v[i] < b.v[i];
    return all;
  }
};

}  // namespace liecheck

template <class S, int N>
struct std::numeric_limits<liecheck::Simd<S, N>> : std::numeric_limits<S> {};
