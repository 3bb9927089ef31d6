#pragma once
// Rotations, translations and Jacobians in double, accurate enough to judge results in float: their errors are
// below 1e-5 eps of float for theta <= pi. They evaluate power series in theta^2, where the laws' oracles have
// closed forms.

#include <array>
#include <cmath>
#include <oracles/zeta.hpp>

namespace liecheck::oracles::slice {

using V3 = std::array<double, 3>;
using M3 = std::array<double, 9>;  ///< row by row

/// c_k(x) = sum_j (-x)^j / (2 j + k)!, at x = theta^2 <= pi^2. The truncation error is below 1e-21.
inline double series(int k, double x) {
  double sum = 0;
  for (int j = 15; j >= 0; --j) sum = 1 - sum * x / ((2 * j + k + 1) * (2 * j + k + 2));
  double factorial = 1;
  for (int i = 2; i <= k; ++i) factorial *= i;
  return sum / factorial;
}
/// (1 - (theta/2) cot(theta/2)) / theta^2 = sum_n 2 zeta(2 n) (2 pi)^(-2 n) x^(n - 1) (Euler), at x <= pi^2.
inline double inverse_coefficient(double x) {
  static const std::array<double, 30> a = [] {
    std::array<double, 30> all;
    for (int n = 1; n <= 30; ++n)
      all[std::size_t(n - 1)] = 2 * zeta(2.0 * n) / std::pow(4 * std::atan(1.0) * 2, 2 * n);
    return all;
  }();
  double sum = 0;
  for (auto i = a.rbegin(); i != a.rend(); ++i) sum = sum * x + *i;
  return sum;
}

inline double dot(const V3& a, const V3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline V3 cross(const V3& a, const V3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// a + b phi x + c phi x phi x as a matrix.
inline M3 combination(double a, double b, double c, const V3& p) {
  const double s = a - c * dot(p, p);
  return {s + c * p[0] * p[0],        c * p[0] * p[1] - b * p[2], c * p[0] * p[2] + b * p[1],
          c * p[1] * p[0] + b * p[2], s + c * p[1] * p[1],        c * p[1] * p[2] - b * p[0],
          c * p[2] * p[0] - b * p[1], c * p[2] * p[1] + b * p[0], s + c * p[2] * p[2]};
}
inline M3 rotation(const V3& phi) {
  const double x = dot(phi, phi);
  return combination(1, series(1, x), series(2, x), phi);
}
inline M3 left_jacobian(const V3& phi) {
  const double x = dot(phi, phi);
  return combination(1, series(2, x), series(3, x), phi);
}
inline M3 left_jacobian_inverse(const V3& phi) {
  return combination(1, -0.5, inverse_coefficient(dot(phi, phi)), phi);
}
/// (x, y, z, w) of exp(phi).
inline std::array<double, 4> quaternion(const V3& phi) {
  const double x = dot(phi, phi) / 4, s = series(1, x) / 2;
  return {s * phi[0], s * phi[1], s * phi[2], series(0, x)};
}
/// J_l(phi) rho.
inline V3 translation(const V3& rho, const V3& phi) {
  const double x = dot(phi, phi), c2 = series(2, x), c3 = series(3, x);
  const V3 a = cross(phi, rho), b = cross(phi, a);
  return {rho[0] + c2 * a[0] + c3 * b[0], rho[1] + c2 * a[1] + c3 * b[1], rho[2] + c2 * a[2] + c3 * b[2]};
}
/// The coupling block of the left Jacobian of SE(3), as the derivative of J_l(phi) along rho: with s = phi . rho,
/// C = c2 [rho] + c3 ([phi][rho] + [rho][phi]) + s (c2' [phi] + c3' [phi]^2), c_k' = (k c_k+2 - c_k+1) = d c_k / d(x/2).
inline M3 coupling(const V3& rho, const V3& phi) {
  const double x = dot(phi, phi), s = dot(phi, rho), c2 = series(2, x), c3 = series(3, x);
  // d c_k / dx = (k c_(k+2) - c_(k+1)) / 2 from the series; here times 2, for d(x)/2 = phi . rho.
  const double d2 = 2 * series(4, x) - c3, d3 = 3 * series(5, x) - series(4, x);
  M3 C = combination(0, s * d2, s * d3, phi);
  const M3 R = combination(0, c2, 0, rho);
  // [phi][rho] + [rho][phi] = rho phi^T + phi rho^T - 2 (phi . rho) I
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      C[3 * i + j] += R[3 * i + j] + c3 * (rho[i] * phi[j] + phi[i] * rho[j] - (i == j ? 2 * s : 0));
  return C;
}
/// The rotation vector of Q/|Q|, w >= 0.
inline V3 logarithm(const std::array<double, 4>& Q) {
  const double s = std::hypot(Q[0], Q[1], Q[2]);
  const double scale = s == 0 ? 2 : 2 * std::atan2(s, Q[3]) / s;
  return {scale * Q[0], scale * Q[1], scale * Q[2]};
}

}  // namespace liecheck::oracles::slice
