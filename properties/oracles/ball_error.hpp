#pragma once
// The errors of error.hpp in ball arithmetic. An error above 1 eps is accurate to a relative 1e-4, a smaller
// one to 1e-4 eps. If the balls are too wide for that, Undecided is thrown.
//
// Differences may cancel and are therefore formed in ball arithmetic. Their norms are computed in double,
// with a relative rounding error below 1e-14.

#include <oracles/ball_oracles.hpp>
#include <oracles/scalar.hpp>

namespace liecheck::oracles {

/// Errors of a computed rotation matrix [eps]: of its rotation, and of its orthogonality.
struct MatrixErrors {
  double rotation, defect;
};

/// The error, if its uncertainty `slack` is small enough; otherwise throws Undecided.
inline double settled(double error, double slack) {
  if (!(slack <= error_accuracy * (error > 1 ? error : 1))) throw Undecided();
  return error == 0 && slack > 0 ? std::numeric_limits<double>::denorm_min() : error;  // 0 only if exact
}

/// NaN if either number is NaN.
inline double max(double a, double b) {
  return a > b || std::isnan(a) ? a : b;
}

/// The norm of the midpoints, and an upper bound of the norm of the radii.
struct Length {
  double value = 0, radius = 0;
};
template <int R, int C, BallNumber T>
Length length(const Mat<R, C, T>& v) {
  double largest = 0, r = 0;
  for (const T& x : v.x) {
    largest = max(largest, x.size());
    r = max(r, x.r);
  }
  if (!std::isfinite(largest)) throw Undecided();
  // Scaled by 2^+-600 if squares would leave the exponent range.
  const double scale = largest < 0x1p-400 ? 0x1p600 : largest > 0x1p400 ? 0x1p-600 : 1;
  double square = 0;
  for (const T& x : v.x) {
    const double scaled = x.head() * scale;
    square += scaled * scaled;
  }
  return {std::sqrt(square) / scale, r * (R * C)};
}

template <int R, int C, BallNumber T>
double vector_error(const Scalar& s, const Mat<R, C, T>& computed, const Mat<R, C, T>& exact,
                    const T& scale = T(0)) {
  const double eps = s.epsilon, floor = s.least_denominator();
  const Length error = length(computed - exact), size = length(exact);
  const double given = scale.head() + scale.r, own = size.value;
  const double by = max(max(own, scale.head()), floor);
  const double relative_slack = (max(size.radius, given - scale.head())) / by + 1e-14;
  const double in_eps = error.value / by / eps;
  return settled(in_eps, error.radius / by / eps + in_eps * relative_slack);
}
/// |distance| / eps.
template <BallNumber T>
double in_eps(const Scalar& s, const T& distance) {
  const double error = distance.size() / s.epsilon;
  return settled(error, distance.r / s.epsilon + 1e-14 * error);
}

template <BallNumber T>
double rotation_error(const Scalar& s, const Quaternion<T>& computed, const Quaternion<T>& exact) {
  const Quaternion<T> Q = normalized(computed);
  double along = 0;
  for (int i = 0; i < 4; ++i) along += Q[i].head() * exact[i].head();
  const Length d = length(along < 0 ? Q + exact : Q - exact);
  const double eps = s.epsilon;
  return settled(2 * d.value / eps, 2 * d.radius / eps + 1e-14 * d.value / eps);
}

template <BallNumber T>
double norm_defect(const Scalar& s, const Quaternion<T>& computed) {
  return in_eps(s, squared_norm(computed) - T(1));
}
template <BallNumber T>
double orthogonality_defect(const Scalar& s, const Mat3<T>& computed) {
  Mat3<T> D;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      D(i, j) =
          computed(0, i) * computed(0, j) + computed(1, i) * computed(1, j) + computed(2, i) * computed(2, j);
      if (i == j) D(i, j) -= T(1);
      D(j, i) = D(i, j);
    }
  const Length d = length(D);
  const double eps = s.epsilon;
  return settled(d.value / eps, d.radius / eps + 1e-14 * d.value / eps);
}

/// The errors of a computed matrix. R is the exact result, the rotation matrix of the quaternion `exact`. If
/// E = computed - R has ||E|| < 1e-4, both errors follow from E. E is formed in ball arithmetic, everything
/// after it in double. For a larger E, rotation_error and orthogonality_defect compute the errors.
/// rotation_error is also used if the rotation error from E is not accurate enough.
///
/// Rotation: let computed = U H with the polar factor U. Then
/// R^T E = (R^T U - I) + (H - I) + R^T (U - R)(H - I). Since H - I is symmetric, the antisymmetric parts of
/// R^T E and R^T U - I differ by at most 3 ||E||^2. The antisymmetric part of R^T U - I, as a vector, has
/// the norm sin(angle), where `angle` is the angle between U and R.
///
/// Defect: computed^T computed - I = R^T E + E^T R + E^T E, since R is orthogonal. The uncertainty
/// of the defect is at most 2 (1 + ||E||) times that of E, plus the rounding in double.
template <BallNumber T>
MatrixErrors matrix_errors(const Scalar& s, const Mat3<T>& computed, const Quaternion<T>& exact) {
  const double eps = s.epsilon;
  const Mat3<T> ball = rotation_matrix(exact), E_ball = computed - ball;
  const Length size = length(E_ball);
  const double E_bound = size.value + size.radius;
  if (!(E_bound < 1e-4))
    return {rotation_error(s, nearest_quaternion(computed), exact), orthogonality_defect(s, computed)};
  double R[3][3], E[3][3], across[3][3];  // across = R^T E
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R[i][j] = ball(i, j).head(), E[i][j] = E_ball(i, j).head();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) across[i][j] = R[0][i] * E[0][j] + R[1][i] * E[1][j] + R[2][i] * E[2][j];
  double skew = 0, square = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const double off = (across[i][j] - across[j][i]) / 2,
                   d = across[i][j] + across[j][i] +
                       (E[0][i] * E[0][j] + E[1][i] * E[1][j] + E[2][i] * E[2][j]);
      skew += off * off;
      square += (i == j ? 1 : 2) * d * d;
    }
  const double sine = std::sqrt(skew), defect = std::sqrt(square);
  const double bound = 3 * E_bound * E_bound + 2 * size.radius + 1e-14 * size.value;
  MatrixErrors errors{};
  errors.rotation = bound <= error_accuracy * max(sine, eps)
                        ? settled(sine / eps, bound / eps)
                        : rotation_error(s, nearest_quaternion(computed), exact);
  errors.defect = settled(defect / eps, (2 * (1 + E_bound) * size.radius + 1e-14 * size.value) / eps);
  return errors;
}

}  // namespace liecheck::oracles
