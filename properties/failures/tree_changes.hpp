#pragma once
// Changes of a random tree and its state that a faulty algorithm may compute with: no armature, a wrench on another joint.

#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A change in words that follow "the result is what" and stand before "would give".
struct TreeChange {
  std::string text;
  /// In place of `text` where J v is compared, not J; "" if the change tells nothing of columns.
  std::string of_columns;
  bool leaves_out = false;  ///< whether terms of a right formula are 0 after it
  /// Changes the numbers of a random tree (generators/tree_layout.hpp).
  std::function<void(std::vector<double>&)> apply;
  bool any_inertia = false;  ///< whether bodies may have inertias after it that no body has
};

/// The simplest first.
const std::vector<TreeChange>& tree_changes();

/// Changes of what becomes of two halves of a body on one joint, as the law of split bodies makes them.
const std::vector<TreeChange>& changes_of_halves();

}  // namespace liecheck::properties
