#pragma once
// Collocation at 6 Gauss points on the group. Order 12.

#include <liecheck/scene/integrators/collocation.hpp>

namespace liecheck::scene {

struct Gauss12Info {
  static constexpr MethodInfo info{"gauss12",
                                   12,
                                   0,
                                   false,
                                   false,
                                   false,
                                   false,
                                   "collocation of (delta, v) at 6 Gauss points, q1 = q0 exp(delta)",
                                   "Butcher 1964, Implicit Runge-Kutta processes; Munthe-Kaas 1999",
                                   true};
};
template <System Sys>
using Gauss12 = Collocation<Sys, 6, Gauss12Info>;

}  // namespace liecheck::scene
