#pragma once
// Pack<S, N>: one number of each of N columns, in one vector register. The library's formulas accept it as
// their scalar. Each lane gives the same bits as S with the same instructions. Only code compiled for a
// register of that size may use it (instructions.hpp).

#include <cmath>
#include <liecheck/scalar/scalar.hpp>

namespace liecheck::batch {

namespace detail {
template <class S, int N>
struct Register {
  typedef S type __attribute__((vector_size(sizeof(S) * N)));
  typedef S unaligned __attribute__((vector_size(sizeof(S) * N), aligned(sizeof(S)), may_alias));
};
}  // namespace detail

template <class S, int N>
struct Pack {
  using Lane = S;
  using SideBySide = void;  // no branch: the caller sees to the lanes that need one
  static constexpr int size = N;
  using Vector = typename detail::Register<S, N>::type;
  using Unaligned = typename detail::Register<S, N>::unaligned;
  using Mask = decltype(Vector() < Vector());  ///< -1 in lanes where a condition holds, 0 elsewhere
  Vector v;

  Pack() = default;
  [[gnu::always_inline]] Pack(const S& x) : v(x - Vector{}) {}
  [[gnu::always_inline]] Pack(int x) : Pack(S(x)) {}
  [[gnu::always_inline]] Pack(const Vector& x) : v(x) {}

  [[gnu::always_inline]] static Pack load(const S* from) {
    return Vector(*reinterpret_cast<const Unaligned*>(from));
  }
  [[gnu::always_inline]] void store(S* to) const { *reinterpret_cast<Unaligned*>(to) = v; }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) { return a.v + b.v; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) { return a.v - b.v; }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) { return a.v * b.v; }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) { return a.v / b.v; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return -a.v; }
  [[gnu::always_inline]] Pack& operator+=(const Pack& b) { return *this = *this + b; }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) { return *this = *this - b; }
  [[gnu::always_inline]] Pack& operator*=(const Pack& b) { return *this = *this * b; }
  [[gnu::always_inline]] Pack& operator/=(const Pack& b) { return *this = *this / b; }
  /// True if a condition holds in all lanes.
  [[gnu::always_inline]] friend bool operator<(const Pack& a, const Pack& b) { return all(a.v < b.v); }
  [[gnu::always_inline]] friend bool operator==(const Pack& a, const Pack& b) { return all(a.v == b.v); }
  [[gnu::always_inline]] friend bool operator>(const Pack& a, const Pack& b) { return b < a; }
  [[gnu::always_inline]] static Mask less(const Pack& a, const Pack& b) { return a.v < b.v; }
  [[gnu::always_inline]] static Pack select(const Mask& mask, const Pack& a, const Pack& b) {
    return Vector(mask ? a.v : b.v);
  }
  [[gnu::always_inline]] static bool any(const Mask& mask) { return !all(~mask); }
  [[gnu::always_inline]] static bool all(const Mask& mask) {
    auto every = mask[0];
    for (int i = 1; i < N; ++i) every &= mask[i];
    return every != 0;
  }

  /// (f(0), ..., f(N - 1)), which compilers merge into one instruction.
  template <class F>
  [[gnu::always_inline]] static Pack each(F f) {
    Pack r;
    for (int i = 0; i < N; ++i) r.v[i] = f(i);
    return r;
  }
  /// Rounded twice in every set of instructions. A fused cross(v, v) would not be 0.
  [[gnu::always_inline]] friend Pack mul_add(const Pack& a, const Pack& b, const Pack& c) {
    return a.v * b.v + c.v;
  }
  [[gnu::always_inline]] friend Pack sqrt(const Pack& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::sqrt(a.v[i]); });
  }
  [[gnu::always_inline]] friend Pack fabs(const Pack& a) {
    return each([&](int i) __attribute__((always_inline)) { return std::fabs(a.v[i]); });
  }
  [[gnu::always_inline]] friend Pack abs(const Pack& a) { return fabs(a); }
  [[gnu::always_inline]] friend Pack copysign(const Pack& a, const Pack& b) {
    return each([&](int i) __attribute__((always_inline)) { return std::copysign(a.v[i], b.v[i]); });
  }
  [[gnu::always_inline]] friend Pack ldexp(const Pack& a, int e) { return a * Pack(std::ldexp(S(1), e)); }
  [[gnu::always_inline]] friend Pack sin(const Pack& a) {
    return each([&](int i) { return std::sin(a.v[i]); });
  }
  [[gnu::always_inline]] friend Pack cos(const Pack& a) {
    return each([&](int i) { return std::cos(a.v[i]); });
  }
  [[gnu::always_inline]] friend Pack atan2(const Pack& a, const Pack& b) {
    return each([&](int i) { return std::atan2(a.v[i], b.v[i]); });
  }
  [[gnu::always_inline]] friend bool isfinite(const Pack& a) { return all(a.v - a.v == Vector{}); }
};

}  // namespace liecheck::batch

template <class S, int N>
struct std::numeric_limits<liecheck::batch::Pack<S, N>> : std::numeric_limits<S> {};
