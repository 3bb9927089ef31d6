#pragma once
// What follows from a pose or a motion: a covariance in other axes, and the screw of a motion.

#include <liecheck/spatial/relative_rotation.hpp>
#include <liecheck/spatial/se3.hpp>

namespace liecheck {

/// Sigma_A = Ad Sigma_B Ad^T [6 x 6; m^2, m rad, rad^2], Ad = [[R, [p] R], [0, R]], of a symmetric Sigma_B. The result is
/// symmetric exactly. Error of entry (k, l): 8 eps s_k s_l with s^2 = |S_ll| + 2 |p| |S_la| + |p|^2 |S_aa| of linear numbers and
/// |S_aa| of angular ones.
/// Source: Barfoot & Furgale 2014, eq. 40.
template <Scalar S>
Matrix6<S> transported(const SE3<S>& X, const Matrix6<S>& Sigma) {
  const Matrix3<S>&R = X.rotation(), Rt = R.transpose();
  const auto rotated = [&](int i, int j) -> Matrix3<S> {
    return R * Matrix3<S>(Sigma.template block<3, 3>(3 * i, 3 * j)) * Rt;
  };
  const Matrix3<S> ll = rotated(0, 0), la = rotated(0, 1), aa = rotated(1, 1), P = skew<S>(X.translation()),
                   paa = P * aa, la_A = la + paa;
  Matrix6<S> result;
  // ll + P la^T + la P^T + P aa P^T, P^T = -P.
  result << ll + P * la.transpose() - la_A * P, la_A, la_A.transpose(), aa;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < i; ++j) result(i, j) = result(j, i);
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
