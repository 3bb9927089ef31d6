#pragma once
// The requirements on a scalar type.
//
// The library is written once for float, double and any binary floating-point type with correctly rounded
// + - * / sqrt. Boost's float128 and cpp_bin_float are tested. Mathematical functions are found by
// argument-dependent look-up (`using std::sqrt; sqrt(x)`), so a scalar type provides its own functions.

/// Defined if the target has fused multiply-adds. gcc and clang may then fuse any a * b + c, also one that a proof assumes to
/// be rounded twice, so that the formulas with std::fma are used.
#if defined(__FMA__) || defined(__FP_FAST_FMA) || defined(__ARM_FEATURE_FMA)
#define LIECHECK_FMA
#endif

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

namespace liecheck {

namespace scalar_detail {
using std::atan2, std::cos, std::fabs, std::isfinite, std::ldexp, std::sin, std::sqrt;
template <class S>
concept HasFunctions = requires(const S a) {
  S(sqrt(a));
  S(sin(a));
  S(cos(a));
  S(atan2(a, a));
  S(fabs(a));
  S(ldexp(a, 1));
  bool(isfinite(a));
};
}  // namespace scalar_detail

/// A binary floating-point number. The requirements have these purposes:
/// - numeric_limits: the number of series terms and every threshold follow from digits, epsilon and min;
/// - the operators + - * / <: the formulas;
/// - construction from int: constants are written S(1) / S(6), never as decimal literals;
/// - the elementary functions: angles beyond pi, and logarithms.
template <class S>
concept Scalar = std::numeric_limits<S>::is_specialized && std::numeric_limits<S>::radix == 2 &&
                 !std::numeric_limits<S>::is_integer && std::constructible_from<S, int> &&
                 scalar_detail::HasFunctions<S> && requires(const S a, const S b) {
  S(a + b);
  S(a - b);
  S(a * b);
  S(a / b);
  bool(a < b);
};

namespace scalar_detail {
template <class S>
struct Lane {
  using type = S;
};
template <class S>
requires requires {
  typename S::Lane;
}
struct Lane<S> {
  using type = typename S::Lane;
};
}  // namespace scalar_detail

/// The type of a single number in S: S::Lane if S is a Simd, otherwise S itself.
template <class S>
using Lane = typename scalar_detail::Lane<S>::type;
/// True for a type such as Simd, which holds several numbers and defines S::SideBySide. Functions take no
/// branch for it: the caller ensures that all lanes need only the usual path.
template <class S>
inline constexpr bool side_by_side = requires {
  typename S::SideBySide;
};

/// Unit in the last place of 1: 2^-52 for double. Every error bound of this library is stated in it.
template <Scalar S>
constexpr S eps() {
  return std::numeric_limits<S>::epsilon();
}

/// pi, rounded to S.
template <Scalar S>
S pi() {
  if constexpr (std::is_floating_point_v<S>) return std::numbers::pi_v<S>;
  using std::atan2;
  static const S value = atan2(S(0), S(-1));
  return value;
}

/// |a| as an S, also for scalars whose fabs returns an expression.
template <Scalar S>
[[gnu::always_inline]] inline S absolute(const S& a) {
  using std::fabs;
  return S(fabs(a));
}

/// -1 for a < 0, 1 for a > 0, either at 0. It has no branch for floating-point types, for speed. Float and double take
/// integers: gcc loads two numbers for copysign of one that it has just stored, which stalls.
template <Scalar S>
[[gnu::always_inline]] inline S sign(const S& a) {
  if constexpr (std::is_same_v<S, double>) {
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a) & 0x8000000000000000u) |
                                 0x3ff0000000000000u);
  } else if constexpr (std::is_same_v<S, float>) {
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & 0x80000000u) | 0x3f800000u);
  } else if constexpr (std::is_floating_point_v<Lane<S>>) {
    using std::copysign;
    return copysign(S(1), a);
  } else {
    return a < S(0) ? S(-1) : S(1);
  }
}

template <Scalar S>
[[gnu::always_inline]] inline bool finite(const S& a) {
  using std::isfinite;
  return bool(isfinite(a));
}

/// a * b + c, rounded once if the target has the instruction, otherwise twice. Error bounds hold for both.
template <Scalar S>
[[gnu::always_inline]] inline S mul_add(const S& a, const S& b, const S& c) {
#if defined(LIECHECK_FMA)
  if constexpr (std::is_floating_point_v<S>) return std::fma(a, b, c);
#endif
  return a * b + c;
}

}  // namespace liecheck
