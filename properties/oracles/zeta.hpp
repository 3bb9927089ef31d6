#pragma once
// Riemann's zeta function in double: that of the standard library, or Boost's where it has none (libc++).

#include <cmath>
#ifndef __cpp_lib_math_special_functions
#include <boost/math/special_functions/zeta.hpp>
#endif

namespace liecheck::oracles {

inline double zeta(double s) {
#ifdef __cpp_lib_math_special_functions
  return std::riemann_zeta(s);
#else
  return boost::math::zeta(s);
#endif
}

}  // namespace liecheck::oracles
