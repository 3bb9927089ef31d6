#pragma once
// Simpler values of a group of numbers, as in a handwritten bug report, simplest first. Each value is valid
// for its kind, up to rounding.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <generators/input_layout.hpp>
#include <oracles/scalar.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace liecheck::properties::shrinks {

/// x rounded towards zero to at most `bits` significant bits.
template <class S>
S few_bits(const S& x, int bits) {
  using std::frexp, std::ldexp, std::trunc;
  int exponent = 0;
  const S m = S(frexp(x, &exponent));
  return S(ldexp(S(trunc(S(ldexp(m, bits)))), exponent - bits));
}

/// x rounded to `digits` decimal digits, or x itself outside the range of double.
template <class S>
S few_digits(const S& x, int digits) {
  const double d = static_cast<double>(x);
  if (x == S(0) || !(std::fabs(d) >= 1e-300 && std::fabs(d) < 1e300)) return x;
  char text[40];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, d);
  if constexpr (std::is_same_v<S, float>)
    return std::strtof(text, nullptr);
  else
    return std::strtod(text, nullptr);
}

template <class S>
S norm(const std::vector<S>& g) {
  using std::fabs, std::sqrt;
  S m(0), sum(0);
  for (const S& x : g) m = std::max(m, S(fabs(x)));
  if (m > S(0))
    for (const S& x : g) sum += x / m * (x / m);
  return m * S(sqrt(sum));
}

template <class S>
using Candidates = std::vector<std::vector<S>>;

/// Adds g with all its numbers rounded, coarsest rounding first.
template <class S>
void add_rounded(Candidates<S>& all, const std::vector<S>& g) {
  for (int size : {1, 2, 4, 8, 16, 32})
    for (bool decimal : {true, false}) {
      if (decimal && size > 8) continue;
      std::vector<S> c = g;
      for (S& x : c) x = decimal ? few_digits(x, size) : few_bits(x, size);
      all.push_back(c);
    }
}

template <class S>
Candidates<S> with_rounded(Candidates<S> all, const std::vector<S>& g) {
  add_rounded(all, g);
  return all;
}

/// Vectors along an axis with length 1, a short decimal, a power of two or the length of g. Then g with one
/// element set to zero, g at unit scale, and g rounded.
template <class S>
Candidates<S> vectors(const std::vector<S>& g, bool rotation) {
  using std::frexp, std::ldexp;
  Candidates<S> all{std::vector<S>(g.size(), S(0))};
  const S length = norm(g);
  for (const S& value : {S(1), few_digits(length, 1), few_bits(length, 1), few_digits(length, 3), length})
    for (std::size_t i = 0; i < g.size(); ++i) {
      if (rotation && value == S(1)) continue;
      all.push_back(std::vector<S>(g.size(), S(0)));
      all.back()[i] = value;
    }
  for (std::size_t i = 0; i < g.size(); ++i) {
    all.push_back(g);
    all.back()[i] = S(0);
  }
  int exponent = 0;
  S(frexp(length, &exponent));
  if (!rotation && length > S(0)) {
    all.push_back(g);
    for (S& x : all.back()) x = S(ldexp(x, 1 - exponent));
  }
  add_rounded(all, g);
  return all;
}

/// Quaternions: the identity; rotations about an axis by pi, pi/2 and g's angle; g rounded and normalised.
template <class S>
Candidates<S> quaternions(const std::vector<S>& g) {
  using std::sqrt;
  Candidates<S> all{{S(0), S(0), S(0), S(1)}};
  const S v = norm(std::vector<S>(g.begin(), g.begin() + 3)), half = S(sqrt(S(1) / S(2)));
  for (const auto& [s, c] : {std::pair(S(1), S(0)), std::pair(half, half), std::pair(v, g[3])})
    for (std::size_t i = 0; i < 3; ++i) {
      all.push_back({S(0), S(0), S(0), c});
      all.back()[i] = s;
    }
  Candidates<S> rounded{g};  // the normalised g is simpler than g
  for (std::size_t i = 0; i < 4; ++i) {
    rounded.push_back(g);
    rounded.back()[i] = S(0);
  }
  add_rounded(rounded, g);
  for (std::vector<S>& c : rounded)
    if (const S n = norm(c); n > S(0)) {
      for (S& x : c) x /= n;
      all.push_back(c);
    }
  return all;
}

/// The same, then the quaternions with the norm of g, and g rounded.
template <class S>
Candidates<S> any_quaternions(const std::vector<S>& g) {
  Candidates<S> all = quaternions(g);
  const S n = norm(g);
  const std::size_t unit = all.size();
  for (const S& size : {few_digits(n, 1), few_bits(n, 1), n})
    for (std::size_t i = 0; i < unit; ++i) {
      all.push_back(all[i]);
      for (S& x : all.back()) x *= size;
    }
  add_rounded(all, g);
  return all;
}

/// Matrices: the identity, and rotations about an axis by pi, pi/2 and the angle of R.
template <class S>
Candidates<S> matrices(const std::vector<S>& R) {
  Candidates<S> all{{S(1), S(0), S(0), S(0), S(1), S(0), S(0), S(0), S(1)}};
  const S s = norm(std::vector<S>{S(R[7] - R[5]), S(R[2] - R[6]), S(R[3] - R[1])}) / S(2);
  const S c = (R[0] + R[4] + R[8] - S(1)) / S(2), n = norm(std::vector<S>{c, s});
  for (const auto& [cosine, sine] :
       {std::pair(S(-1), S(0)), std::pair(S(0), S(1)), std::pair(c, s), std::pair(S(c / n), S(s / n))})
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      std::vector<S> m(9, S(0));
      m[3 * i + i] = S(1);
      m[3 * j + j] = m[3 * k + k] = cosine;
      m[3 * k + j] = sine, m[3 * j + k] = -sine;
      all.push_back(m);
    }
  return all;
}

/// Inertias (xx xy yy xz yz zz): unit sphere, spheres of g's trace, g without products of inertia, rounded g.
template <class S>
Candidates<S> inertias(const std::vector<S>& g) {
  const S third = (g[0] + g[2] + g[5]) / S(3);
  Candidates<S> all;
  for (const S& value : {S(1), few_digits(third, 1), third})
    all.push_back({value, S(0), value, S(0), S(0), value});
  all.push_back({g[0], S(0), g[2], S(0), S(0), g[5]});
  add_rounded(all, g);
  return all;
}

/// Candidates for one group, simplest first.
template <class S>
Candidates<S> candidates(const std::vector<S>& g, Kind kind) {
  switch (kind) {
    case Kind::vector:
    case Kind::rotation_vector:
      return vectors(g, kind == Kind::rotation_vector);
    case Kind::quaternion:
      return quaternions(g);
    case Kind::any_quaternion:
      return any_quaternions(g);
    case Kind::rotation_matrix:
      return matrices(g);
    case Kind::inertia:
      return inertias(g);
    case Kind::near_rotation:  // rotations, then those with the numbers of g
      return with_rounded(matrices(g), g);
    case Kind::covariance: {
      Candidates<S> all{std::vector<S>(g.size(), S(0)), g};
      for (std::size_t i = 0; i < 36; i += 7) all[0][i] = S(1);
      for (std::size_t i = 0; i < 36; ++i)
        if (i % 7) all[1][i] = S(0);
      return with_rounded(all, g);
    }
    case Kind::positive: {
      Candidates<S> all{std::vector<S>(g.size(), S(1))};
      add_rounded(all, g);
      return all;
    }
    case Kind::direction: {
      Candidates<S> all;
      for (std::size_t i = 0; i < g.size(); ++i)
        for (const S& sign : {S(1), S(-1)}) {
          all.push_back(std::vector<S>(g.size(), S(0)));
          all.back()[i] = sign;
        }
      Candidates<S> rounded;
      add_rounded(rounded, g);
      for (std::vector<S>& c : rounded)
        if (const S n = norm(c); n > S(0)) {
          for (S& x : c) x /= n;
          all.push_back(c);
        }
      return all;
    }
    case Kind::fraction: {
      Candidates<S> all{{S(0)}, {S(1)}, {S(1) / S(2)}};
      add_rounded(all, g);
      return all;
    }
    case Kind::angle:
      return vectors(g, true);
    case Kind::masses: {  // an absent body keeps mass 0
      Candidates<S> all{g};
      for (S& x : all.back()) x = x > S(0) ? S(1) : S(0);
      add_rounded(all, g);
      return all;
    }
    case Kind::parents: {  // fewer joints, the last ones removed
      Candidates<S> all;
      for (std::size_t n = 1; n < g.size() && g[n] >= S(-1); ++n) {
        all.push_back(g);
        std::fill(all.back().begin() + static_cast<std::ptrdiff_t>(n), all.back().end(), S(-2));
      }
      return all;
    }
    default:
      return {};
  }
}

/// The same for numbers of the scalar, as doubles.
inline Candidates<double> candidates(const oracles::Scalar& scalar, const std::vector<double>& g, Kind kind) {
  Candidates<double> all;
  scalar.with([&]<class S>() {
    for (const std::vector<S>& x : candidates(oracles::numbers_in<S>(g), kind))
      all.push_back(oracles::as_doubles(x));
  });
  return all;
}

}  // namespace liecheck::properties::shrinks
