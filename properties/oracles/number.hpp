#pragma once
// Operations on the oracles' number types (Real, Real100 and balls): exact conversion, product and maximum.

#include <boost/multiprecision/float128.hpp>
#include <cmath>
#include <limits>
#include <oracles/ball_arithmetic.hpp>
#include <oracles/real.hpp>
#include <type_traits>

namespace liecheck::oracles {

/// A number that is stored with a bound of its error.
template <class T>
concept BallNumber =
    std::is_same_v<T, DoubleBall> || std::is_same_v<T, DoubleDoubleBall> || std::is_same_v<T, RealBall>;
template <class T>
concept OracleNumber = std::is_same_v<T, Real> || std::is_same_v<T, Real100> || BallNumber<T>;

/// Mantissa bits of an oracle type.
template <OracleNumber T>
inline constexpr int bits = std::numeric_limits<T>::digits10 > 60 ? 334 : 168;
template <BallNumber T>
inline constexpr int bits<T> = T::Round::bits;

/// x converted to T. The conversion is exact if S has at most 168 bits (float, double, float128 and Real).
/// NaN and infinities are preserved.
template <class T, class S>
T exact(const S& x) {
  if constexpr (std::is_same_v<S, T>) {
    return x;
  } else if constexpr (BallNumber<S>) {  // only the midpoint: stored numbers have radius 0
    if constexpr (std::is_same_v<S, RealBall>)
      return T(x.m);
    else
      return T(S::Round::head(x.m)) + T(S::Round::tail(x.m));
  } else if constexpr (std::is_same_v<S, Real> || std::is_same_v<S, Real100> || std::is_floating_point_v<S>) {
    return T(x);
  } else {
    if (!isfinite(x)) return T(static_cast<double>(x));
    int exponent = 0;
    S remainder = frexp(x, &exponent);
    T sum(0);
    while (remainder != S(0)) {  // at most 53 bits at a time; each subtraction is exact
      const double chunk = static_cast<double>(remainder);
      sum += T(chunk);
      remainder -= S(chunk);
    }
    return ldexp(sum, exponent);
  }
}

/// r = a b without a temporary.
template <class T>
[[gnu::always_inline]] inline void set_product(T& r, const T& a, const T& b) {
  if constexpr (BallNumber<T>) {
    r = a * b;
  } else {
    using boost::multiprecision::default_ops::eval_multiply;
    eval_multiply(r.backend(), a.backend(), b.backend());
  }
}

/// max(a, b) and min(a, b). Balls throw Undecided only if they overflowed: |max(a, b) - max(a.m, b.m)| is at
/// most max(a.r, b.r).
template <class T>
T larger(const T& a, const T& b) {
  if constexpr (BallNumber<T>) {
    if (!std::isfinite(a.head() + a.r + b.head() + b.r)) throw Undecided();
    return {a.head() > b.head() ? a.m : b.m,
            std::fmax(a.r, b.r) + 0x1p-51 * std::fabs(a.head() == b.head() ? a.head() : 0)};
  } else {
    return a > b ? a : b;
  }
}
template <class T>
T smaller(const T& a, const T& b) {
  return -larger<T>(-a, -b);
}

/// The smallest e with |x| < 2^e; a large negative number for x = 0.
template <class T>
inline int exponent_of(const T& x) {
  if constexpr (BallNumber<T>)
    return x.head() == 0 ? std::numeric_limits<int>::min() / 2 : std::ilogb(x.head()) + 1;
  else {
    if (x == 0) return std::numeric_limits<int>::min() / 2;
    int e = 0;
    frexp(x, &e);
    return e;
  }
}

}  // namespace liecheck::oracles
