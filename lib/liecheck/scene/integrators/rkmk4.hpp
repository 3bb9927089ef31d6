#pragma once
// The classical Runge-Kutta method on the group. Order 4.

#include <liecheck/scene/integrators/munthe_kaas.hpp>

namespace liecheck::scene {

struct ClassicalTableau {
  static constexpr MethodInfo info{"rkmk4",
                                   4,
                                   4,
                                   false,
                                   false,
                                   false,
                                   false,
                                   "classical Runge-Kutta for (delta, v), q1 = q0 exp(delta)",
                                   "Kutta 1901; Munthe-Kaas 1999",
                                   true};
  static constexpr int stages = 4;
  static constexpr Rational a[4][4] = {{}, {{1, 2}}, {{}, {1, 2}}, {{}, {}, {1}}},
                            b[4] = {{1, 6}, {1, 3}, {1, 3}, {1, 6}}, c[4] = {{}, {1, 2}, {1, 2}, {1}};
};
template <System Sys>
using Rkmk4 = MuntheKaas<Sys, ClassicalTableau>;

}  // namespace liecheck::scene
