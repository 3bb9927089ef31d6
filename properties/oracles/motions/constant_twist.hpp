#pragma once
// Constant twist: a torque-free body that rotates about a principal axis, or about any axis if its moments
// are equal. Then omega x I omega = 0 and R = R0 exp([omega] t).

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

template <class T>
AttitudeState<T> constant_twist(const AttitudeState<T>& initial, const T& t) {
  return {quaternion_product(initial.Q, rotation_by<T>(t * initial.omega)), initial.omega};
}

}  // namespace liecheck::oracles
