#pragma once
// N numbers that one operation processes at once, in one vector register or two if they fit, otherwise in an
// array.

#include <liecheck/scalar/scalar.hpp>
#include <utility>
#if defined(__FMA__)
#include <immintrin.h>
#endif

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
inline constexpr bool fits = std::floating_point<S> && sizeof(S) <= 8 && sizeof(S) * N <= register_bytes;

template <class S, int N>
struct Storage {
  typedef S type[N];
  static constexpr bool in_register = false, in_halves = false;
};
template <class S, int N>
requires fits<S, N>
struct Storage<S, N> {
  static constexpr bool in_register = true, in_halves = false;
  typedef S type __attribute__((vector_size(sizeof(S) * N)));
  typedef S unaligned __attribute__((vector_size(sizeof(S) * N), aligned(sizeof(S)), may_alias));
};
/// Two registers.
template <class S, int N>
requires(!fits<S, N> && N % 2 == 0 && fits<S, N / 2>) struct Storage<S, N> {
  static constexpr bool in_register = false, in_halves = true;
  struct type {
    typename Storage<S, N / 2>::type low, high;
    [[gnu::always_inline]] S operator[](int i) const { return i < N / 2 ? low[i] : high[i - N / 2]; }
  };
};

}  // namespace simd_detail

/// N numbers v[i]. In each lane, every operation gives the same bits as the operation on S.
template <class S, int N>
struct Simd {
  using Lane = S;
  using SideBySide = void;
  static constexpr int size = N;
  using Storage = simd_detail::Storage<S, N>;
  static constexpr bool in_register = Storage::in_register, in_halves = Storage::in_halves;
  using Vector = typename Storage::type;
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
  [[gnu::always_inline]] Simd(const Vector& x) requires(in_register || in_halves) : v(x) {}
  template <class... A>
  requires(sizeof...(A) == N && N > 1 && !in_halves) [[gnu::always_inline]] Simd(const A&... a) : v{a...} {}
  template <class... A>
  requires(sizeof...(A) == N && in_halves) [[gnu::always_inline]] Simd(const A&... a) {
    const S all[N] = {a...};
    for (int i = 0; i < N / 2; ++i) v.low[i] = all[i], v.high[i] = all[i + N / 2];
  }

  /// load and store accept memory of any alignment.
  [[gnu::always_inline]] static Simd load(const S* from) requires in_register {
    return Vector(*reinterpret_cast<const typename Storage::unaligned*>(from));
  }
  [[gnu::always_inline]] void store(S* to) const requires in_register {
    *reinterpret_cast<typename Storage::unaligned*>(to) = v;
  }

  [[gnu::always_inline]] friend Simd operator+(const Simd& a, const Simd& b) {
    return by_register(
        [](const auto& x, const auto& y) __attribute__((always_inline)) { return x + y; }, a, b);
  }
  [[gnu::always_inline]] friend Simd operator-(const Simd& a, const Simd& b) {
    return by_register(
        [](const auto& x, const auto& y) __attribute__((always_inline)) { return x - y; }, a, b);
  }
  [[gnu::always_inline]] friend Simd operator-(const Simd& a) {
    return by_register(
        [](const auto& x) __attribute__((always_inline)) { return -x; }, a);
  }
  [[gnu::always_inline]] friend Simd operator*(const Simd& a, const Simd& b) {
    return by_register(
        [](const auto& x, const auto& y) __attribute__((always_inline)) { return x * y; }, a, b);
  }
  [[gnu::always_inline]] friend Simd operator/(const Simd& a, const Simd& b) {
    return by_register(
        [](const auto& x, const auto& y) __attribute__((always_inline)) { return x / y; }, a, b);
  }
  Simd& operator+=(const Simd& b) { return *this = *this + b; }
  Simd& operator*=(const Simd& b) { return *this = *this * b; }

  /// f of the registers of a, or of its numbers if they are in an array.
  template <class F, class... A>
  [[gnu::always_inline]] static Simd by_register(F f, const A&... a) {
    if constexpr (in_register)
      return Vector(f(a.v...));
    else if constexpr (in_halves)
      return Vector{f(a.v.low...), f(a.v.high...)};
    else
      return each([&](int i) __attribute__((always_inline)) { return S(f(a.v[i]...)); });
  }
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
    // gcc splits a vector that is made of fused numbers if not all of them are used.
    if constexpr (std::is_same_v<S, double> && N == 4) return Vector(_mm256_fmadd_pd(a.v, b.v, c.v));
    if constexpr (std::is_same_v<S, double> && N == 2) return Vector(_mm_fmadd_pd(a.v, b.v, c.v));
#endif
#if defined(LIECHECK_FMA)
    if constexpr (std::floating_point<S>)
      return each([&](int i) __attribute__((always_inline)) { return std::fma(a.v[i], b.v[i], c.v[i]); });
#endif
    if constexpr (in_register || in_halves)
      return a * b + c;
    else
      return each([&](int i) __attribute__((always_inline)) {
        return simd_detail::fused<S>(a.v[i], b.v[i], c.v[i]);
      });
  }
  [[gnu::always_inline]] friend Simd sqrt(const Simd& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::sqrt(a.v[i]); });
  }
  [[gnu::always_inline]] friend Simd fabs(const Simd& a) {
    if constexpr (in_register || in_halves)
      return by_register(
          [](const auto& x) __attribute__((always_inline)) { return x < 0 ? -x : x; }, a);
    else
      return each([&](int i) __attribute__((always_inline)) {
        using std::fabs;
        return S(fabs(a.v[i]));
      });
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

namespace simd_detail {

/// The largest register of at most n numbers.
template <class S>
constexpr int widest(int n) {
  int width = 1;
  while (2 * width <= n && std::floating_point<S> && int(sizeof(S)) * 2 * width <= register_bytes) width *= 2;
  return width;
}
template <int FROM, int N, class S>
[[gnu::always_inline]] inline void store_from(S* to, const S (&numbers)[N]) {
  if constexpr (constexpr int width = widest<S>(N), rest = N - FROM; rest == 1) {
    to[FROM] = numbers[FROM];
  } else if constexpr (rest > 1) {
    // The last block overlaps the one before unless a narrower register holds it.
    constexpr int used = rest >= width ? width : widest<S>(rest) == rest ? rest : width;
    constexpr int begin = rest < used ? N - used : FROM;
    [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
      if constexpr (used == 1)
        to[begin] = numbers[begin];
      else
        Simd<S, used>(numbers[begin + I]...).store(to + begin);
    }
    (std::make_integer_sequence<int, used>());
    store_from<begin + used>(to, numbers);
  }
}

}  // namespace simd_detail

/// Writes numbers to memory in the widest registers, as the caller will probably copy them: a wide load of
/// numbers that were just stored one by one would stall (failed store forwarding).
template <class S, class... A>
[[gnu::always_inline]] inline void store_wide(S* to, const A&... numbers) {
  const S all[] = {numbers...};
  simd_detail::store_from<0>(to, all);
}

}  // namespace liecheck

template <class S, int N>
struct std::numeric_limits<liecheck::Simd<S, N>> : std::numeric_limits<S> {};
