#pragma once
// N numbers side by side, each what S itself would be: the compiler keeps them in one vector register.

#include <liecheck/scalar/scalar.hpp>

namespace liecheck {

/// What one vector register of the target holds [bytes].
#if defined(__AVX__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif

namespace pack_detail {
template <class S, int N>
struct Register {
  typedef S type __attribute__((vector_size(sizeof(S) * N)));
  typedef S anywhere __attribute__((vector_size(sizeof(S) * N), aligned(sizeof(S)), may_alias));
};
}  // namespace pack_detail

template <std::floating_point S, int N>
struct Pack {
  using Lane = S;
  using SideBySide = void;
  using Vector = typename pack_detail::Register<S, N>::type;
  Vector v;

  Pack() = default;
  Pack(Vector x) : v(x) {}
  Pack(S x) : v(x - Vector{}) {}
  Pack(int x) : Pack(S(x)) {}

  /// N numbers from, and to, memory: one access, wherever they lie.
  [[gnu::always_inline]] static Pack load(const S* from) {
    return Vector(*reinterpret_cast<const typename pack_detail::Register<S, N>::anywhere*>(from));
  }
  [[gnu::always_inline]] void store(S* to) const {
    *reinterpret_cast<typename pack_detail::Register<S, N>::anywhere*>(to) = v;
  }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) { return a.v + b.v; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) { return a.v - b.v; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return -a.v; }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) { return a.v * b.v; }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) { return a.v / b.v; }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }

  /// Entry by entry: what a compiler makes one instruction of.
  template <class F>
  [[gnu::always_inline]] static Pack each(F f) {
    Pack r;
    for (int i = 0; i < N; ++i) r.v[i] = f(i);
    return r;
  }
  /// The library's, found first by argument-dependent look-up: fused where S's is.
  [[gnu::always_inline]] friend Pack mul_add(const Pack& a, const Pack& b, const Pack& c) {
#if defined(__FMA__)
    return each([&](int i) __attribute__((always_inline)) { return std::fma(a.v[i], b.v[i], c.v[i]); });
#else
    return a.v * b.v + c.v;
#endif
  }
  [[gnu::always_inline]] friend Pack sqrt(const Pack& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::sqrt(a.v[i]); });
  }
  [[gnu::always_inline]] friend Pack fabs(const Pack& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::fabs(a.v[i]); });
  }
  [[gnu::always_inline]] friend Pack copysign(const Pack& a, const Pack& b) {
    return each([&](int i) __attribute__((always_inline)) { return std::copysign(a.v[i], b.v[i]); });
  }
  friend bool isfinite(const Pack& a) {
    bool all = true;
    for (int i = 0; i < N; ++i) all = all && std::isfinite(a.v[i]);
    return all;
  }
  /// In every one of them.
  friend bool operator<(const Pack& a, const Pack& b) {
    bool all = true;
    for (int i = 0; i < N; ++i) all = all && a.v[i] < b.v[i];
    return all;
  }
  friend Pack sin(const Pack& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::sin(a.v[i]); });
  }
  friend Pack cos(const Pack& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::cos(a.v[i]); });
  }
  friend Pack atan2(const Pack& a, const Pack& b) {
    return each([&](int i) __attribute__((always_inline)) { return std::atan2(a.v[i], b.v[i]); });
  }
  friend Pack ldexp(const Pack& a, int e) {
    return a * Pack(std::ldexp(S(1), e));
  }
};

}  // namespace liecheck

template <class S, int N>
struct std::numeric_limits<liecheck::Pack<S, N>> : std::numeric_limits<S> {};
