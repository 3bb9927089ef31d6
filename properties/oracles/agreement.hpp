#pragma once
// When do two formulas of an oracle agree?
//
// An oracle's value comes from one formula at 100 digits and is resolved when another formula, at 50 digits,
// agrees with it block by block to `agreement` = 1e-41 of the block: seven digits below the eps of float128,
// 25 below that of double. Where 50 digits are too few for the second formula (huge angles, cancelling blocks
// near 2 pi), it is evaluated again at 100 digits. If the two still differ the value is unresolved, and no verdict
// is based on it.

#include <oracles/linear_algebra.hpp>

namespace liecheck::oracles {

/// Relative, per block.
inline constexpr double agreement = 1e-41;

/// ||a - b|| <= bound max(||b||, scale). False for NaN.
template <int N, class T>
bool agree(const Vec<N, T>& a, const Vec<N, T>& b, double bound = agreement, const T& scale = T(0)) {
  const T size = norm(b);
  return norm(a - b) <= T(bound) * (scale > size ? scale : size);
}
template <int R, int C, class T>
bool agree(const Mat<R, C, T>& a, const Mat<R, C, T>& b, double bound = agreement, const T& scale = T(0)) {
  const T size = frobenius(b);
  return frobenius(a - b) <= T(bound) * (scale > size ? scale : size);
}
template <OracleNumber T>
bool agree(const T& a, const T& b, double bound = agreement, const T& scale = T(0)) {
  const T size = abs(b);
  return abs(a - b) <= T(bound) * (scale > size ? scale : size);
}

/// check(Real{}) or else check(Real100{}): the second formula, at 50 digits where that is enough.
template <class Check>
bool confirmed(bool fifty_digits_may_suffice, Check&& check) {
  return (fifty_digits_may_suffice && check(Real())) || check(Real100());
}

}  // namespace liecheck::oracles
