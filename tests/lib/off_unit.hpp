#pragma once
// Quaternions and (cos, sin) of any norm. A vector u represents u/|u|, so each result must be that of the normalised u.

#include <gtest/gtest.h>

#include <liecheck/scalar/scalar.hpp>
#include <limits>
#include <vector>

namespace liecheck::test {

/// Norms in the order of their distance from 1. |u|^2 = 3 makes a first-order normalisation zero. Squares of
/// the last two underflow and overflow.
template <class S>
std::vector<S> everyNorm() {
  return {S(1) + S(1e-6),
          S(1) - S(1e-6),
          S(1.001),
          S(0.5),
          S(2),
          std::sqrt(S(3)),
          S(1e-3),
          S(1e-6),
          S(1e3),
          S(1e9),
          std::numeric_limits<S>::min() * 1024,
          std::numeric_limits<S>::max() / 4};
}
template <class S, class A, class B>
void expectNear(const A& a, const B& b, S bound) {
  EXPECT_TRUE(a.allFinite());
  EXPECT_LE((a - b).norm(), bound * (S(1) + b.norm()));
}

}  // namespace liecheck::test
