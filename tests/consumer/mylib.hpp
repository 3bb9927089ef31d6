#pragma once
// mylib, the library of somebody else. It has four faults:
//   exp            a cutoff for small angles: below 1e-3 its error is theta^2 / 24
//   log            the sign near pi: a w just below 0 counts as positive
//   left_jacobian  the coupling block: a term has the wrong sign
//   matrix         NaN for a subnormal angle, whose inverse is infinite
// Its inverse of a pose is right.
#include <array>
#include <cmath>

namespace mylib {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;
struct Quaternion {
  double w, x, y, z;
};
struct Pose {
  Matrix R;
  Vector p;
};
struct Jacobian {  ///< [J, coupling; 0, J]
  Matrix J, coupling;
};

inline double length(const Vector& v) {
  return std::hypot(v[0], v[1], v[2]);
}
inline Matrix hat(const Vector& v) {
  return {Vector{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}};
}
inline Matrix operator*(const Matrix& A, const Matrix& B) {
  Matrix C{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C[i][j] = A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j];
  return C;
}
inline Matrix operator*(double s, Matrix A) {
  for (Vector& row : A)
    for (double& x : row) x *= s;
  return A;
}
inline Matrix operator+(Matrix A, const Matrix& B) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A[i][j] += B[i][j];
  return A;
}
inline const Matrix identity = {Vector{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline Quaternion exp(const Vector& phi) {
  const double theta = length(phi), s = theta < 1e-3 ? 0.5 : std::sin(theta / 2) / theta;
  return {std::cos(theta / 2), s * phi[0], s * phi[1], s * phi[2]};
}

inline Vector log(const Quaternion& q) {
  const double n = std::hypot(q.x, q.y, q.z), theta = 2 * std::atan2(n, std::fabs(q.w));
  const double s = n > 0 ? (q.w < -1e-7 ? -theta : theta) / n : 2;
  return {s * q.x, s * q.y, s * q.z};
}

inline Matrix matrix(const Vector& phi) {
  const double theta = length(phi), inverse = theta > 0 ? 1 / theta : 0, sine = std::sin(theta / 2);
  const Matrix N = hat({phi[0] * inverse, phi[1] * inverse, phi[2] * inverse});
  return identity + std::sin(theta) * N + 2 * sine * sine * (N * N);
}

inline Jacobian left_jacobian(const Vector& rho, const Vector& phi) {
  // sum_k (-1)^k theta^(2 k) / (2 k + m)!, which is right for every angle if it is summed below 1.
  const double t = length(phi), t2 = t * t;
  const auto series = [&](int m) {
    double term = 1, sum = 0;
    for (int k = 2; k <= m; ++k) term /= k;
    for (int k = 0; k < 12; ++k, term *= -t2 / ((2 * k + m) * (2 * k + m - 1))) sum += term;
    return sum;
  };
  const bool small = t < 1;
  const double a = small ? series(2) : (1 - std::cos(t)) / t2,
               b = small ? series(3) : (t - std::sin(t)) / (t2 * t);
  const double c = small ? series(4) : (0.5 - a) / t2, d = small ? series(5) : (1.0 / 6 - b) / t2;
  const Matrix P = hat(phi), V = hat(rho);
  const Matrix J = identity + a * P + b * (P * P);
  const Matrix PVP = P * V * P;
  return {J, 0.5 * V + b * (P * V + V * P + PVP) + -c * (P * P * V + V * P * P + -3 * PVP) +
                 0.5 * (c - 3 * d) * (PVP * P + P * PVP)};
}

inline Pose inverse(const Pose& X) {
  Pose Y;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) Y.R[i][j] = X.R[j][i];
    Y.p[i] = -(X.R[0][i] * X.p[0] + X.R[1][i] * X.p[1] + X.R[2][i] * X.p[2]);
  }
  return Y;
}

}  // namespace mylib
