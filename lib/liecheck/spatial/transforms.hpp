#pragma once
// What follows from a pose or a motion: a covariance in other axes, and the screw of a motion.

#include <liecheck/spatial/relative_rotation.hpp>
#include <liecheck/spatial/se3.hpp>
#include <liecheck/spatial/symmetric3.hpp>

namespace liecheck {

/// Sigma_A = Ad Sigma_B Ad^T [6 x 6; m^2, m rad, rad^2], Ad = [[R, [p] R], [0, R]], of a symmetric Sigma_B. The result is
/// symmetric exactly. Error of entry (k, l): 8 eps s_k s_l with s^2 = |S_ll| + 2 |p| |S_la| + |p|^2 |S_aa| of linear numbers and
/// |S_aa| of angular ones.
/// Source: Barfoot & Furgale 2014, eq. 40.
template <Scalar S>
Matrix6<S> transported(const SE3<S>& X, const Matrix6<S>& Sigma) {
  const Matrix3<S>& R = X.rotation();
  const Vector3<S>& p = X.translation();
  const auto block = [&](int i, int j) __attribute__((always_inline)) {
    return rows<S>(Sigma(i, j), Sigma(i, j + 1), Sigma(i, j + 2), Sigma(i + 1, j), Sigma(i + 1, j + 1),
                   Sigma(i + 1, j + 2), Sigma(i + 2, j), Sigma(i + 2, j + 1), Sigma(i + 2, j + 2));
  };
  const Symmetric3<S> ll = Symmetric3<S>::rotated(R, block(0, 0)),
                      aa = Symmetric3<S>::rotated(R, block(3, 3));
  const Matrix3<S> la = product<S>(product<S>(R, block(0, 3)), transposed<S>(R)), a = aa.matrix();
  // The columns of B = la + P aa; then ll + P la^T - B P = ll + P la^T + (P B^T)^T.
  const auto column = [](const Matrix3<S>& m, int j) __attribute__((always_inline)) {
    return Vector3<S>(m(0, j), m(1, j), m(2, j));
  };
  const auto row = [](const Matrix3<S>& m, int i) __attribute__((always_inline)) {
    return Vector3<S>(m(i, 0), m(i, 1), m(i, 2));
  };
  const Vector3<S> b0 = add_cross<S>(column(la, 0), p, column(a, 0)),
                   b1 = add_cross<S>(column(la, 1), p, column(a, 1)),
                   b2 = add_cross<S>(column(la, 2), p, column(a, 2));
  const Matrix3<S> B = rows<S>(b0[0], b1[0], b2[0], b0[1], b1[1], b2[1], b0[2], b1[2], b2[2]);
  const Vector3<S> c0 = cross<S>(p, row(la, 0)), c1 = cross<S>(p, row(la, 1)), c2 = cross<S>(p, row(la, 2)),
                   d0 = cross<S>(p, row(B, 0)), d1 = cross<S>(p, row(B, 1)), d2 = cross<S>(p, row(B, 2));
  Matrix6<S> result;
  result(0, 0) = ll.xx + (c0[0] + d0[0]), result(1, 1) = ll.yy + (c1[1] + d1[1]),
            result(2, 2) = ll.zz + (c2[2] + d2[2]);
  result(0, 1) = result(1, 0) = ll.xy + (c1[0] + d0[1]),
            result(0, 2) = result(2, 0) = ll.xz + (c2[0] + d0[2]);
  result(1, 2) = result(2, 1) = ll.yz + (c2[1] + d1[2]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      result(i, 3 + j) = result(3 + j, i) = B(i, j);
      result(3 + i, 3 + j) = a(i, j);
    }
  return result;
}

/// A motion as a screw: turning about an axis through `point` while moving along it by `pitch`.
template <Scalar S>
struct Screw {
  Vector3<S> axis;   ///< omega/|omega|
  S pitch;           ///< u . omega/|omega|^2 [m/rad]
  Vector3<S> point;  ///< omega x u/|omega|^2 [m], the point of the axis nearest to the origin
  /// (axis, pitch, point), shape 7.
  Vector7<S> to_vector() const { return (Vector7<S>() << axis, pitch, point).finished(); }
};
/// The screw of a motion V = (u [m/s], omega [rad/s]). Error 4 eps of the axis; of pitch and point 6 eps |u|/|omega|. Throws
/// std::invalid_argument if omega = 0, of which the pitch is infinite. Source: Murray, Li & Sastry 1994, section 2.3.3.
template <Scalar S>
Screw<S> screwOf(const Motion<S>& V) {
  const S length = relative_rotation_detail::length<S, 3>(V.angular());
  if (length == S(0)) throw std::invalid_argument("a translation has no screw axis");
  const Vector3<S> n = V.angular() / length, u = V.linear();
  return {n, S(dot<S>(u, n) / length), Vector3<S>(cross<S>(n, u) / length)};
}

}  // namespace liecheck
