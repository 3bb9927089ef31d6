#pragma once
// A number as the unevaluated sum of two: twice the digits of S, for what is rounded at the end (Dekker 1971;
// Joldes, Muller & Popescu 2017, whose error bounds of a few units of 2^(-2 digits) hold).

#include <compare>
#include <liecheck/scalar/compensated.hpp>

namespace liecheck {

template <Scalar S>
struct DoubleDouble {
  S high, low;

  DoubleDouble() = default;
  constexpr DoubleDouble(int a) : high(a), low(0) {}
  constexpr DoubleDouble(const S& a) : high(a), low(0) {}
  constexpr DoubleDouble(const S& a, const S& b) : high(a), low(b) {}
  explicit operator S() const { return high + low; }

  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const auto [s, se] = two_sum(a.high, b.high);
    const auto [t, te] = two_sum(a.low, b.low);
    const DoubleDouble r = fast(s, se + t);
    return fast(r.high, r.low + te);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const auto [p, e] = two_product(a.high, b.high);
    return fast(p, e + (a.high * b.low + a.low * b.high));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const S q = a.high / b.high;
    const DoubleDouble rest = a - b * DoubleDouble(q);
    return fast(q, S(rest) / b.high);
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }
  friend auto operator<=>(const DoubleDouble&, const DoubleDouble&) = default;

  friend DoubleDouble fabs(const DoubleDouble& a) { return a.high < S(0) ? -a : a; }
  friend DoubleDouble ldexp(const DoubleDouble& a, int e) {
    using std::ldexp;
    return {S(ldexp(a.high, e)), S(ldexp(a.low, e))};
  }
  friend DoubleDouble abs(const DoubleDouble& a) { return fabs(a); }
  friend DoubleDouble frexp(const DoubleDouble& a, int* e) {
    using std::frexp;
    static_cast<void>(frexp(a.high, e));
    return ldexp(a, -*e);
  }
  friend bool isfinite(const DoubleDouble& a) { return finite<S>(a.high); }
  friend DoubleDouble sqrt(const DoubleDouble& a) {
    using std::sqrt;
    const S r = sqrt(a.high);
    if (!(r > S(0)) || !finite<S>(r)) return DoubleDouble(r);
    return fast(r, S(a - DoubleDouble(r) * DoubleDouble(r)) / (S(2) * r));
  }
  /// To the digits of S only, nothing up to half a turn takes them; but sin^2 + cos^2 = 1 to twice those.
  friend DoubleDouble sin(const DoubleDouble& a) { return sin_cos(a).first; }
  friend DoubleDouble cos(const DoubleDouble& a) { return sin_cos(a).second; }
  friend DoubleDouble atan2(const DoubleDouble& y, const DoubleDouble& x) {
    using std::atan2;
    return DoubleDouble(S(atan2(y.high, x.high)));
  }

 private:
  /// By the sum of angles, since of huge ones low is many radians; then one Newton step of the norm.
  static std::pair<DoubleDouble, DoubleDouble> sin_cos(const DoubleDouble& a) {
    using std::cos, std::sin;
    const S s = sin(a.high), c = cos(a.high), s_low = sin(a.low), c_low = cos(a.low);
    const DoubleDouble sine(S(s * c_low + c * s_low)), cosine(S(c * c_low - s * s_low));
    const DoubleDouble scale = (DoubleDouble(3) - (sine * sine + cosine * cosine)) / DoubleDouble(2);
    return {sine * scale, cosine * scale};
  }
  static DoubleDouble fast(const S& a, const S& b) {
    const S s = a + b;
    return {s, b - (s - a)};
  }
};

}  // namespace liecheck

template <class S>
struct std::numeric_limits<liecheck::DoubleDouble<S>> : std::numeric_limits<S> {
  using T = liecheck::DoubleDouble<S>;
  static constexpr int digits = 2 * std::numeric_limits<S>::digits;
  static constexpr T epsilon() {
    return T(std::numeric_limits<S>::epsilon() * std::numeric_limits<S>::epsilon() / 2);
  }
  static constexpr T min() { return T(std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon()); }
  static constexpr T max() { return T(std::numeric_limits<S>::max()); }
};
