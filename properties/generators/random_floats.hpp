#pragma once
// Random floating-point numbers at the scales at which code breaks.

#include <generators/random_bits.hpp>

namespace liecheck::properties {

/// x plus k units in the last place of x's binade (minus for x < 0). The result is exact.
template <class S>
S step_ulps(const S& x, int k) {
  using std::frexp, std::ldexp;
  if (x == S(0)) return S(k) * std::numeric_limits<S>::denorm_min();
  int exponent = 0;
  S(frexp(x, &exponent));
  S ulp = S(ldexp(S(1), exponent - std::numeric_limits<S>::digits));
  if (ulp < std::numeric_limits<S>::denorm_min()) ulp = std::numeric_limits<S>::denorm_min();
  return x > S(0) ? S(x + S(k) * ulp) : S(x - S(k) * ulp);
}

/// Log-uniform on [2^low, 2^high), with a uniform exponent and a uniform mantissa.
template <class S>
S binade_uniform(Source& source, int low, int high) {
  using std::ldexp;
  const int exponent = source.between(low, high - 1);
  return S(ldexp(S(1) + source.unit<S>(), exponent));
}

/// Log-uniform (by binade) on [low, high], 0 < low < high, by rejection.
template <class S>
S log_uniform(Source& source, const S& low, const S& high) {
  using std::frexp;
  int low_exponent = 0, high_exponent = 0;
  S(frexp(low, &low_exponent));
  S(frexp(high, &high_exponent));
  for (int attempt = 0; attempt < 64; ++attempt) {
    const S x = binade_uniform<S>(source, low_exponent - 1, high_exponent);
    if (x >= low && x <= high) return x;
  }
  return low;
}

/// A subnormal number: log-uniform below the smallest normal number.
template <class S>
S subnormal(Source& source) {
  const S unit = std::numeric_limits<S>::denorm_min();
  const int bits = source.between(1, std::numeric_limits<S>::digits - 1);
  using std::ldexp;
  return S(ldexp(S(1) + source.unit<S>(), bits - 1)) * unit;
}

/// A multiple of 1/4 in [-2, 2], as in handwritten tests.
template <class S>
S simple(Source& source) {
  return S(source.between(-8, 8)) / S(4);
}

/// A signed length, speed or force: mostly in [-2, 2], sometimes simple or zero, sometimes with |x| between
/// 2^-binades and 2^binades.
template <class S>
S magnitude(Source& source, int binades) {
  const S sign = source.chance(1, 2) ? S(1) : S(-1);
  switch (source.below(8)) {
    case 0:
      return simple<S>(source);
    case 1:
      return sign * binade_uniform<S>(source, -binades, binades);
    case 2:
      return source.chance(1, 2) ? S(0) : sign * S(0);
    default:
      return S(2) * source.symmetric<S>();
  }
}

/// The unit of one group of a law's numbers: they are scaled by 2^exponent.
struct Unit {
  std::size_t first, count;
  int exponent;
};
/// Scales groups of numbers by powers of two.
template <class S>
void scale(std::vector<S>& x, std::initializer_list<Unit> units) {
  using std::ldexp;
  for (const Unit& unit : units)
    for (std::size_t i = unit.first; i < unit.first + unit.count; ++i) x[i] = S(ldexp(x[i], unit.exponent));
}

}  // namespace liecheck::properties
