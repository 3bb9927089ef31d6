#pragma once
// What the laws on quaternions of any norm share. A factor 2^k does not change Q/|Q|, so the oracles take 2^k Q.

#include <invariants/property.hpp>

namespace liecheck::properties {

/// 2^k Q in the scalar, whose largest number is in [1/2, 1). Digits below the smallest number are lost, which is far below every
/// error that a law measures.
inline Vec<double, 4> at_unit_scale(const oracles::Scalar& scalar, Vec<double, 4> Q) {
  int exponent = 0;
  static_cast<void>(std::frexp(Q.cwiseAbs().maxCoeff(), &exponent));
  for (int i = 0; i < 4; ++i) Q[i] = scalar.rounded(std::ldexp(Q[i], -exponent));
  return Q;
}

}  // namespace liecheck::properties
