#pragma once
// The stream of random bits of one case.
//
// A case is addressable: the same key gives the same bits on any thread, shard or machine. RapidCheck's own
// loop splits one stream and sizes by what came before, so here its splittable generator (Claessen & Palka
// 2013) is seeded from the case's key alone. Numbers are made with + - x / sqrt and ldexp only, which IEEE 754
// rounds correctly everywhere, and without std::*_distribution, whose algorithms are not specified.

#include <rapidcheck/Random.h>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace liecheck::properties {

class Source {
 public:
  using Key = rc::Random::Key;
  explicit Source(const Key& key) : random_(key) {}

  /// 64 fresh bits.
  std::uint64_t bits() { return random_.next(); }

  /// Uniform on 0 ... n - 1, n >= 1 and small: the bias is n / 2^64.
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>((static_cast<unsigned __int128>(bits()) * n) >> 64);
  }
  int between(int low, int high) {
    return low + static_cast<int>(below(static_cast<std::uint64_t>(high - low) + 1));
  }
  bool chance(int numerator, int denominator) {
    return below(static_cast<std::uint64_t>(denominator)) < static_cast<std::uint64_t>(numerator);
  }

  /// Uniform on the multiples of 2^-digits in [0, 1).
  template <class S>
  S unit() {
    using std::ldexp;
    constexpr int digits = std::numeric_limits<S>::digits;
    if constexpr (digits <= 64) {
      return S(ldexp(S(bits() >> (64 - digits)), -digits));
    } else {
      const std::uint64_t low = bits() >> (128 - digits);
      return S(ldexp(S(ldexp(S(bits()), digits - 64) + S(low)), -digits));
    }
  }
  /// Uniform on [-1, 1).
  template <class S>
  S symmetric() {
    return S(2) * unit<S>() - S(1);
  }

 private:
  rc::Random random_;
};

}  // namespace liecheck::properties
