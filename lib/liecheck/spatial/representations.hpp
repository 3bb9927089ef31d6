#pragma once
// Representations of a rotation: axis and angle, Gibbs and modified Rodrigues parameters, and the rotation that is
// nearest to a matrix.
//
//   axis n, angle theta    Q = +-(sin(theta/2) n, cos(theta/2))
//   Gibbs                  g = tan(theta/2) n = v/w                with a pole at theta = pi
//   modified Rodrigues     s = tan(theta/4) n = v/(|Q| + w)        |s| <= 1 for the w >= 0 of Q and -Q
//
// Quaternions of any finite norm but zero stand for their normalised values. Source: Shuster 1993, A survey of attitude
// representations.

#include <liecheck/spatial/relative_rotation.hpp>
#include <liecheck/spatial/so3.hpp>

namespace liecheck {

/// The turn by `angle` [rad] about the unit vector `axis`.
template <Scalar S>
struct AxisAngle {
  Vector3<S> axis;
  S angle;
  /// (axis, angle), shape 4.
  Vector4<S> to_vector() const { return Vector4<S>(axis[0], axis[1], axis[2], angle); }
};

/// The unit quaternion of the rotation nearest to R [3 x 3], |R^T R - I| <= 8 eps, or <= 1/2 for scalars wider than
/// double. Its largest number among the four is positive. Error 2 eps of the rotation, 4 eps of the norm.
/// Source: Shepperd 1978.
template <Scalar S>
SO3<S> toQuaternion(const Matrix3<S>& stored) {
  const Matrix3<S>& R = unit_vector_detail::firstOrderOrthogonal<S>(stored);
  // As SO3::fromMatrix, with E = R^T R - I to eps instead of eps^2, and with what a sum a + b loses added to the small terms
  // of C = -R E/2.
  const auto gram = [&R](int i, int j) __attribute__((always_inline)) {
    return mul_add(R(0, i), R(0, j), mul_add(R(1, i), R(1, j), S(R(2, i) * R(2, j) - S(i == j ? 1 : 0))));
  };
  const S half = S(-1) / S(2), xx = half * gram(0, 0), yy = half * gram(1, 1), zz = half * gram(2, 2),
          xy = half * gram(0, 1), yz = half * gram(1, 2), zx = half * gram(2, 0);
  const auto sum = [](const S& a, const S& b, const S& small) __attribute__((always_inline)) {
    const auto [high, low] = two_sum<S>(a, b);
    return S(high + (low + small));
  };
  const auto unit = [](const S& x, const S& y, const S& z, const S& w) __attribute__((always_inline)) {
    using std::sqrt;
    const S by = S(1) / S(sqrt(S((x * x + y * y) + (z * z + w * w))));
    return SO3<S>(Vector4<S>(by * x, by * y, by * z, by * w));
  };
  const auto C = [&](int i, const S& x, const S& y, const S& z)
      __attribute__((always_inline)) {  // a column of E
    return mul_add(R(i, 0), x, mul_add(R(i, 1), y, S(R(i, 2) * z)));
  };
  const S Cxx = C(0, xx, xy, zx), Cyy = C(1, xy, yy, yz), Czz = C(2, zx, yz, zz);
  const S &X = R(0, 0), &Y = R(1, 1), &Z = R(2, 2);
  // C_32 - C_23 and so on, as sums that vanish with the angle.
  const auto turn = [&](int i, int j, int k, const S& Eij, const S& Eik, const S& Ejk, const S& Ejj,
                        const S& Ekk) __attribute__((always_inline)) {
    return sum(
        R(k, j), S(-R(j, k)),
        (R(k, i) * Eij - R(j, i) * Eik) + (Ejk * (R(k, k) - R(j, j)) + (R(k, j) * Ejj - R(j, k) * Ekk)));
  };
  const auto turn_x = [&]() __attribute__((always_inline)) {
    return turn(0, 1, 2, xy, zx, yz, yy, zz);
  };
  const auto turn_y = [&]() __attribute__((always_inline)) {
    return turn(1, 2, 0, yz, xy, zx, zz, xx);
  };
  const auto turn_z = [&]() __attribute__((always_inline)) {
    return turn(2, 0, 1, zx, yz, xy, xx, yy);
  };
  const auto pivot = [&](const S& a, const S& b, const S& c, const S& small) __attribute__((always_inline)) {
    const auto first = two_sum<S>(S(1), a), last = two_sum<S>(b, c);
    return sum(first.high, last.high, S(first.low + (last.low + small)));
  };
  if (X + Y + Z > S(0)) return unit(turn_x(), turn_y(), turn_z(), pivot(X, Y, Z, (Cxx + Cyy) + Czz));
  const auto pair_xy = [&]() __attribute__((always_inline)) {
    return sum(R(0, 1), R(1, 0), C(0, xy, yy, yz) + C(1, xx, xy, zx));
  };
  const auto pair_yz = [&]() __attribute__((always_inline)) {
    return sum(R(1, 2), R(2, 1), C(1, zx, yz, zz) + C(2, xy, yy, yz));
  };
  const auto pair_zx = [&]() __attribute__((always_inline)) {
    return sum(R(2, 0), R(0, 2), C(2, xx, xy, zx) + C(0, zx, yz, zz));
  };
  if (Z > (X < Y ? Y : X))
    return unit(pair_zx(), pair_yz(), pivot(Z, S(-X), S(-Y), Czz - Cxx - Cyy), turn_z());
  if (X < Y) return unit(pair_xy(), pivot(Y, S(-Z), S(-X), Cyy - Czz - Cxx), pair_yz(), turn_y());
  return unit(pivot(X, S(-Y), S(-Z), Cxx - Cyy - Czz), pair_xy(), pair_zx(), turn_x());
}

/// Axis and angle of Q: theta = 2 atan2(|v|, |w|) in [0, pi], n = sgn(w) v/|v|. The axis of the identity is x. Error 3 eps
/// of theta n, and 2 eps of |n|. Throws std::invalid_argument if Q = 0.
template <Scalar S>
AxisAngle<S> toAxisAngle(const SO3<S>& Q) {
  using std::atan2;
  return unit_vector_detail::atUnitScale(
      [](const Vector4<S>& q) __attribute__((always_inline)) {
        const Vector3<S> v(q[0], q[1], q[2]);
        const S length = relative_rotation_detail::length<S, 3>(v);
        if (length == S(0)) return AxisAngle<S>{Vector3<S>(Vector3<S>::UnitX()), S(0)};
        const Vector3<S> n = normalizedUnit<S, 3>(v);
        return AxisAngle<S>{q[3] < S(0) ? Vector3<S>(-n) : n, S(S(2) * S(atan2(length, absolute<S>(q[3]))))};
      },
      Q.to_vector());
}
/// Q = (sin(angle/2) axis, cos(angle/2)) of a unit axis. Error 3 eps of the rotation, 6 eps of the norm.
template <Scalar S>
SO3<S> fromAxisAngle(const AxisAngle<S>& turn) {
  using std::cos, std::sin;
  const S half = turn.angle / S(2), s = S(sin(half)), c = S(cos(half));
  return SO3<S>(Vector4<S>(s * turn.axis[0], s * turn.axis[1], s * turn.axis[2], c));
}

/// Gibbs parameters v/w of Q. Error 1 eps. Throws std::invalid_argument if w = 0, at theta = pi.
template <Scalar S>
Vector3<S> toGibbs(const SO3<S>& Q) {
  if (Q.w() == S(0)) throw std::invalid_argument("a half turn has no Gibbs parameters");
  return Q.vec() / Q.w();
}
/// Q = (g, 1)/|(g, 1)|. Error 4 eps.
template <Scalar S>
SO3<S> fromGibbs(const Vector3<S>& g) {
  return SO3<S>(normalizedUnit<S, 4>(Vector4<S>(g[0], g[1], g[2], S(1))));
}

/// Modified Rodrigues parameters sgn(w) v/(|Q| + |w|) of Q, of length at most 1. Error 3 eps.
/// Throws std::invalid_argument if Q = 0.
template <Scalar S>
Vector3<S> toModifiedRodrigues(const SO3<S>& Q) {
  return unit_vector_detail::atUnitScale(
      [](const Vector4<S>& q) __attribute__((always_inline)) {
        const S n = relative_rotation_detail::length<S, 4>(q), w = q[3];
        return Vector3<S>(Vector3<S>(q[0], q[1], q[2]) / (w < S(0) ? S(w - n) : S(w + n)));
      },
      Q.to_vector());
}
/// Q = (2 s, 1 - |s|^2)/(1 + |s|^2) of parameters of any length: |s| > 1 is the shadow of -s/|s|^2. Error 4 eps.
template <Scalar S>
SO3<S> fromModifiedRodrigues(const Vector3<S>& s) {
  const S length = relative_rotation_detail::length<S, 3>(s);
  if (S(1) < length) {  // (2 s/|s|^2, 1/|s|^2 - 1)/(1 + 1/|s|^2), whose squares stay finite
    const S inverse = S(1) / length;
    const Vector3<S> shadow = (s / length) * inverse;
    const S square = inverse * inverse, by = S(1) + square;
    return SO3<S>(Vector3<S>(shadow * (S(2) / by)), S(-(S(1) - inverse) * (S(1) + inverse) / by));
  }
  const S by = S(1) + length * length;
  return SO3<S>(Vector3<S>(s * (S(2) / by)), S((S(1) - length) * (S(1) + length) / by));
}

/// The rotation R [3 x 3] that minimises |R - A| (Frobenius): the polar factor of A, |A^T A - I| <= 1/2, det A > 0. Newton
/// and Schulz's iteration X <- X (3 I - X^T X)/2 until its steps are of the order of the rounding, then fromMatrix. Error
/// 8 eps of the rotation; |R^T R - I| <= 8 eps. Throws std::invalid_argument if A is farther from a rotation or not finite.
/// Source: Higham 2008, eq. 8.20.
template <Scalar S>
Matrix3<S> nearestRotation(const Matrix3<S>& A) {
  Matrix3<S> X = A;
  for (int step = 0;; ++step) {
    const Matrix3<S> E = Matrix3<S>(X.transpose() * X) - Matrix3<S>(Matrix3<S>::Identity());
    const S size = E.squaredNorm();
    if (step == 0 && !(size <= S(1) / S(4) && S(0) < X.col(0).dot(cross<S>(X.col(1), X.col(2)))))
      throw std::invalid_argument("a matrix whose nearest rotation is not near: |A^T A - I| is above 1/2");
    if (size * size < eps<S>() * eps<S>() || step == 60) break;  // fromMatrix removes what is left
    X = X - Matrix3<S>(X * E) / S(2);
  }
  return toQuaternion<S>(X).matrix();
}

/// The rotation R [3 x 3] with x along the first column of A and y in the plane of the first two (Gram and Schmidt),
/// |A^T A - I| <= 0.4, det A > 0. Error 8 eps. Throws std::invalid_argument if a column is zero or det A is not above 0.
template <Scalar S>
Matrix3<S> orthonormalized(const Matrix3<S>& A) {
  const Vector3<S> x = normalizedUnit<S, 3>(Vector3<S>(A.col(0))), b = A.col(1),
                   y = normalizedUnit<S, 3>(Vector3<S>(b - dot<S>(x, b) * x)), z = cross<S>(x, y);
  if (!(S(0) < dot<S>(z, Vector3<S>(A.col(2))))) [[unlikely]]
    throw std::invalid_argument("a matrix whose determinant is not above 0 is near no rotation");
  return rows<S>(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]);
}

}  // namespace liecheck
