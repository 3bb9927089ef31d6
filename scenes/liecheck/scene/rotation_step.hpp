#pragma once
// Rotations of a step: Q exp(phi), and J_r^-1(phi) omega. In double, the small angles of most steps take short series
// (SmallAngle in stumpff.hpp); larger angles, and other scalars, take the functions for all angles.

#include <liecheck/scalar/stumpff.hpp>
#include <liecheck/scene/tangent_rate.hpp>
#include <liecheck/spatial/exp_log.hpp>

namespace liecheck::scene {

namespace rotation_step_detail {

/// True if SmallAngle applies to x = |phi|^2.
template <Scalar S>
[[gnu::always_inline]] inline bool small(const S& x) {
  if constexpr (std::is_same_v<S, double>)
    return x <= SmallAngle::largest;
  else
    return false;
}
template <Scalar S>
[[gnu::noinline, gnu::cold]] Vector4<S> exponential(const Vector3<S>& phi) {
  return quaternion::exp3<S>(phi).to_vector();
}
template <Scalar S>
[[gnu::noinline, gnu::cold]] Vector3<S> rate(const Vector3<S>& phi, const Vector3<S>& omega) {
  return tangentRate<S>(phi, omega);
}

}  // namespace rotation_step_detail

/// a b of two quaternions (x y z w), rounded plainly.
template <Scalar S>
[[gnu::always_inline]] inline Vector4<S> quaternionProduct(const Vector4<S>& a, const Vector4<S>& b) {
  return Vector4<S>(a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
                    a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
                    a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0],
                    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]);
}

/// The rotation matrix of Q, for |Q| = 1 up to rounding. Error of an entry 8 eps.
template <Scalar S>
[[gnu::always_inline]] inline Matrix3<S> matrixOf(const Vector4<S>& Q) {
  const S x = Q[0] + Q[0], y = Q[1] + Q[1], z = Q[2] + Q[2];
  const S xx = x * Q[0], yy = y * Q[1], zz = z * Q[2], xy = x * Q[1], xz = x * Q[2], yz = y * Q[2],
          wx = x * Q[3], wy = y * Q[3], wz = z * Q[3];
  Matrix3<S> R;
  R << S(1) - (yy + zz), xy - wz, xz + wy, xy + wz, S(1) - (xx + zz), yz - wx, xz - wy, yz + wx,
      S(1) - (xx + yy);
  return R;
}

/// Q exp(phi), for |Q| = 1 up to rounding. The norm is corrected to first order. Error 3 eps.
template <Scalar S>
[[gnu::always_inline]] inline Vector4<S> rotated(const Vector4<S>& Q, const Vector3<S>& phi) {
  const S x = dot<S>(phi, phi);
  Vector4<S> step;
  if (rotation_step_detail::small<S>(x)) [[likely]] {
    const S s(SmallAngle::sine_over_angle(double(x)));
    step = Vector4<S>(s * phi[0], s * phi[1], s * phi[2], S(SmallAngle::cosine(double(x))));
  } else {
    step = rotation_step_detail::exponential<S>(phi);
  }
  const Vector4<S> product = quaternionProduct<S>(Q, step);
  const S scale = (S(3) - ((product[0] * product[0] + product[1] * product[1]) +
                           (product[2] * product[2] + product[3] * product[3]))) /
                  S(2);
  return scale * product;
}

/// J_r^-1(phi) omega. Error 8 eps |omega| for |phi| <= pi.
template <Scalar S>
[[gnu::always_inline]] inline Vector3<S> rotationRate(const Vector3<S>& phi, const Vector3<S>& omega) {
  const S x = dot<S>(phi, phi);
  if (!rotation_step_detail::small<S>(x)) [[unlikely]]
    return rotation_step_detail::rate<S>(phi, omega);
  const S d(SmallAngle::inverse(double(x)));
  const Vector3<S> once = cross<S>(phi, omega), twice = cross<S>(phi, once);
  return each<S>([&](int i) { return S(omega[i] + (once[i] / S(2) + d * twice[i])); });
}

}  // namespace liecheck::scene
