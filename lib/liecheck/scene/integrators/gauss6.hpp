#pragma once
// Collocation at 3 Gauss points on the group. Order 6.

#include <liecheck/scene/integrators/collocation.hpp>

namespace liecheck::scene {

struct Gauss6Info {
  static constexpr MethodInfo info{"gauss6",
                                   6,
                                   0,
                                   false,
                                   false,
                                   false,
                                   false,
                                   "collocation of (delta, v) at 3 Gauss points, q1 = q0 exp(delta)",
                                   "Butcher 1964, Implicit Runge-Kutta processes; Munthe-Kaas 1999",
                                   true};
};
template <System Sys>
using Gauss6 = Collocation<Sys, 3, Gauss6Info>;

}  // namespace liecheck::scene
