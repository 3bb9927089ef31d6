#pragma once
// States of motions, which a closed form or a reference solution gives at a time t [s].
//
// The motions of this folder do not use the library's spatial algebra, dynamics and integrators.

#include <oracles/quaternion.hpp>

namespace liecheck::oracles {

/// A free rigid body's frame B in the world W.
template <class T = Real>
struct BodyState {
  Vec3<T> p;        ///< p_WBo_W [m]
  Quaternion<T> Q;  ///< R_WB, unit, x y z w
  Vec3<T> u;        ///< v_WBo_B: velocity of the origin of B, in the axes of B [m/s]
  Vec3<T> omega;    ///< in the axes of B [rad/s]
};

/// A body that rotates about a fixed point.
template <class T = Real>
struct AttitudeState {
  Quaternion<T> Q;
  Vec3<T> omega;
};

/// One coordinate: [rad, rad/s] or [m, m/s].
template <class T = Real>
struct CoordinateState {
  T q, v;
};

/// Mass [kg], centre of mass p_BoBcm_B [m], inertia about the centre of mass in the axes of B [kg m^2].
template <class T = Real>
struct Body {
  T mass;
  Vec3<T> lever;
  Mat3<T> inertia;
};

/// exp of a rotation vector phi [rad], as a unit quaternion.
template <class T>
Quaternion<T> rotation_by(const Vec3<T>& phi) {
  const T angle = norm(phi);
  if (angle == 0) return {{T(0), T(0), T(0), T(1)}};
  T sine, cosine;
  sin_cos(T(angle / 2), sine, cosine);
  const T s = sine / angle;
  return {{s * phi[0], s * phi[1], s * phi[2], cosine}};
}

/// The unit quaternion of a rotation matrix, by its largest pivot.
template <class T>
Quaternion<T> quaternion_of(const Mat3<T>& R) {
  Quaternion<T> q;
  const T trace = R(0, 0) + R(1, 1) + R(2, 2);
  int i = 0;
  for (int j = 1; j < 3; ++j)
    if (R(j, j) > R(i, i)) i = j;
  if (trace >= R(i, i)) {
    q = {{R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1), T(1 + trace)}};
  } else {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1 + R(i, i) - R(j, j) - R(k, k);
    q[j] = R(i, j) + R(j, i);
    q[k] = R(i, k) + R(k, i);
    q[3] = R(k, j) - R(j, k);
  }
  return normalized(q);
}

/// Angle between two rotations, 2 asin ||vec(Q1* Q2)||, in [0, pi] [rad], with relative accuracy.
template <class T>
T angle_between(const Quaternion<T>& a, const Quaternion<T>& b) {
  const Quaternion<T> d = conjugate_product(normalized(a), normalized(b));
  return 2 * atan2(norm(head3(d)), abs(d[3]));
}

}  // namespace liecheck::oracles
