#pragma once
// Quaternions x y z w over any scalar type of the oracles, and the rotation matrices of unit quaternions.

#include <oracles/linear_algebra.hpp>

namespace liecheck::oracles {

/// x y z w.
template <class T = Real>
using Quaternion = Vec<4, T>;

/// Q of q = (p, Q).
template <class T>
Quaternion<T> quaternion_of(const Vec7<T>& q) {
  return {{q[3], q[4], q[5], q[6]}};
}

template <class T>
Quaternion<T> quaternion_product(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {{a[3] * b[0] + a[0] * b[3] + (a[1] * b[2] - a[2] * b[1]),
           a[3] * b[1] + a[1] * b[3] + (a[2] * b[0] - a[0] * b[2]),
           a[3] * b[2] + a[2] * b[3] + (a[0] * b[1] - a[1] * b[0]),
           a[3] * b[3] - (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])}};
}

/// The quaternion product a* b, grouped in the minors a_i b_j - a_j b_i. The squares of the six minors add up
/// to ||v||^2 (Lagrange, Pluecker). If the minors are exact (products of two 113-bit numbers at 334 bits),
/// the vector part v therefore keeps its relative accuracy even if a and b are nearly equal.
template <class T>
Quaternion<T> conjugate_product(const Quaternion<T>& a, const Quaternion<T>& b) {
  const auto minor = [&](int i, int j) -> T { return a[i] * b[j] - a[j] * b[i]; };
  return {{minor(3, 0) - minor(1, 2), minor(3, 1) - minor(2, 0), minor(3, 2) - minor(0, 1),
           a[3] * b[3] + (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])}};
}

template <class T>
Quaternion<T> normalized(const Quaternion<T>& q) {
  return T(1 / norm(q)) * q;
}

/// x rotated by Q / ||Q||, that is x + 2 (w v x x + v x (v x x)) / ||Q||^2, or by the inverse rotation.
template <class T>
Vec3<T> rotate(const Quaternion<T>& q, const Vec3<T>& x, bool inverse = false) {
  const Vec3<T> v = head3(q);
  const Vec3<T> vx = cross(v, x);
  const T s = 2 / squared_norm(q), w = inverse ? T(-q[3]) : q[3];
  return x + s * (w * vx + cross(v, vx));
}

/// R(Q) - I = 2 w [v] + 2 [v]^2 of a unit quaternion, with full relative accuracy at any small angle.
template <class T>
Mat3<T> rotation_minus_identity(const Quaternion<T>& q) {
  Mat3<T> E;
  T square[3], off, skew;
  for (int i = 0; i < 3; ++i) set_product(square[i], q[i], q[i]);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    E(i, i) = twice(T(-(square[j] + square[k])));
    set_product(off, q[j], q[k]);
    set_product(skew, q[3], q[i]);
    E(j, k) = twice(T(off - skew));
    E(k, j) = twice(T(off + skew));
  }
  return E;
}
template <class T>
Mat3<T> rotation_matrix(const Quaternion<T>& unit) {
  Mat3<T> R = rotation_minus_identity(unit);
  for (int i = 0; i < 3; ++i) R(i, i) += T(1);
  return R;
}

}  // namespace liecheck::oracles
