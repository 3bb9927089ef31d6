#pragma once
// mylib has three faults: a cutoff for small angles, the sign of the logarithm near pi, and NaN for
// subnormals. Its inverse is right.
#include <cmath>
#include <liecheck_adapter.hpp>
#include <limits>

struct MyLib {
  static constexpr const char *name = "mylib", *version = "1.0";
  static void exp3_quaternion(std::span<const double, 3> phi, std::span<double, 4> Q) {
    const double theta = std::hypot(phi[0], phi[1], phi[2]);
    double s = theta < 1e-3 ? 0.5 : std::sin(theta / 2) / theta;  // cutoff: the error is theta^2 / 24
    if (theta > 0 && theta < std::numeric_limits<double>::min()) s = 0.0 / 0.0;
    for (int i = 0; i < 3; ++i) Q[i] = s * phi[i];
    Q[3] = std::cos(theta / 2);
  }
  static void log3_quaternion(std::span<const double, 4> Q, std::span<double, 3> phi) {
    const double n = std::hypot(Q[0], Q[1], Q[2]), w = Q[3];
    const double theta = 2 * std::atan2(n, std::fabs(w));
    const double sign = w < -1e-7 ? -1 : 1;  // near pi, w < 0 is forgotten
    for (int i = 0; i < 3; ++i) phi[i] = n > 0 ? sign * theta / n * Q[i] : 2 * Q[i];
  }
  static void inverse(std::span<const double, 12> X, std::span<double, 12> Y) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) Y[3 * i + j] = X[3 * j + i];
      Y[9 + i] = -(X[i] * X[9] + X[3 + i] * X[10] + X[6 + i] * X[11]);
    }
  }
};
