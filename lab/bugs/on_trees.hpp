#pragma once
// Known bugs that replace some of liecheck's algorithms on trees.

#include <bugs/planted_bugs.hpp>
#include <subjects/liecheck_trees.hpp>

namespace liecheck::properties {

/// The subject has only liecheck's algorithms on trees, changed by `plant`.
template <class S>
std::function<void(TypedOperations<S>&)> on_trees(void (*plant)(TreeOperations<S>&, const Tree<S>&)) {
  return [plant](TypedOperations<S>& o) {
    o = {};
    o.tree = [plant](const Tree<S>& tree) {
      TreeOperations<S> faulty = liecheck_tree<S>(tree);
      plant(faulty, tree);
      return faulty;
    };
  };
}

}  // namespace liecheck::properties
