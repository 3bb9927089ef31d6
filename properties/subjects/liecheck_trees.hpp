#pragma once
// liecheck's own algorithms on a tree of bodies, in float and double.

#include <liecheck/multibody/model.hpp>
#include <subjects/tree.hpp>

namespace liecheck::properties {

/// The tree as a model, with the frame "frame".
template <class S>
Model<S> liecheck_model(const Tree<S>& tree);

template <class S>
TreeOperations<S> liecheck_tree(const Tree<S>& tree);

}  // namespace liecheck::properties
