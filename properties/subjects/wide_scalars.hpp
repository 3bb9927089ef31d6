#pragma once
// The library's operations in scalars that no law of the campaign runs in.

#include <oracles/real.hpp>
#include <subjects/subject.hpp>
#ifdef LIECHECK_QD
#include <qd/dd_real.h>

/// The fraction in [1/2, 1), by its head; exact. Found by argument-dependent look-up.
inline dd_real frexp(const dd_real& a, int* exponent) {
  std::frexp(a.x[0], exponent);
  return dd_real(std::ldexp(a.x[0], -*exponent), std::ldexp(a.x[1], -*exponent));
}
#endif

namespace liecheck::properties {

/// 168 and 334 bits, without allocations.
using Digits50 = oracles::Real;
using Digits100 = oracles::Real100;

/// Everything but robots and the checked entrance. In float128, Digits50, Digits100 and, where QD is installed, dd_real.
template <class S>
Operations<S> wide_scalar_operations();

const char* liecheck_version();

}  // namespace liecheck::properties
