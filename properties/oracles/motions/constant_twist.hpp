#pragma once
// Constant twist: the spin of a free body about a principal axis, or of one with equal moments about any axis:
// omega x I omega = 0, so R = R0 exp([omega] t).

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

template <class T>
AttitudeState<T> constant_twist(const AttitudeState<T>& initial, const T& t) {
  return {quaternion_product(initial.Q, rotation_by<T>(t * initial.omega)), initial.omega};
}

}  // namespace liecheck::oracles
