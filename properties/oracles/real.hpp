#pragma once
// The number types of the oracles: binary floating point of 50 and of 100 decimal digits (168 and 334 bits),
// stored on the stack. With MPFR's exponent range of +-2^30 no operation underflows or overflows.
//
// Every function of this folder is thread-safe: its only mutable state is MPFR's thread-local caches.

#include <boost/multiprecision/mpfr.hpp>

namespace liecheck::oracles {

template <unsigned Digits>
using Decimal = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<Digits, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

using Real = Decimal<50>;
using Real100 = Decimal<100>;

template <unsigned Digits>
void sin_cos(const Decimal<Digits>& x, Decimal<Digits>& sine, Decimal<Digits>& cosine) {
  mpfr_sin_cos(sine.backend().data(), cosine.backend().data(), x.backend().data(), MPFR_RNDN);
}

}  // namespace liecheck::oracles
