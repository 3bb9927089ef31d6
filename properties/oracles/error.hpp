#pragma once
// The distance of a computed value from the exact one, in eps of the scalar that computed it.
//
// Computed values are passed as exact numbers (exact_vector, exact_matrix) after all_finite has returned
// true. A NaN would still give infinity, so that it never passes a test. The rotation error of a matrix is
// that of its polar factor's quaternion: 4 sin(angle / 4), where `angle` is between the computed and the
// exact rotation. The distance from orthogonality is a separate block.
//
// The errors have an absolute accuracy of 1e-45; as doubles they have a relative accuracy of 1e-16.

#include <algorithm>
#include <oracles/ball_error.hpp>
#include <oracles/log.hpp>
#include <type_traits>

namespace liecheck::oracles {

/// 2 min(||Q/||Q|| - exact||, ||Q/||Q|| + exact||) for a unit quaternion `exact`. For Q = 0 it is 2 sqrt(2),
/// the largest distance that two rotations have.
Real rotation_distance(const Quaternion<>& computed, const Quaternion<>& exact);
/// The same for the polar factor of a stored matrix. It is 2 sqrt(2) if the matrix has no nearest one.
Real rotation_distance(const Mat3<>& computed, const Quaternion<>& exact);
/// | ||Q||^2 - 1 |
Real norm_distance(const Quaternion<>& computed);
/// || R^T R - I ||_F
Real orthogonality_distance(const Mat3<>& computed);

/// 2^e as a number of an oracle.
template <class T>
T two_to(int e) {
  if constexpr (BallNumber<T>)
    return std::ldexp(1.0, e);
  else
    return ldexp(T(1), e);
}

/// distance / eps; infinity for NaN.
inline double in_eps(const Scalar& s, const Real& distance) {
  const double e = static_cast<double>(Real(distance / Real(s.epsilon)));
  return e >= 0 ? e : std::numeric_limits<double>::infinity();
}

/// Whether every element of a vector or matrix of any scalar is finite.
template <class M>
bool all_finite(const M& m) {
  if constexpr (requires {
                  requires std::is_same_v<M, typename M::PlainObject>;
                }) {  // a matrix of Eigen, whose numbers follow each other in memory
    return std::all_of(m.data(), m.data() + m.size(), [](const auto& x) {
      using std::isfinite;
      return isfinite(x);
    });
  } else if constexpr (requires { m.rows(); }) {
    for (int i = 0; i < m.rows(); ++i)
      for (int j = 0; j < m.cols(); ++j) {
        using std::isfinite;
        if (!isfinite(m(i, j))) return false;
      }
  } else {
    for (const auto& x : m) {
      using std::isfinite;
      if (!isfinite(x)) return false;
    }
  }
  return true;
}

/// `computed` is a quaternion or a matrix.
template <int R, int C>
double rotation_error(const Scalar& s, const Mat<R, C>& computed, const Quaternion<>& exact) {
  return in_eps(s, rotation_distance(computed, exact));
}
inline double norm_defect(const Scalar& s, const Quaternion<>& computed) {
  return in_eps(s, norm_distance(computed));
}
inline double orthogonality_defect(const Scalar& s, const Mat3<>& computed) {
  return in_eps(s, orthogonality_distance(computed));
}

inline MatrixErrors matrix_errors(const Scalar& s, const Mat3<>& computed, const Quaternion<>& exact) {
  return {rotation_error(s, computed, exact), orthogonality_defect(s, computed)};
}

/// ||computed - exact|| / max(||exact||, scale, min_normal / eps), in eps, with Frobenius norms of matrices.
template <int R, int C>
double vector_error(const Scalar& s, const Mat<R, C>& computed, const Mat<R, C>& exact,
                    const Real& scale = Real(0)) {
  Real size = norm(exact);
  if (scale > size) size = scale;
  if (s.least_denominator() > size) size = s.least_denominator();
  return in_eps(s, Real(norm(computed - exact) / size));
}
template <class T>
double scalar_error(const Scalar& s, const T& computed, const T& exact, const T& scale = T(0)) {
  return vector_error(s, Vec<1, T>{{computed}}, Vec<1, T>{{exact}}, scale);
}

struct TwistError {
  double linear = 0, angular = 0;
};
/// The errors of the two blocks of a log or difference. At theta = pi two values are exact, and the one
/// nearer to the computed rotation vector is used. The blocks' denominators are at least the scales, of which
/// linear_scale is ||p1 - p0|| for difference.
template <class T>
TwistError log_error(const Scalar& s, const Vec6<T>& computed, const LogValue<T>& exact,
                     const T& linear_scale = T(0), const T& angular_scale = T(0)) {
  const auto against = [&](const Vec6<T>& value) -> TwistError {
    return {vector_error(s, head3(computed), head3(value), linear_scale),
            vector_error(s, tail3(computed), tail3(value), angular_scale)};
  };
  const TwistError first = against(exact.value());
  if (!exact.at_pi) return first;
  const TwistError second = against(exact.other);
  return second.angular < first.angular ? second : first;
}

}  // namespace liecheck::oracles
