#pragma once
// The oracles' numbers: binary floating point of 50 and of 100 decimal digits (168 and 334 bits), on the
// stack, with MPFR's exponent range of +-2^30, so that no operation under- or overflows.
//
// Every function of this folder is thread safe: the only mutable state is MPFR's thread-local caches.

#include <boost/multiprecision/float128.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <limits>
#include <oracles/ball_arithmetic.hpp>
#include <type_traits>

namespace liecheck::oracles {

template <unsigned Digits>
using Decimal = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<Digits, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

using Real = Decimal<50>;
using Real100 = Decimal<100>;

/// A number that carries its own error bound.
template <class T>
concept BallNumber = std::is_same_v<T, DoubleBall> || std::is_same_v<T, DoubleDoubleBall>;
template <class T>
concept OracleNumber = std::is_same_v<T, Real> || std::is_same_v<T, Real100> || BallNumber<T>;

/// Mantissa bits of an oracle type.
template <OracleNumber T>
inline constexpr int bits = std::numeric_limits<T>::digits10 > 60 ? 334 : 168;
template <BallNumber T>
inline constexpr int bits<T> = T::Round::bits;

/// x in another scalar, without rounding for every scalar of at most 168 bits (float, double, float128 and
/// Real). NaN and infinities stay what they are.
template <class T, class S>
T exact(const S& x) {
  if constexpr (std::is_same_v<S, T>) {
    return x;
  } else if constexpr (BallNumber<S>) {  // the midpoint: stored numbers have radius 0
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

/// r = a b, without the temporary that operator* makes.
template <class T>
inline void set_product(T& r, const T& a, const T& b) {
  if constexpr (BallNumber<T>) {
    r = a * b;
  } else {
    using boost::multiprecision::default_ops::eval_multiply;
    eval_multiply(r.backend(), a.backend(), b.backend());
  }
}

/// max(a, b) and min(a, b). Balls are not compared: the radius of the result covers either choice.
template <class T>
T larger(const T& a, const T& b) {
  if constexpr (BallNumber<T>) {
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

inline void sin_cos(const Real& x, Real& sine, Real& cosine) {
  mpfr_sin_cos(sine.backend().data(), cosine.backend().data(), x.backend().data(), MPFR_RNDN);
}
inline void sin_cos(const Real100& x, Real100& sine, Real100& cosine) {
  mpfr_sin_cos(sine.backend().data(), cosine.backend().data(), x.backend().data(), MPFR_RNDN);
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
