#pragma once
// The part of `adapter check` that concerns trees of bodies and robots.

#include <adapters/adapter.hpp>
#include <adapters/checked.hpp>

namespace liecheck::properties::adapters {

/// Calls each operation on trees that the adapter offers at two states, in one batch and one by one, of each kind
/// of model that it takes: a chain with every kind of joint that it takes, and the built-in robot's URDF. The
/// results must be liecheck's to a thousandth.
Checked check_trees(Adapter& adapter);

}  // namespace liecheck::properties::adapters
