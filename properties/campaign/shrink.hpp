#pragma once
// Shrinking: from a failing input to the smallest one that still fails in the same way.
//
// Greedy passes over the groups of the input, each candidate kept only if it stays valid and still fails:
// zero or identity, axis-aligned, unit scale, powers of two, short decimals, few mantissa bits. Bounded by a
// number of evaluations and by two seconds.

#include <chrono>
#include <cmath>
#include <functional>
#include <invariants/property.hpp>
#include <vector>

namespace liecheck::properties {

namespace shrink_detail {

/// x with at most `bits` significant bits, towards zero.
template <class S>
S few_bits(const S& x, int bits) {
  using std::frexp, std::ldexp, std::trunc;
  int exponent = 0;
  const S m = S(frexp(x, &exponent));
  return S(ldexp(S(trunc(S(ldexp(m, bits)))), exponent - bits));
}

/// Candidates for one group, simplest first.
template <class S>
std::vector<std::vector<S>> candidates(const std::vector<S>& g, Kind kind) {
  using std::fabs, std::sqrt;
  std::vector<std::vector<S>> all;
  const std::size_t n = g.size();
  if (kind == Kind::choice || kind == Kind::opaque || kind == Kind::inertia ||
      kind == Kind::rotation_matrix) {
    if (kind == Kind::rotation_matrix) all.push_back({S(1), S(0), S(0), S(0), S(1), S(0), S(0), S(0), S(1)});
    return all;
  }
  if (kind == Kind::quaternion) {
    all.push_back({S(0), S(0), S(0), S(1)});
    S v(0);
    for (std::size_t i = 0; i < 3; ++i) v += g[i] * g[i];
    v = S(sqrt(v));
    for (std::size_t i = 0; i < 3; ++i) {  // the same angle about an axis
      std::vector<S> c(4, S(0));
      c[i] = v, c[3] = g[3];
      all.push_back(c);
    }
    return all;
  }
  all.push_back(std::vector<S>(n, S(0)));
  S largest(0);
  for (const S& x : g)
    if (S(fabs(x)) > largest) largest = S(fabs(x));
  for (std::size_t i = 0; i < n; ++i) {
    for (const S& value : {S(1), few_bits(largest, 1), largest}) {
      if (kind == Kind::rotation_vector && value == S(1)) continue;
      std::vector<S> c(n, S(0));
      c[i] = value;
      all.push_back(c);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<S> c = g;
    c[i] = S(0);
    all.push_back(c);
  }
  for (int bits : {1, 2, 4, 8, 16, 32}) {
    std::vector<S> c = g;
    for (S& x : c) x = few_bits(x, bits);
    all.push_back(c);
  }
  return all;
}

}  // namespace shrink_detail

template <class S>
std::vector<S> shrink_input(std::vector<S> input, const std::vector<Field>& fields,
                            const std::function<bool(const std::vector<S>&)>& still_fails, int evaluations) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  bool improved = true;
  while (improved) {
    improved = false;
    std::size_t from = 0;
    for (const Field& f : fields) {
      const auto size = static_cast<std::size_t>(f.size);
      const std::vector<S> group(input.begin() + static_cast<std::ptrdiff_t>(from),
                                 input.begin() + static_cast<std::ptrdiff_t>(from + size));
      for (const auto& candidate : shrink_detail::candidates<S>(group, f.kind)) {
        if (candidate == group) break;  // the rest is no simpler
        if (evaluations-- <= 0 || std::chrono::steady_clock::now() > deadline) return input;
        std::vector<S> attempt = input;
        std::copy(candidate.begin(), candidate.end(), attempt.begin() + static_cast<std::ptrdiff_t>(from));
        if (still_fails(attempt)) {
          input = attempt;
          improved = true;
          break;
        }
      }
      from += size;
    }
  }
  return input;
}

}  // namespace liecheck::properties
