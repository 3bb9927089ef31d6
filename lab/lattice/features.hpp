#pragma once
// The features of a call, from its arguments as plain numbers and the record of its operation.

#include <lattice/trigger.hpp>
#include <subjects/number_function.hpp>
#include <subjects/tree.hpp>
#include <vector>

namespace liecheck::properties {

/// What a call of a tree's or a robot's operation depends on besides its arguments.
struct Context {
  Features features;      ///< those of the tree
  bool floating = false;  ///< the first joint is a free-flyer
};

Context context_of(const Tree<double>& tree);

/// The features of the arguments of a call, one after another. Habits are left NaN.
Features features_of(const NumberFunction& function, const std::vector<double>& arguments,
                     const Context& context);

}  // namespace liecheck::properties
