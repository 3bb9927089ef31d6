#pragma once
// The features of a call, from its arguments as plain numbers and the record of its operation.

#include <lattice/trigger.hpp>
#include <operations/operations.hpp>
#include <subjects/tree.hpp>
#include <vector>

namespace liecheck::properties {

/// What a call of a tree's or a robot's operation depends on besides its arguments.
struct Context {
  Features features;      ///< those of the tree
  bool floating = false;  ///< the first joint is a free-flyer
};

template <class S>
Context context_of(const Tree<S>& tree);

/// The arguments of one call: their numbers, one after another, and the end of each argument.
template <class S>
struct CallNumbers {
  std::vector<S> all;
  std::vector<std::size_t> ends;
  void clear() { all.clear(), ends.clear(); }
};

/// The features of the arguments, which `operation` names in their order. Habits are left NaN.
template <class S>
Features features_of(const Operation& operation, const CallNumbers<S>& arguments, const Context& context);

}  // namespace liecheck::properties
