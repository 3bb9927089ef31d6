#pragma once
// Joint 0, the universe: fixed to the world, no numbers in q.

#include <liecheck/multibody/joints/linear_coordinates.hpp>

namespace liecheck {

template <Scalar S>
struct Universe : LinearCoordinates<S, 0> {
  std::string shortname() const { return "universe"; }
  template <Scalar T>
  Universe<T> cast() const {
    return {};
  }
};

}  // namespace liecheck
