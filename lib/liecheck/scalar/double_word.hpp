#pragma once
// A double word is a number stored as the unevaluated sum high + low. Error-free transformations return
// double words: Dekker (1971); Knuth, The Art of Computer Programming 2, 4.2.2; Ogita, Rump & Oishi (2005).

#include <compare>
#include <liecheck/scalar/scalar.hpp>
#include <limits>

namespace liecheck {

template <Scalar S>
struct DoubleWord;

/// x in the format of S, a scalar or Simd. The registers of x87 hold 64 binary digits of a result that an error-free
/// transformation has to see rounded.
template <class S>
[[gnu::always_inline]] inline S stored(S x) {
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
  if constexpr (std::is_trivially_copyable_v<S>) asm("" : "+m"(x));
#endif
  return x;
}

/// a + b exactly, high = fl(a + b). Knuth, theorem B. Precondition: no overflow. On x87, which rounds twice, low is exact
/// up to a few eps of low: Boldo, Graillat & Muller (2017).
template <Scalar S>
DoubleWord<S> two_sum(const S& a, const S& b) {
  const S s = stored<S>(a + b);
  const S b_virtual = s - a;
  const S a_virtual = s - b_virtual;
  return {s, stored<S>((a - a_virtual) + (b - b_virtual))};
}

/// a + b exactly, high = fl(a + b), for |a| >= |b| or a = 0. Dekker (1971).
template <Scalar S>
DoubleWord<S> fast_two_sum(const S& a, const S& b) {
  const S s = stored<S>(a + b);
  return {s, stored<S>(b - (s - a))};
}

/// a = high + low exactly, each with half the digits. Veltkamp (1968). Domain: |a| < max / 2^(digits/2 + 1).
template <Scalar S>
DoubleWord<S> split(const S& a) {
  using std::ldexp;
  constexpr int half = (std::numeric_limits<S>::digits + 1) / 2;
  static const S factor = S(ldexp(S(1), half)) + S(1);
  const S c = stored<S>(factor * a);
  const S high = stored<S>(c - stored<S>(c - a));
  return {high, a - high};
}

/// a b exactly, high = fl(a b). Dekker (1971), eq. 5.14. Precondition: no overflow, no underflow.
template <Scalar S>
DoubleWord<S> two_prod(const S& a, const S& b) {
  const S p = stored<S>(a * b);
#if defined(LIECHECK_FMA)
  if constexpr (std::is_floating_point_v<S>) return {p, std::fma(a, b, -p)};
#endif
  const auto [ah, al] = split(a);
  const auto [bh, bl] = split(b);
  return {p, stored<S>(((ah * bh - p) + ah * bl + al * bh) + al * bl)};
}

/// high + low with |low| <= eps/2 |high|: a scalar with twice the digits of S. The error bounds of Joldes,
/// Muller & Popescu (2017) hold: a few units of 2^(-2 digits) for + - * / and sqrt.
template <Scalar S>
struct DoubleWord {
  S high, low;

  DoubleWord() = default;
  constexpr DoubleWord(int a) : high(a), low(0) {}
  constexpr DoubleWord(const S& a) : high(a), low(0) {}
  constexpr DoubleWord(const S& a, const S& b) : high(a), low(b) {}
  explicit operator S() const { return high + low; }

  friend DoubleWord operator-(const DoubleWord& a) { return {-a.high, -a.low}; }
  friend DoubleWord operator+(const DoubleWord& a, const DoubleWord& b) {
    const auto [s, se] = two_sum(a.high, b.high);
    const auto [t, te] = two_sum(a.low, b.low);
    const DoubleWord r = fast_two_sum<S>(s, se + t);
    return fast_two_sum<S>(r.high, r.low + te);
  }
  friend DoubleWord operator-(const DoubleWord& a, const DoubleWord& b) { return a + (-b); }
  friend DoubleWord operator*(const DoubleWord& a, const DoubleWord& b) {
    const auto [p, e] = two_prod(a.high, b.high);
    return fast_two_sum<S>(p, e + (a.high * b.low + a.low * b.high));
  }
  friend DoubleWord operator/(const DoubleWord& a, const DoubleWord& b) {
    const S q = a.high / b.high;
    const DoubleWord remainder = a - b * DoubleWord(q);
    return fast_two_sum<S>(q, S(remainder) / b.high);
  }
  DoubleWord& operator+=(const DoubleWord& b) { return *this = *this + b; }
  DoubleWord& operator-=(const DoubleWord& b) { return *this = *this - b; }
  DoubleWord& operator*=(const DoubleWord& b) { return *this = *this * b; }
  DoubleWord& operator/=(const DoubleWord& b) { return *this = *this / b; }
  friend auto operator<=>(const DoubleWord&, const DoubleWord&) = default;

  friend DoubleWord fabs(const DoubleWord& a) { return a.high < S(0) ? -a : a; }
  friend DoubleWord ldexp(const DoubleWord& a, int e) {
    using std::ldexp;
    return {S(ldexp(a.high, e)), S(ldexp(a.low, e))};
  }
  friend DoubleWord abs(const DoubleWord& a) { return fabs(a); }
  friend DoubleWord frexp(const DoubleWord& a, int* e) {
    using std::frexp;
    static_cast<void>(frexp(a.high, e));
    return ldexp(a, -*e);
  }
  friend bool isfinite(const DoubleWord& a) { return finite<S>(a.high); }
  friend DoubleWord sqrt(const DoubleWord& a) {
    using std::sqrt;
    const S r = sqrt(a.high);
    if (!(r > S(0)) || !finite<S>(r)) return DoubleWord(r);
    return fast_two_sum<S>(r, S(a - DoubleWord(r) * DoubleWord(r)) / (S(2) * r));
  }
  /// Accurate to the digits of S, which suffices up to theta = pi. sin^2 + cos^2 = 1 to twice those digits.
  friend DoubleWord sin(const DoubleWord& a) { return SineAndCosine(a).sine; }
  friend DoubleWord cos(const DoubleWord& a) { return SineAndCosine(a).cosine; }
  /// Accurate to the digits of S only.
  friend DoubleWord atan2(const DoubleWord& y, const DoubleWord& x) {
    using std::atan2;
    return DoubleWord(S(atan2(y.high, x.high)));
  }

 private:
  /// Uses the addition theorems, since low is many radians if high is huge. One Newton step normalises.
  struct SineAndCosine {
    DoubleWord sine, cosine;
    explicit SineAndCosine(const DoubleWord& a) {
      using std::cos, std::sin;
      const S s = sin(a.high), c = cos(a.high), s_low = sin(a.low), c_low = cos(a.low);
      sine = DoubleWord(S(s * c_low + c * s_low)), cosine = DoubleWord(S(c * c_low - s * s_low));
      const DoubleWord scale = (DoubleWord(3) - (sine * sine + cosine * cosine)) / DoubleWord(2);
      sine *= scale, cosine *= scale;
    }
  };
};

}  // namespace liecheck

template <class S>
struct std::numeric_limits<liecheck::DoubleWord<S>> : std::numeric_limits<S> {
  using T = liecheck::DoubleWord<S>;
  static constexpr int digits = 2 * std::numeric_limits<S>::digits;
  static constexpr T epsilon() {
    return T(std::numeric_limits<S>::epsilon() * std::numeric_limits<S>::epsilon() / 2);
  }
  static constexpr T min() { return T(std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon()); }
  static constexpr T max() { return T(std::numeric_limits<S>::max()); }
};
