#pragma once
// Free fall: the centre of mass of any free body under constant gravity, p = p0 + v0 t + g t^2 / 2.

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

/// The position in world axes [m], from p0 [m], v0 [m/s] and g [m/s^2].
template <class T>
Vec3<T> free_fall(const Vec3<T>& p0, const Vec3<T>& v0, const Vec3<T>& g, const T& t) {
  return p0 + t * v0 + T(t * t / 2) * g;
}

template <class T>
Vec3<T> free_fall_velocity(const Vec3<T>& v0, const Vec3<T>& g, const T& t) {
  return v0 + t * g;
}

}  // namespace liecheck::oracles
