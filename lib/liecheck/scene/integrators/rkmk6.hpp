#pragma once
// Butcher's method of order 6 with seven stages, on the group.

#include <liecheck/scene/integrators/munthe_kaas.hpp>

namespace liecheck::scene {

struct ButcherTableau {
  static constexpr MethodInfo info{"rkmk6",
                                   6,
                                   7,
                                   false,
                                   false,
                                   false,
                                   false,
                                   "Butcher's 7 stages for (delta, v), q1 = q0 exp(delta)",
                                   "Butcher 1964, On Runge-Kutta processes of high order; Munthe-Kaas 1999",
                                   true};
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
