#pragma once
// What the laws on quaternions of any norm share. A factor 2^k does not change Q/|Q|, so the oracles take 2^k Q.

#include <algorithm>
#include <invariants/property.hpp>

namespace liecheck::properties {

/// 2^k Q, whose largest number is in [1/2, 1). Digits below the smallest number are lost, which is far below every
/// error that a law measures.
template <class S>
Vec<S, 4> at_unit_scale(Vec<S, 4> Q) {
  using std::frexp, std::ldexp;
  int exponent = 0;
  static_cast<void>(frexp(S(Q.cwiseAbs().maxCoeff()), &exponent));
  for (int i = 0; i < 4; ++i) Q[i] = S(ldexp(Q[i], -exponent));
  return Q;
}

/// Whether the four numbers from `first` are zero.
template <class S>
bool zero_quaternion_at(const std::vector<S>& input, std::size_t first) {
  const auto begin = input.begin() + static_cast<std::ptrdiff_t>(first);
  return std::all_of(begin, begin + 4, [](const S& x) { return x == S(0); });
}

}  // namespace liecheck::properties
