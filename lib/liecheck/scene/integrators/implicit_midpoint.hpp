#pragma once
// The implicit midpoint rule on the group: collocation at one Gauss point, where J_r^-1(delta/2) v = v.
//
//   v_m = v0 + h/2 a(q0 exp(h v_m/2), v_m),   q1 = q0 exp(h v_m),   v1 = 2 v_m - v0
//
// Order 2. It is symmetric, its own inverse under h -> -h: the energy of a reversible motion does not drift.

#include <liecheck/scene/integrators/collocation.hpp>

namespace liecheck::scene {

struct ImplicitMidpointInfo {
  static constexpr MethodInfo info{"implicit_midpoint",
                                   2,
                                   0,
                                   false,
                                   true,
                                   false,
                                   false,
                                   "v_m = v0 + h/2 a(q0 exp(h v_m/2), v_m), q1 = q0 exp(h v_m)",
                                   "Hairer, Lubich & Wanner 2006, II.1.3",
                                   true};
};
template <System Sys>
using ImplicitMidpoint = Collocation<Sys, 1, ImplicitMidpointInfo>;

}  // namespace liecheck::scene
