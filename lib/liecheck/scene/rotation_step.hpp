#pragma once
// Rotations of a step: Q exp(phi), and J_r^-1(phi) omega, with short series for the small angles of most steps.
//
//   exp(phi) = (s phi, c),  y = |phi|^2/4:   s = 1/2 (1 - y/6 + y^2/120 - y^3/5040),   c = 1 - y/2 + y^2/24 - y^3/720
//   J_r^-1(phi) omega = omega + 1/2 phi x omega + d phi x (phi x omega),   d = 1/12 + x/720 + x^2/30240, x = |phi|^2
//
// For |phi|^2 <= 2^-8 the terms that are left out are below 2^-54 of the results. Larger angles, and scalars other
// than double, take the functions of the library.

#include <liecheck/scene/tangent_rate.hpp>
#include <liecheck/spatial/exp_log.hpp>

namespace liecheck::scene {

namespace rotation_step_detail {
template <Scalar S>
constexpr bool has_series = std::is_same_v<S, double>;
constexpr double largest_square = 0x1p-8;

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

/// The rotation matrix of Q, for |Q| = 1 up to rounding. Error 4 eps.
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

/// Q exp(phi), for |Q| = 1 up to rounding. The norm is corrected to first order. Error 6 eps.
template <Scalar S>
[[gnu::always_inline]] inline Vector4<S> rotated(const Vector4<S>& Q, const Vector3<S>& phi) {
  const S x = dot<S>(phi, phi);
  Vector4<S> step;
  if constexpr (rotation_step_detail::has_series<S>) {
    if (x <= rotation_step_detail::largest_square) [[likely]] {
      const S y = x / 4, s = 0.5 - y * (1. / 12 - y * (1. / 240 - y * (1. / 10080))),
              c = 1 - y * (0.5 - y * (1. / 24 - y * (1. / 720)));
      step = Vector4<S>(s * phi[0], s * phi[1], s * phi[2], c);
    } else {
      step = rotation_step_detail::exponential<S>(phi);
    }
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
  if constexpr (rotation_step_detail::has_series<S>) {
    const S x = dot<S>(phi, phi);
    if (x <= rotation_step_detail::largest_square) [[likely]] {
      const S d = 1. / 12 + x * (1. / 720 + x * (1. / 30240));
      const Vector3<S> once = cross<S>(phi, omega), twice = cross<S>(phi, once);
      return each<S>([&](int i) { return S(omega[i] + (once[i] / S(2) + d * twice[i])); });
    }
  }
  return rotation_step_detail::rate<S>(phi, omega);
}

}  // namespace liecheck::scene
