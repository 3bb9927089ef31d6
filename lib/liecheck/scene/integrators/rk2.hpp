#pragma once
// The explicit midpoint rule on the group. Order 2.

#include <liecheck/scene/integrators/munthe_kaas.hpp>

namespace liecheck::scene {

struct MidpointTableau {
  static constexpr MethodInfo info{
      "rk2",        2,     2,     false,
      false,        false, false, "explicit midpoint for (delta, v), q1 = q0 exp(delta)",
      "Runge 1895", true};
  static constexpr int stages = 2;
  static constexpr Rational a[2][2] = {{}, {{1, 2}}}, b[2] = {{}, {1}}, c[2] = {{}, {1, 2}};
};
template <System Sys>
using Rk2 = MuntheKaas<Sys, MidpointTableau>;

}  // namespace liecheck::scene
