#pragma once
// Euler angles (a, b, c) [rad] in any of the 24 orders. An order names three axes i, j, k with i != j != k:
//
//   rotating axes   R = R_i(a) R_j(b) R_k(c)     each rotation about an axis of the body, as it was turned before
//   static axes     R = R_k(c) R_j(b) R_i(a)     each rotation about an axis of the parent
//
// R_i(a) is the right-handed rotation by a about axis i. So ZYX with rotating axes (yaw, pitch, roll) is XYZ with
// static axes (roll, pitch, yaw) in the opposite order of the angles. If k = i, the angles are proper Euler angles.
//
// From a rotation: a and c are in [-pi, pi]; b is in [-pi/2, pi/2], or in [0, pi] for proper Euler angles. At the ends
// of the range of b only a + c or a - c is determined (gimbal lock). The angles are computed from sums and differences
// of the quaternion's numbers, so that they give the rotation back with the same small error there as elsewhere.

#include <liecheck/spatial/so3.hpp>
#include <stdexcept>

namespace liecheck {

/// Axes 0 (x), 1 (y) and 2 (z).
struct EulerOrder {
  int i, j, k;
  bool rotating;

  /// Orders by number: sequence 0 ... 11 is XYZ XZY YXZ YZX ZXY ZYX XYX XZX YXY YZY ZXZ ZYZ; number = 2 sequence
  /// for static axes, and 2 sequence + 1 for rotating axes. Throws std::invalid_argument for any other number.
  static EulerOrder numbered(int number) {
    static constexpr int axes[12][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0},
                                        {0, 1, 0}, {0, 2, 0}, {1, 0, 1}, {1, 2, 1}, {2, 0, 2}, {2, 1, 2}};
    if (number < 0 || number > 23)
      throw std::invalid_argument("the number of an order of Euler angles is from 0 to 23");
    const int* const a = axes[number / 2];
    return {a[0], a[1], a[2], number % 2 == 1};
  }
  bool proper() const { return i == k; }
};

namespace euler_detail {

/// The quaternion of a rotation by `angle` about a coordinate axis.
template <Scalar S>
SO3<S> about(int axis, const S& angle) {
  using std::cos, std::sin;
  const S half = angle / S(2);
  return SO3<S>(Vector3<S>(S(sin(half)) * Vector3<S>::Unit(axis)), S(cos(half)));
}
/// x in (-2 pi, 2 pi), brought to [-pi, pi].
template <Scalar S>
S wrapped(const S& x) {
  if (pi<S>() < x) return x - S(2) * pi<S>();
  return x < -pi<S>() ? S(x + S(2) * pi<S>()) : x;
}

}  // namespace euler_detail

/// Q of Euler angles [3, rad]. Rotation error 5 eps, for |angles| <= 2 pi; for larger ones, sine and cosine of the
/// scalar decide. Source: Diebel 2006, section 8.
template <Scalar S>
SO3<S> eulerToQuaternion(const EulerOrder& order, const Vector3<S>& angles) {
  using euler_detail::about;
  const SO3<S> first = about<S>(order.i, angles[0]), second = about<S>(order.j, angles[1]),
               third = about<S>(order.k, angles[2]);
  return order.rotating ? first * second * third : third * second * first;
}

/// R [3 x 3] of Euler angles [3, rad]. Rotation error 8 eps.
template <Scalar S>
Matrix3<S> eulerToMatrix(const EulerOrder& order, const Vector3<S>& angles) {
  return eulerToQuaternion<S>(order, angles).matrix();
}

/// Euler angles [3, rad] of a rotation Q != 0 of any norm, in the ranges above. The rotation that they give back has
/// an error of 12 eps, at gimbal lock too. Throws std::invalid_argument if Q = 0.
/// Source: Bernardes & Viollet 2022 (PLoS ONE 17, e0276302), algorithm 1.
template <Scalar S>
Vector3<S> eulerFromQuaternion(const EulerOrder& order, const SO3<S>& Q) {
  using std::atan2;
  const Vector4<S> scaled = unit_vector_detail::atUnitScale(
      [](const Vector4<S>& x) __attribute__((always_inline)) { return x; }, Q.to_vector());
  // The formulas are those of static axes i, j, k; rotating axes are static ones in the opposite order.
  const int i = order.rotating ? order.k : order.i, j = order.j, k = 3 - i - j;
  const S sign((j - i + 3) % 3 == 1 ? 1 : -1), w = scaled[3];
  const Vector3<S> v(scaled[0], scaled[1], scaled[2]);
  S x = w, y = v[i], z = v[j], u = sign * v[k];
  if (!order.proper()) x = w - v[j], y = v[i] + sign * v[k], z = v[j] + w, u = sign * v[k] - v[i];
  const auto length = [](const S& p, const S& q) {
    using std::sqrt;
    const S larger = absolute<S>(p) < absolute<S>(q) ? absolute<S>(q) : absolute<S>(p);
    if (!(larger > S(0)) || !finite<S>(larger)) return larger;
    return S(larger * S(sqrt(S((p / larger) * (p / larger) + (q / larger) * (q / larger)))));
  };
  const S plus = atan2(y, x), minus = atan2(u, z);
  S second = S(2) * S(atan2(length(z, u), length(x, y))), third = plus + minus;
  if (!order.proper()) third = sign * third, second = second - pi<S>() / S(2);
  const S first = euler_detail::wrapped<S>(S(plus - minus));
  third = euler_detail::wrapped<S>(third);
  return order.rotating ? Vector3<S>(third, second, first) : Vector3<S>(first, second, third);
}

/// Euler angles [3, rad] of the rotation nearest to R [3 x 3], |R^T R - I| <= 8 eps. The rotation that they give
/// back has an error of 14 eps.
template <Scalar S>
Vector3<S> eulerFromMatrix(const EulerOrder& order, const Matrix3<S>& R) {
  return eulerFromQuaternion<S>(order, SO3<S>::fromMatrix(R));
}

}  // namespace liecheck
