#pragma once
// Forms without a threshold, an acos or a cancellation, which the findings of the league propose. Each function is a
// program of its own: the adapter `repaired` gives its text, from its name in a comment to the next empty line.

#include <algorithm>
#include <cmath>
#include <limits>

// exp3_quaternion
template <class S>
void exp3_quaternion(const S* phi, S* Q) {
  const S theta = std::hypot(phi[0], phi[1], phi[2]);
  const S s = theta > 0 ? std::sin(theta / 2) / theta : S(1) / 2;
  for (int i = 0; i < 3; ++i) Q[i] = s * phi[i];
  Q[3] = std::cos(theta / 2);
}

// exp3_matrix
template <class S>
void exp3_matrix(const S* phi, S* R) {
  const S x = phi[0], y = phi[1], z = phi[2], theta = std::hypot(x, y, z);
  const S h = theta > 0 ? std::sin(theta / 2) / theta : S(1) / 2;
  const S a = theta > 0 ? std::sin(theta) / theta : S(1), b = 2 * h * h;  // never 1 - cos(theta)
  R[0] = 1 - b * (y * y + z * z), R[1] = b * x * y - a * z, R[2] = b * x * z + a * y;
  R[3] = b * x * y + a * z, R[4] = 1 - b * (x * x + z * z), R[5] = b * y * z - a * x;
  R[6] = b * x * z - a * y, R[7] = b * y * z + a * x, R[8] = 1 - b * (x * x + y * y);
}

// log3_quaternion
template <class S>
void log3_quaternion(const S* Q, S* phi) {
  const S n = std::hypot(Q[0], Q[1], Q[2]);
  const S k = n > 0 ? 2 * std::atan2(std::copysign(n, Q[3]), std::abs(Q[3])) / n : S(0);
  for (int i = 0; i < 3; ++i) phi[i] = k * Q[i];
}

// log3_matrix
template <class S>
void log3_matrix(const S* R, S* phi) {
  const S d[] = {R[0] + R[4] + R[8], R[0], R[4], R[8]};
  const int i = int(std::max_element(d, d + 4) - d) - 1, j = (i + 1) % 3, k = (i + 2) % 3;
  S Q[4] = {R[7] - R[5], R[2] - R[6], R[3] - R[1], 1 + d[0]};
  if (i >= 0) {  // the largest pivot
    Q[3] = R[3 * k + j] - R[3 * j + k], Q[i] = 1 + R[4 * i] - R[4 * j] - R[4 * k];
    Q[j] = R[3 * i + j] + R[3 * j + i], Q[k] = R[3 * i + k] + R[3 * k + i];
  }
  const S n = std::hypot(Q[0], Q[1], Q[2]);
  const S f = n > 0 ? 2 * std::atan2(std::copysign(n, Q[3]), std::abs(Q[3])) / n : S(0);
  for (int l = 0; l < 3; ++l) phi[l] = f * Q[l];
}

// normalize
template <class S>
void normalize(const S* Q, S* y) {
  const S m = std::max({std::abs(Q[0]), std::abs(Q[1]), std::abs(Q[2]), std::abs(Q[3])});
  const S q[] = {Q[0] / m, Q[1] / m, Q[2] / m, Q[3] / m};
  const S n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; ++i) y[i] = q[i] / n;
}

// log3_any_norm
template <class S>
void log3_any_norm(const S* Q, S* phi) {
  const S m = std::max({std::abs(Q[0]), std::abs(Q[1]), std::abs(Q[2]), std::abs(Q[3])});
  const S n = std::hypot(Q[0] / m, Q[1] / m, Q[2] / m), w = Q[3] / m;
  const S k = n > 0 ? 2 * std::atan2(std::copysign(n, w), std::abs(w)) / n : S(0);
  for (int i = 0; i < 3; ++i) phi[i] = k * (Q[i] / m);
}

// matrix_from_quaternion_any_norm
template <class S>
void matrix_from_quaternion_any_norm(const S* Q, S* R) {
  const S m = std::max({std::abs(Q[0]), std::abs(Q[1]), std::abs(Q[2]), std::abs(Q[3])});
  const S x = Q[0] / m, y = Q[1] / m, z = Q[2] / m, w = Q[3] / m, s = 2 / (x * x + y * y + z * z + w * w);
  R[0] = 1 - s * (y * y + z * z), R[1] = s * (x * y - w * z), R[2] = s * (x * z + w * y);
  R[3] = s * (x * y + w * z), R[4] = 1 - s * (x * x + z * z), R[5] = s * (y * z - w * x);
  R[6] = s * (x * z - w * y), R[7] = s * (y * z + w * x), R[8] = 1 - s * (x * x + y * y);
}

// relative_angle
template <class S>
void relative_angle(const S* Q, S* angle) {
  const S *a = Q, *b = Q + 4;
  const S w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const S x = a[3] * b[0] - b[3] * a[0] - (a[1] * b[2] - a[2] * b[1]);
  const S y = a[3] * b[1] - b[3] * a[1] - (a[2] * b[0] - a[0] * b[2]);
  const S z = a[3] * b[2] - b[3] * a[2] - (a[0] * b[1] - a[1] * b[0]);
  *angle = 2 * std::atan2(std::hypot(x, y, z), std::abs(w));  // never acos(w)
}

// slerp
template <class S>
void slerp(const S* x, S* Q) {
  S c = 0, d = 0, e = 0, n = 0;
  for (int i = 0; i < 4; ++i) c += x[i] * x[4 + i];
  const S sign = c < 0 ? -1 : 1, t = x[8];
  for (int i = 0; i < 4; ++i)
    d = std::hypot(d, sign * x[4 + i] - x[i]), e = std::hypot(e, sign * x[4 + i] + x[i]);
  const S h = 2 * std::atan2(d, e), a = h > 0 ? std::sin((1 - t) * h) : 1, b = h > 0 ? std::sin(t * h) : 0;
  for (int i = 0; i < 4; ++i) Q[i] = a * x[i] + sign * b * x[4 + i], n = std::hypot(n, Q[i]);
  for (int i = 0; i < 4; ++i) Q[i] /= n;  // which is sin(h), without a threshold on h
}

// rotation_between
template <class S>
void rotation_between(const S* x, S* Q) {
  const S l = std::hypot(x[0], x[1], x[2]), m = std::hypot(x[3], x[4], x[5]);
  const S a[] = {x[0] / l, x[1] / l, x[2] / l}, c[] = {a[0] + x[3] / m, a[1] + x[4] / m, a[2] + x[5] / m};
  const S n = std::hypot(c[0], c[1], c[2]);
  if (n >
      4 * std::numeric_limits<S>::epsilon()) {  // a x (a + b), which is a x b, keeps its digits near b = -a
    Q[0] = (a[1] * c[2] - a[2] * c[1]) / n, Q[1] = (a[2] * c[0] - a[0] * c[2]) / n;
    Q[2] = (a[0] * c[1] - a[1] * c[0]) / n, Q[3] = n / 2;
  } else if (std::abs(a[0]) > std::abs(a[2])) {  // b = -a but for rounding: any axis perpendicular to a
    Q[0] = -a[1], Q[1] = a[0], Q[2] = 0, Q[3] = 0;
  } else {
    Q[0] = 0, Q[1] = -a[2], Q[2] = a[1], Q[3] = 0;
  }
  const S q = std::hypot(std::hypot(Q[0], Q[1]), std::hypot(Q[2], Q[3]));
  for (int i = 0; i < 4; ++i) Q[i] /= q;
}
