#pragma once
// The library's operations in the wide scalars that `liecheck cost` times.

#include <oracles/real.hpp>
#include <subjects/typed.hpp>
#ifdef LIECHECK_QD
#include <qd/dd_real.h>

/// Splits a = fraction 2^exponent exactly, with the exponent of the high part. Argument-dependent lookup
/// finds this function.
inline dd_real frexp(const dd_real& a, int* exponent) {
  std::frexp(a.x[0], exponent);
  return dd_real(std::ldexp(a.x[0], -*exponent), std::ldexp(a.x[1], -*exponent));
}
#endif

namespace liecheck::properties {

/// Significands of 168 and 334 bits. These types allocate no memory.
using Digits50 = oracles::Real;
using Digits100 = oracles::Real100;

/// The operations that need no robot, in float128, Digits50, Digits100 and, if QD is installed, dd_real.
template <class S>
TypedOperations<S> wide_scalar_operations();

}  // namespace liecheck::properties
