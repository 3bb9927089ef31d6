#pragma once
// What the laws on quaternions of any norm share. A factor 2^k does not change Q/|Q|, so the oracles take 2^k Q.

#include <invariants/property.hpp>
#include <oracles/linear_algebra.hpp>

namespace liecheck::properties {

/// 2^k Q in the scalar, whose largest number is in [1/2, 1). Digits below the smallest number are lost, which is far below every
/// error that a law measures.
inline Vec<double, 4> at_unit_scale(const oracles::Scalar& scalar, Vec<double, 4> Q) {
  int exponent = 0;
  static_cast<void>(std::frexp(Q.cwiseAbs().maxCoeff(), &exponent));
  for (int i = 0; i < 4; ++i) Q[i] = scalar.rounded(std::ldexp(Q[i], -exponent));
  return Q;
}

/// Of Q and -Q, which are one rotation, the one nearer to what was computed, if the output is judged as that of ordinary code.
/// An adapter that states a sign is held to it (adapters/chosen.hpp).
template <class Value, class Real>
Value nearer_sign(const Recorder& r, const Output& output, const oracles::Vec<4, Real>& computed,
                  const Value& Q) {
  Real product(0);
  for (std::size_t i = 0; i < 4; ++i) product += computed[i] * Q[i];
  return r.ordinary(output) && product < Real(0) ? Value(-Q) : Q;
}

}  // namespace liecheck::properties
