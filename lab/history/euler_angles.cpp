// Euler angles, most of them at gimbal lock. A form takes any of the 24 orders, and the fault of a report is written for
// all to which it applies.

#include <algorithm>
#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

constexpr double pi = 3.141592653589793;

struct Axes {
  int i, j, k;  ///< k is the third axis, also if the sequence is i j i
  bool proper, rotating;
  double sign;  ///< 1 if i j k is cyclic
  explicit Axes(double order) {
    static const char* const all[] = {"012", "021", "102", "120", "201", "210",
                                      "010", "020", "101", "121", "202", "212"};
    const int n = static_cast<int>(order);
    const char* const a = all[n / 2];
    i = a[0] - '0', j = a[1] - '0', k = 3 - i - j, proper = a[0] == a[2], rotating = n % 2 == 1;
    sign = (j - i + 3) % 3 == 1 ? 1 : -1;
  }
};

double wrapped(double x) {
  return x > pi ? x - 2 * pi : x < -pi ? x + 2 * pi : x;
}
/// By the half sum and half difference of the outer angles, which stay accurate at gimbal lock.
V3 by_half_sums(const double& order, const V4& Q) {
  Axes o(order);
  if (o.rotating && !o.proper) std::swap(o.i, o.k), o.sign = -o.sign;
  double x = Q[3], y = Q[o.i], z = Q[o.j], u = o.sign * Q[o.k];
  if (!o.proper)
    x = Q[3] - Q[o.j], y = Q[o.i] + o.sign * Q[o.k], z = Q[o.j] + Q[3], u = o.sign * Q[o.k] - Q[o.i];
  const double plus = std::atan2(y, x), minus = std::atan2(u, z);
  double middle = 2 * std::atan2(std::hypot(z, u), std::hypot(x, y)), last = plus + minus;
  if (!o.proper) last *= o.sign, middle -= pi / 2;
  const double first = wrapped(plus - minus);
  last = wrapped(last);
  return o.rotating ? V3(last, middle, first) : V3(first, middle, last);
}
V3 by_half_sums_of_matrix(const double& order, const M3& R) {
  return by_half_sums(order, quaternion_by_pivot(R));
}
/// M = R_i(a) R_j(b) R_k(c) of static axes too: the matrix is then transposed and the angles change their sign.
M3 as_rotating(const Axes& o, const M3& R) {
  return o.rotating ? R : M3(R.transpose());
}
V3 from_rotating(const Axes& o, const V3& x) {
  return o.rotating ? x : V3(-x);
}
/// The angles of i j k by single entries. `sine` gives the middle angle.
V3 by_entries(const double& order, const M3& R, double (*middle)(double sine)) {
  const Axes o(order);
  const M3 M = as_rotating(o, R);
  return from_rotating(o, {std::atan2(-o.sign * M(o.j, o.k), M(o.k, o.k)), middle(o.sign * M(o.i, o.k)),
                           std::atan2(-o.sign * M(o.i, o.j), M(o.i, o.i))});
}
double clamped_asin(double x) {
  return std::asin(std::clamp(x, -1., 1.));
}
double plain_asin(double x) {
  return std::asin(x);
}
/// The sine of the middle angle of i j k.
double sine_of(const double& order, const M3& R) {
  const Axes o(order);
  return o.sign * as_rotating(o, R)(o.i, o.k);
}
bool at_lock(const double& order, const M3& R) {
  return !Axes(order).proper && std::abs(sine_of(order, R)) > 1 - 1e-10;
}
V4 product_of_turns(const double& order, const V3& x) {
  const Axes o(order);
  const auto turn = [&](int axis, double angle) {
    V4 q = V4::Zero();
    q[axis] = std::sin(angle / 2), q[3] = std::cos(angle / 2);
    return q;
  };
  const V4 a = turn(o.i, x[0]), b = turn(o.j, x[1]), c = turn(o.proper ? o.i : o.k, x[2]);
  return o.rotating ? H::multiply(H::multiply(a, b), c) : H::multiply(H::multiply(c, b), a);
}
M3 matrix_of_angles(const double& order, const V3& x) {
  return matrix_of(product_of_turns(order, x));
}

std::vector<HistoricBug> of_matrices() {
  const auto row = rows_of(op::euler_from_matrix, by_half_sums_of_matrix);
  return {
      row("nalgebra_494", "nalgebra 0.16", "dimforge/nalgebra#494", "pitch near 90 degrees", "NaN",
          "The middle angle was the asin of an entry that rounding had carried above 1.",
          [](const double& order, const M3& R) -> V3 {
            return at_lock(order, R) ? by_entries(order, R, plain_asin) : by_half_sums_of_matrix(order, R);
          }),
      row("geometry2_796", "tf2, 2025", "ros2/geometry2#796", "pitch near 90 degrees", "45 degrees for 0",
          "Near gimbal lock the outer angles were those of entries that consist of rounding errors.",
          [](const double& order, const M3& R) -> V3 {
            return at_lock(order, R) ? by_entries(order, R, clamped_asin) : by_half_sums_of_matrix(order, R);
          }),
      row("geometry2_504", "tf2, 2021-03", "ros/geometry2#504", "pitch = -90 degrees", "a strange roll",
          "At gimbal lock the last angle was set to 0 and the first taken from two entries that are zero "
          "there.",
          [](const double& order, const M3& R) -> V3 {
            if (!at_lock(order, R)) return by_half_sums_of_matrix(order, R);
            V3 x = by_entries(order, R, clamped_asin);
            x[2] = 0;
            return x;
          }),
      row("dm_control_555", "dm_control to 2026-09", "google-deepmind/dm_control#555", "pitch = 90 degrees",
          "a rotation by 180 degrees",
          "At the poles the sine passed to arctan2 had the wrong sign in three orders.",
          [](const double& order, const M3& R) -> V3 {
            const Axes o(order);
            if (!at_lock(order, R)) return by_half_sums_of_matrix(order, R);
            const M3 M = as_rotating(o, R);
            const double up = o.sign * M(o.i, o.k) > 0 ? 1 : -1, fault = o.sign;  // right for cyclic orders
            return from_rotating(o, {fault * up * o.sign * std::atan2(M(o.j, o.i), M(o.j, o.j)),
                                     clamped_asin(o.sign * M(o.i, o.k)), 0});
          }),
      row("nalgebra_1482", "nalgebra, 2025-02", "dimforge/nalgebra#1482", "pitch = -90 degrees",
          "the yaw is inverted",
          "At gimbal lock the remaining angle was multiplied by the sign of the pitch once too often.",
          [](const double& order, const M3& R) -> V3 {
            V3 x = by_half_sums_of_matrix(order, R);
            if (at_lock(order, R) && x[1] < 0) x[0] = -x[0], x[2] = -x[2];
            return x;
          }),
      rows_of(op::euler_to_matrix, matrix_of_angles)(
          "cglm_36", "cglm before 2018-03", "recp/cglm#36", "all", "another order",
          "The rotations about the body's axes were multiplied in the order of static axes.",
          [](const double& order, const V3& x) -> M3 {
            return matrix_of_angles(std::fmod(order, 2) > 0 ? order - 1 : order + 1, x);
          }),
  };
}

std::vector<HistoricBug> of_quaternions() {
  const auto row = rows_of(op::euler_from_quaternion, by_half_sums);
  return {
      row("kornia_3950", "kornia to 2026-08", "kornia/kornia#3950", "pitch = 90 degrees", "another rotation",
          "There was no branch for gimbal lock, so that roll and yaw were atan2 of two rounding errors.",
          [](const double& order, const V4& Q) -> V3 {
            return Axes(order).proper ? by_half_sums(order, Q)
                                      : by_entries(order, matrix_of(Q), clamped_asin);
          }),
      row("glm_461", "GLM, 2015-12", "g-truc/glm#461", "pitch near 90 degrees", "NaN",
          "The middle angle was the asin of -2 (x z - w y), which rounding carries above 1.",
          [](const double& order, const V4& Q) -> V3 {
            V3 x = by_half_sums(order, Q);
            const Axes o(order);
            if (o.proper) return x;
            const double first = o.rotating ? 1 : -1,
                         sine = 2 * (Q[o.j] * Q[3] + first * o.sign * Q[o.i] * Q[o.k]);
            if (std::abs(sine) > 1) x[1] = std::asin(sine);
            return x;
          }),
      row("moble_127", "quaternion 2019.9.30", "moble/quaternion#127", "beta = pi",
          "alpha and gamma are lost",
          "Where the middle angle of z y z is pi, both other angles were returned as 0.",
          [](const double& order, const V4& Q) -> V3 {
            V3 x = by_half_sums(order, Q);
            if (Axes(order).proper && pi - x[1] < 1e-6) x[0] = x[2] = 0;
            return x;
          }),
  };
}

const HistoryRows matrix_rows(of_matrices), quaternion_rows(of_quaternions);

}  // namespace
}  // namespace liecheck::properties::history
