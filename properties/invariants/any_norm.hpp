#pragma once
// What the laws on quaternions of any norm share. A factor 2^k does not change Q/|Q|, so the oracles take 2^k Q.

#include <algorithm>
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

/// Whether the four numbers from `first` are zero.
inline bool zero_quaternion_at(const std::vector<double>& input, std::size_t first) {
  const auto begin = input.begin() + static_cast<std::ptrdiff_t>(first);
  return std::all_of(begin, begin + 4, [](double x) { return x == 0; });
}

}  // namespace liecheck::properties
