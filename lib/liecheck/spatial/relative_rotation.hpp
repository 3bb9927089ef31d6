#pragma once
// Between two rotations, and between two directions: the relative angle, the twist angle, spherical linear
// interpolation (slerp) and the minimal rotation.
//
// Q and -Q are the same rotation, and every function takes the shorter of both arcs. Quaternions and directions of
// any finite norm stand for their normalised values, and zero is refused (std::invalid_argument). The axis of a relative
// rotation is that of differenceSE3 (multibody/se3_configuration.hpp), whose error is relative however small the angle is.

#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/so3.hpp>
#include <liecheck/spatial/unit_scale.hpp>

namespace liecheck {

namespace relative_rotation_detail {

/// |v| [unit of v] without overflow or underflow of |v|^2. Error 3 eps.
template <Scalar S, int N>
[[gnu::noinline]] S scaledLength(const Eigen::Matrix<S, N, 1>& v) {
  using std::sqrt;
  const S scale = v.cwiseAbs().maxCoeff();
  if (!(scale > S(0)) || !finite<S>(scale)) return scale;
  return scale * S(sqrt(Eigen::Matrix<S, N, 1>(v / scale).squaredNorm()));
}
/// The same, scaled only where the sum of squares is not accurate. Error 2 eps.
template <Scalar S, int N>
[[gnu::always_inline]] inline S length(const Eigen::Matrix<S, N, 1>& v) {
  using std::sqrt;
  const S square = unit_vector_detail::square<S, N>(v);
  if (unit_vector_detail::squareIsAccurate<S>(square)) [[likely]]
    return sqrt(square);
  return scaledLength<S, N>(v);
}
/// s = sgn(a . b) if |a| and |b| differ by less than a factor of 2, and otherwise 0: the products of a with b - s a are those
/// of a with b, and their terms do not cancel if a and s b are close. If the norms differ, b - s a would be rounded.
template <Scalar S, int N>
[[gnu::always_inline]] inline S multipleToSubtract(const Eigen::Matrix<S, N, 1>& a,
                                                   const Eigen::Matrix<S, N, 1>& b, const S& product) {
  const S aa = unit_vector_detail::square<S, N>(a), bb = unit_vector_detail::square<S, N>(b);
  return aa < S(4) * bb && bb < S(4) * aa ? sign<S>(product) : S(0);
}
/// A unit vector that is perpendicular to the unit vector a. Error 3 eps.
template <Scalar S>
Vector3<S> perpendicular(const Vector3<S>& a) {
  int least = 0;
  a.cwiseAbs().minCoeff(&least);
  return normalizedUnit<S, 3>(cross<S>(a, Vector3<S>(Vector3<S>::Unit(least))));
}
/// c/|c| without its part along the unit vector a. If nothing else is left of c, a unit vector perpendicular to a.
template <Scalar S>
Vector3<S> perpendicularPart(const Vector3<S>& c, const Vector3<S>& a) {
  if (c.isZero(S(0))) return perpendicular<S>(a);
  const Vector3<S> n = normalizedUnit<S, 3>(c), part = n - dot<S>(a, n) * a;
  return dot<S>(part, part) < S(1) / S(2) ? perpendicular<S>(a) : normalizedUnit<S, 3>(part);
}

}  // namespace relative_rotation_detail

/// The angle [rad] of the rotation from Q0 to Q1, in [0, pi]: theta = 2 atan2(|v|, |w|) of (v, w) = Q0* Q1. The
/// vector part is that of Q0* (Q1 - Q0), whose terms do not cancel if Q0 and Q1 are close. Error 4 eps of the
/// larger of theta and 2 |t|, where t_i is the sum of the sizes of the terms of v_i. NaN if a number is not finite.
/// Source: Sola 2017 (arXiv 1711.02508), eq. 78.
template <Scalar S>
S relativeAngle(const SO3<S>& Q0, const SO3<S>& Q1) {
  using std::atan2;
  return unit_vector_detail::atUnitScale(
      [](const Vector4<S>& a, const Vector4<S>& b) __attribute__((always_inline)) {
        const S w = a.dot(b), s = relative_rotation_detail::multipleToSubtract<S, 4>(a, b, w);
        const Vector3<S> v = (SO3<S>(a).inverse() * SO3<S>(Vector4<S>(b - s * a))).vec();
        return S(S(2) * S(atan2(relative_rotation_detail::length<S, 3>(v), absolute<S>(w))));
      },
      Q0.to_vector(), Q1.to_vector());
}

/// The angle [rad] by which Q = (v, w) turns about `axis` [3], in [-pi, pi]: 2 atan2(v . axis/|axis|, w), that of
/// the twist in Q = swing twist. Error 3 eps of the larger of |angle| and its sensitivity
/// 2 |w| (|v . axis| + sum_i |v_i axis_i|)/(w^2 + (v . axis)^2), where |axis| = 1. It is not determined if w and
/// v . axis are both zero; then it is 0 or pi. Source: Dobrowolski 2015 (swing-twist decomposition), eq. 18.
template <Scalar S>
S twistAngle(const SO3<S>& Q, const Vector3<S>& axis) {
  using std::atan2;
  return unit_vector_detail::atUnitScale(
      [](const Vector4<S>& q, const Vector3<S>& a) __attribute__((always_inline)) {
        const S s = dot<S>(Vector3<S>(q[0], q[1], q[2]), a),
                w = q[3] * relative_rotation_detail::length<S, 3>(a);
        return w < S(0) ? S(S(2) * S(atan2(S(-s), S(-w)))) : S(S(2) * S(atan2(s, w)));
      },
      Q.to_vector(), axis);
}

/// The rotation at t of the shorter arc from Q0 (t = 0) to Q1 (t = 1): Q0 (Q0* Q1)^t = Q0 exp(t log(Q0* Q1)), as a
/// unit quaternion. It is computed from the nearer end, for any t in [0, 1]. If the relative angle is pi, either arc.
/// Error 8 eps of the rotation, 6 eps of the norm. Throws std::invalid_argument if Q0 or Q1 is zero.
/// Source: Shoemake 1985, section 3.3.
template <Scalar S>
SO3<S> slerp(const SO3<S>& Q0, const SO3<S>& Q1, const S& t) {
  if (S(1) / S(2) < t) return slerp<S>(Q1, Q0, S(S(1) - t));
  const SO3<S> from = Q0.normalized();
  const Vector3<S> phi = quaternion::log3<S>(from.inverse() * Q1.normalized());
  return (from * quaternion::exp3<S>(Vector3<S>(t * phi))).normalized();
}

/// The rotation with the smallest angle that turns direction a [3] into direction b [3], a and b not zero:
///     Q = (sin(theta/2) n, cos(theta/2)),  sin(theta/2) = |a - b|/2,  cos(theta/2) = |a + b|/2,  n ~ a x b
/// of unit vectors. n is that of a x (b - a) or, beyond a right angle, of a x (a + b): neither difference cancels. For
/// opposite directions n is perpendicular to a and otherwise arbitrary. Error of R a/|a|, and of n . a: 8 eps. Throws
/// std::invalid_argument if a or b is zero. Source: Sola 2017 (arXiv 1711.02508), eq. 99-101 (the same half angles).
template <Scalar S>
SO3<S> rotationBetween(const Vector3<S>& a, const Vector3<S>& b) {
  using namespace relative_rotation_detail;
  const Vector3<S> from = normalizedUnit<S, 3>(a), to = normalizedUnit<S, 3>(b), plus = from + to,
                   minus = to - from;
  const bool acute = S(0) < dot<S>(from, to);
  const Vector3<S> c = acute ? cross<S>(from, minus) : cross<S>(from, plus),
                   n = perpendicularPart<S>(c, from);
  return SO3<S>(Vector3<S>((length<S, 3>(minus) / S(2)) * n), S(length<S, 3>(plus) / S(2))).normalized();
}

/// The angle [rad] between two directions a and b [3], not zero, in [0, pi]: atan2(|a x b|, a . b). a x b is a x (b - a), or
/// a x (a + b) beyond a right angle, whose terms do not cancel if a and b are close or nearly opposite. Error 4 eps of the
/// larger of theta and |t|, where t_i is the sum of the sizes of the terms of (a x b)_i, of unit vectors.
/// Source: Kahan 2006, How futile are mindless assessments of roundoff, section 12.
template <Scalar S>
S angleBetween(const Vector3<S>& a, const Vector3<S>& b) {
  using std::atan2;
  return unit_vector_detail::atUnitScale(
      [](const Vector3<S>& x, const Vector3<S>& y) __attribute__((always_inline)) {
        const S cosine = dot<S>(x, y), s = relative_rotation_detail::multipleToSubtract<S, 3>(x, y, cosine);
        const Vector3<S> c = cross<S>(x, each<S>([&](int i) { return S(y[i] - s * x[i]); }));
        return S(atan2(relative_rotation_detail::length<S, 3>(c), cosine));
      },
      a, b);
}

/// The unit vector at t in [0, 1] of the shorter arc from direction a (t = 0) to direction b (t = 1), from the nearer end:
/// cos(t theta) a + sin(t theta) n, n the part of b across a. For opposite directions any arc. Error 6 eps, and near opposite
/// directions eps/(pi - theta). Throws std::invalid_argument if a or b is zero. Source: Shoemake 1985, section 3.3.
template <Scalar S>
Vector3<S> slerp(const Vector3<S>& a, const Vector3<S>& b, const S& t) {
  using std::atan2, std::cos, std::sin;
  using namespace relative_rotation_detail;
  if (S(1) / S(2) < t) return slerp<S>(b, a, S(S(1) - t));
  const Vector3<S> from = normalizedUnit<S, 3>(a), to = normalizedUnit<S, 3>(b);
  const bool acute = S(0) < dot<S>(from, to);
  const Vector3<S> minus = to - from, plus = to + from, difference = acute ? minus : plus,
                   part = difference - dot<S>(from, difference) * from;
  // A part that is small in the difference has rounding errors along `from`.
  const Vector3<S> across = dot<S>(difference, difference) < S(4) * dot<S>(part, part)
                                ? normalizedUnit<S, 3>(part)
                                : perpendicularPart<S>(part, from);
  const S at = t * (S(2) * S(atan2(length<S, 3>(minus), length<S, 3>(plus))));
  return normalizedUnit<S, 3>(Vector3<S>(S(cos(at)) * from + S(sin(at)) * across));
}

}  // namespace liecheck
