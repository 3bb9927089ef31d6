#pragma once
// The bands of angles in which time is measured.

#include <array>

namespace liecheck::properties {

/// theta, or pi - theta if `from_pi`, is in [low, high]: uniform if `uniform`, otherwise log-uniform.
struct CostBand {
  const char* name;
  double low, high;
  bool from_pi, uniform;
};
/// In float, no edge is equal to 0 or pi.
inline constexpr std::array<CostBand, 5> cost_bands = {{{"theta 1e-12..1e-5", 1e-12, 1e-5, false, false},
                                                        {"theta 1e-5..1e-3", 1e-5, 1e-3, false, false},
                                                        {"theta 1e-3..0.1", 1e-3, 0.1, false, false},
                                                        {"theta 0.1..pi-0.1", 0.1, 3.0415, false, true},
                                                        {"pi-theta 1e-5..0.1", 1e-5, 0.1, true, false}}};

/// The angles of `cost --curve`.
inline constexpr std::array<CostBand, 10> curve_bands = {{{"1e-9..1e-8", 1e-9, 1e-8, false, false},
                                                          {"1e-8..1e-7", 1e-8, 1e-7, false, false},
                                                          {"1e-7..1e-6", 1e-7, 1e-6, false, false},
                                                          {"1e-6..1e-5", 1e-6, 1e-5, false, false},
                                                          {"1e-5..1e-4", 1e-5, 1e-4, false, false},
                                                          {"1e-4..1e-3", 1e-4, 1e-3, false, false},
                                                          {"1e-3..1e-2", 1e-3, 1e-2, false, false},
                                                          {"1e-2..1e-1", 1e-2, 1e-1, false, false},
                                                          {"0.1..1", 0.1, 1, false, false},
                                                          {"1..3.14", 1, 3.14, false, true}}};

}  // namespace liecheck::properties
