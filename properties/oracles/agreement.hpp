#pragma once
// Agreement of two formulas of an oracle.
//
// The value of an oracle comes from one formula at 100 digits. It is resolved if a second formula at
// 50 digits agrees with it to a relative 1e-41 in each block, which is 7 digits below the eps of float128 and
// 25 below that of double. The second formula is evaluated again at 100 digits if 50 are too few: at huge
// angles, and for blocks that cancel near 2 pi. If the two formulas still differ, the value is unresolved and
// no verdict uses it.

#include <oracles/linear_algebra.hpp>

namespace liecheck::oracles {

/// The tolerance of the agreement, relative to the norm of a block.
inline constexpr double agreement = 1e-41;

/// ||a - b|| <= bound max(||b||, scale). False for NaN.
template <int R, int C, class T>
bool agree(const Mat<R, C, T>& a, const Mat<R, C, T>& b, double bound = agreement, const T& scale = T(0)) {
  const T size = norm(b);
  return norm(a - b) <= T(bound) * (scale > size ? scale : size);
}
template <OracleNumber T>
bool agree(const T& a, const T& b, double bound = agreement, const T& scale = T(0)) {
  const T size = abs(b);
  return abs(a - b) <= T(bound) * (scale > size ? scale : size);
}

/// Does the second formula agree? Tries check(Real()) if 50 digits may suffice, and then check(Real100()).
template <class Check>
bool confirmed(bool fifty_digits_may_suffice, Check&& check) {
  return (fifty_digits_may_suffice && check(Real())) || check(Real100());
}

}  // namespace liecheck::oracles
