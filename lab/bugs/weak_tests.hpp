#pragma once
// Four weaker styles of test that are common in practice. `liecheck lab bugs` compares the laws with them.

#include <subjects/typed.hpp>
#include <vector>

namespace liecheck::properties {

struct WeakStyle {
  const char* name;
  bool (*fails)(const TypedOperations<double>& tested);
  /// Whether a test of this style fails on these operations. Without exp6 (bugs of trees), it passes.
  bool kills(const TypedOperations<double>& tested) const { return tested[op::exp6] && fails(tested); }
};

/// Fixed poses with known results; random poses to 1e-4; round trips; finite differences in double.
const std::vector<WeakStyle>& weak_styles();

}  // namespace liecheck::properties
