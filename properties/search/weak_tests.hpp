#pragma once
// Four weaker styles of test, as they are written in practice, to compare the laws with: what would they have seen?

#include <subjects/subject.hpp>
#include <vector>

namespace liecheck::properties {

struct WeakStyle {
  const char* name;
  bool (*fails)(const Operations<double>& tested);
  /// Does a test of this style fail on these operations? They are tests of SE(3): of a tree alone, they see nothing.
  bool kills(const Operations<double>& tested) const { return tested[op::exp6] && fails(tested); }
};

/// A fixed grid of poses with known results; random poses at 1e-4; round trips; finite differences in double.
const std::vector<WeakStyle>& weak_styles();

}  // namespace liecheck::properties
