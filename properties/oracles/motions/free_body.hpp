#pragma once
// A free rigid body under constant gravity: its centre of mass falls freely, and its attitude is that of the
// torque-free body.
//
//   p_WBo = p_C - R c,  u = R^T v_C - omega x c,  with R(t) of constant_twist, axisymmetric or triaxial in the body's
//   principal axes P: R_WB = R_WP R_BP^T

#include <functional>
#include <oracles/motions/free_fall.hpp>
#include <string>

namespace liecheck::oracles {

/// Eigenvalues of a symmetric matrix and, as columns, right-handed eigenvectors, by Jacobi's rotations. The result is
/// exact for a diagonal matrix, whose order is kept.
template <class T>
void principal_axes(Mat3<T> m, Vec3<T>& moments, Mat3<T>& axes);

template <class T = Real>
class FreeBody {
 public:
  /// gravity in world axes [m/s^2]. Moments equal to 1e-30 relative count as equal. Throws std::domain_error where
  /// TriaxialBody does.
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
