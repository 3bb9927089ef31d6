#pragma once
// The stream of random bits of one case, by SplitMix64 (Steele, Lea & Flood 2014).
//
// The stream depends only on the key of the case (CaseId::key in campaign/case_id.hpp: seed, law, scalar,
// robot and index). A case therefore has the same bits on any thread, shard or machine. In RapidCheck's own
// loop a case depends on the cases before it. (RapidCheck's random engine could be seeded with the key, but
// its cryptographic hash takes a tenth of a campaign's time.)
// Numbers are computed only with + - x / sqrt and ldexp, which IEEE 754 rounds correctly on every machine.
// std::*_distribution is not used, because its algorithms are not specified.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace liecheck::properties {

class Source {
 public:
  using Key = std::array<std::uint64_t, 4>;
  explicit Source(const Key& key) {
    for (const std::uint64_t word : key) state_ = mixed(state_ ^ word);
  }

  /// 64 fresh bits.
  std::uint64_t bits() { return mixed(state_ += 0x9e3779b97f4a7c15); }

  /// Uniform on 0 ... n - 1 for a small n >= 1: the bias is n / 2^64.
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
    if constexpr (digits < 64) {
      constexpr S step = S(1) / S(std::uint64_t{1} << digits);
      return S(bits() >> (64 - digits)) * step;
    } else if constexpr (digits == 64) {
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
  /// A bijection: changing one bit of z changes each bit of the result with probability 1/2.
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t state_ = 0;
};

}  // namespace liecheck::properties
