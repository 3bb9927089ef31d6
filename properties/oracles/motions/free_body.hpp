#pragma once
// A free rigid body under constant gravity: the centre of mass falls freely, and the attitude is torque-free.
// P are the body's principal axes. R_WP(t) comes from torque_free.hpp.
//   p_WBo = p_C - R c,   u = R^T v_C - omega x c,   R_WB = R_WP R_BP^T

#include <functional>
#include <oracles/motions/state.hpp>
#include <string>

namespace liecheck::oracles {

/// Free fall, p = p0 + v0 t + g t^2 / 2: the position in world axes [m], from p0 [m], v0 [m/s] and g [m/s^2].
template <class T>
Vec3<T> free_fall(const Vec3<T>& p0, const Vec3<T>& v0, const Vec3<T>& g, const T& t) {
  return p0 + t * v0 + T(t * t / 2) * g;
}

template <class T>
Vec3<T> free_fall_velocity(const Vec3<T>& v0, const Vec3<T>& g, const T& t) {
  return v0 + t * g;
}

/// The eigenvalues of a symmetric matrix and its right-handed eigenvectors, as columns, by Jacobi's
/// rotations. A diagonal matrix has an exact result in the order of its diagonal.
template <class T>
void principal_axes(Mat3<T> m, Vec3<T>& moments, Mat3<T>& axes);

template <class T = Real>
class FreeBody {
 public:
  /// gravity in world axes [m/s^2]. Moments that differ by at most a relative 1e-30 count as equal. Throws
  /// std::domain_error in the cases in which TriaxialBody does.
  FreeBody(const Body<T>& body, const BodyState<T>& initial, const Vec3<T>& gravity);

  BodyState<T> at(const T& t) const;
  /// The name of the attitude's closed form.
  const std::string& family() const { return family_; }

 private:
  Vec3<T> lever_, gravity_, p_, v_;
  Mat3<T> R_BP_;
  std::function<AttitudeState<T>(const T&)> attitude_;  ///< R_WP and omega in the axes of P
  std::string family_;
};

}  // namespace liecheck::oracles
