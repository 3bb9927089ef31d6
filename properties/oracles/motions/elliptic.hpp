#pragma once
// Jacobi's elliptic functions and Legendre's integrals for all real arguments, by Boost.Math.
//
//   am(u): u = F(am | k),   sn = sin am,   cn = cos am,   dn = sqrt(1 - k^2 sn^2)
//   F(phi | k)     = int_0^phi ds / sqrt(1 - k^2 sin^2 s)
//   Pi(n; phi | k) = int_0^phi ds / ((1 - n sin^2 s) sqrt(1 - k^2 sin^2 s))
// Domain: 0 <= k < 1 and n < 1. Near k = 1 the leading digits of 1 - k are lost: use 100 digits there.

#include <oracles/real.hpp>

namespace liecheck::oracles {

template <class T>
struct Jacobi {
  T sn, cn, dn, am;
};

/// For 0 <= k <= 1. am is continuous: am(u + 2K) = am(u) + pi.
template <class T>
Jacobi<T> jacobi(const T& u, const T& k);

/// F(phi | k) for any phi; for k = 1 only |phi| < pi / 2.
template <class T>
T first_kind(const T& phi, const T& k);

/// Pi(n; phi | k) for any phi.
template <class T>
T third_kind(const T& n, const T& phi, const T& k);

}  // namespace liecheck::oracles
