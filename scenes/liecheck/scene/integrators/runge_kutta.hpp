#pragma once
// The tableaus of the explicit Runge-Kutta methods with fixed steps. MuntheKaas (munthe_kaas.hpp) turns each
// of them into a method on the group.

#include <liecheck/scene/integrators/munthe_kaas.hpp>

namespace liecheck::scene {

/// The explicit midpoint rule. Order 2.
struct MidpointTableau {
  static constexpr MethodInfo info{.name = "rk2",
                                   .order = 2,
                                   .evaluations = 2,
                                   .equation = "explicit midpoint for (delta, v), q1 = q0 exp(delta)",
                                   .source = "Runge 1895",
                                   .increments = true};
  static constexpr int stages = 2;
  static constexpr Rational a[2][2] = {{}, {{1, 2}}}, b[2] = {{}, {1}}, c[2] = {{}, {1, 2}};
};
template <System Sys>
using Rk2 = MuntheKaas<Sys, MidpointTableau>;

/// The classical method. Order 4.
struct ClassicalTableau {
  static constexpr MethodInfo info{.name = "rkmk4",
                                   .order = 4,
                                   .evaluations = 4,
                                   .equation = "classical Runge-Kutta for (delta, v), q1 = q0 exp(delta)",
                                   .source = "Kutta 1901; Munthe-Kaas 1999",
                                   .increments = true};
  static constexpr int stages = 4;
  static constexpr Rational a[4][4] = {{}, {{1, 2}}, {{}, {1, 2}}, {{}, {}, {1}}},
                            b[4] = {{1, 6}, {1, 3}, {1, 3}, {1, 6}}, c[4] = {{}, {1, 2}, {1, 2}, {1}};
};
template <System Sys>
using Rkmk4 = MuntheKaas<Sys, ClassicalTableau>;

/// Butcher's method with seven stages. Order 6.
struct ButcherTableau {
  static constexpr MethodInfo info{
      .name = "rkmk6",
      .order = 6,
      .evaluations = 7,
      .equation = "Butcher's 7 stages for (delta, v), q1 = q0 exp(delta)",
      .source = "Butcher 1964, On Runge-Kutta processes of high order; Munthe-Kaas 1999",
      .increments = true};
  static constexpr int stages = 7;
  static constexpr Rational a[7][7] = {{},
                                       {{1, 3}},
                                       {{}, {2, 3}},
                                       {{1, 12}, {1, 3}, {-1, 12}},
                                       {{-1, 16}, {9, 8}, {-3, 16}, {-3, 8}},
                                       {{}, {9, 8}, {-3, 8}, {-3, 4}, {1, 2}},
                                       {{9, 44}, {-9, 11}, {63, 44}, {18, 11}, {}, {-16, 11}}},
                            b[7] = {{11, 120}, {}, {27, 40}, {27, 40}, {-4, 15}, {-4, 15}, {11, 120}},
                            c[7] = {{}, {1, 3}, {2, 3}, {1, 3}, {1, 2}, {1, 2}, {1}};
};
template <System Sys>
using Rkmk6 = MuntheKaas<Sys, ButcherTableau>;

}  // namespace liecheck::scene
