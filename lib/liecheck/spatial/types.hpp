#pragma once
// Fixed-size matrices of the spatial rooms. The notation table is in the README.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <liecheck/scalar/scalar.hpp>
#include <limits>

namespace liecheck {

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Vector4 = Eigen::Matrix<S, 4, 1>;
template <class S>
using Vector6 = Eigen::Matrix<S, 6, 1>;
template <class S>
using Vector7 = Eigen::Matrix<S, 7, 1>;
template <class S>
using VectorX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;
template <class S>
using Matrix6 = Eigen::Matrix<S, 6, 6>;
template <class S>
using MatrixX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// A value that was never set: NaN in debug builds so that its use shows, zero cost otherwise.
template <class Derived>
void mark_uninitialised([[maybe_unused]] Eigen::MatrixBase<Derived>& m) {
#ifndef NDEBUG
  m.setConstant(std::numeric_limits<typename Derived::Scalar>::quiet_NaN());
#endif
}

/// [v]: the matrix with [v] w = v x w. Shape 3 x 3.
template <class S>
Matrix3<S> skew(const Vector3<S>& v) {
  Matrix3<S> m;
  m << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
  return m;
}

/// a x b, each component one fused difference of products where the target has FMA: error 1.5 eps |a||b|.
template <class S>
Vector3<S> cross(const Vector3<S>& a, const Vector3<S>& b) {
  return Vector3<S>(mul_add(a.y(), b.z(), S(-(a.z() * b.y()))), mul_add(a.z(), b.x(), S(-(a.x() * b.z()))),
                    mul_add(a.x(), b.y(), S(-(a.y() * b.x()))));
}

}  // namespace liecheck
