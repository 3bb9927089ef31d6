#pragma once
// Known bugs in the dynamics of trees: liecheck's algorithms with one fault each, modelled on real reports.

#include <subjects/tree.hpp>

namespace liecheck::properties {

template <class S>
struct TreeBug {
  const char *name, *fault, *origin;
  TreeOperations<S> (*tree)(const Tree<S>& tree);
};

template <class S>
const std::vector<TreeBug<S>>& tree_bugs();

}  // namespace liecheck::properties
