#pragma once
// Error-free transformations (Dekker 1971; Ogita, Rump & Oishi 2005), for the few sums whose terms cancel.

#include <liecheck/scalar/scalar.hpp>
#include <array>
#include <limits>
#include <utility>

namespace liecheck {

/// (s, e) with s = fl(a + b) and s + e = a + b exactly. Knuth (1969), 4.2.2 theorem B. No overflow assumed.
template <Scalar S>
std::pair<S, S> two_sum(const S& a, const S& b) {
  const S s = a + b;
  const S b_virtual = s - a;
  const S a_virtual = s - b_virtual;
  return {s, (a - a_virtual) + (b - b_virtual)};
}

/// (h, l) with a = h + l, each with half the digits. Veltkamp (1968); |a| < max / 2^(digits / 2 + 1).
template <Scalar S>
std::pair<S, S> split(const S& a) {
  using std::ldexp;
  constexpr int half = (std::numeric_limits<S>::digits + 1) / 2;
  static const S factor = S(ldexp(S(1), half)) + S(1);
  const S c = factor * a;
  const S high = c - (c - a);
  return {high, a - high};
}

/// (p, e) with p = fl(a b) and p + e = a b exactly, barring underflow. Dekker (1971), eq. 5.14.
template <Scalar S>
std::pair<S, S> two_product(const S& a, const S& b) {
  const S p = a * b;
#if defined(__FMA__)
  if constexpr (std::is_floating_point_v<S>) return {p, std::fma(a, b, -p)};
#endif
  const auto [ah, al] = split(a);
  const auto [bh, bl] = split(b);
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

/// Sum of products a_i b_i as if computed in twice the digits, then rounded: error at most
/// eps |sum| + n^2 eps^2 sum |a_i b_i|. Ogita, Rump & Oishi (2005), algorithm 5.3 (Dot2).
template <Scalar S>
class CompensatedSum {
 public:
  CompensatedSum& add_product(const S& a, const S& b) {
    const auto [p, pe] = two_product(a, b);
    const auto [s, se] = two_sum(high_, p);
    high_ = s;
    low_ += pe + se;
    return *this;
  }
  CompensatedSum& add(const S& a) {
    const auto [s, se] = two_sum(high_, a);
    high_ = s;
    low_ += se;
    return *this;
  }
  S value() const { return high_ + low_; }

 private:
  S high_ = S(0);
  S low_ = S(0);
};

/// a . b with its exact sign and a relative error of 2 eps however much cancels, barring underflow of the
/// products: they are summed as a nonoverlapping expansion, smallest first. Shewchuk (1997), theorem 10.
template <Scalar S, int N, class V>
S exact_dot(const V& a, const V& b) {
  std::array<S, 2 * N> expansion;
  int size = 0;
  const auto grow = [&](S x) {
    for (int i = 0; i < size; ++i) {
      const auto [sum, rest] = two_sum(x, expansion[i]);
      expansion[i] = rest;
      x = sum;
    }
    expansion[size++] = x;
  };
  for (int i = 0; i < N; ++i) {
    const auto [p, e] = two_product(a[i], b[i]);
    grow(e);
    grow(p);
  }
  S sum(0);
  for (const S& x : expansion) sum += x;
  return sum;
}

}  // namespace liecheck
