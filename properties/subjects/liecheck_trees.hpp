#pragma once
// liecheck's own algorithms on a tree of bodies, in float and double.

#include <subjects/tree.hpp>

namespace liecheck::properties {

template <class S>
TreeOperations<S> liecheck_tree(const Tree<S>& tree);

}  // namespace liecheck::properties
