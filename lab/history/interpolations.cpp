// Slerp, and the angles of a relative rotation and of a twist.

#include <algorithm>
#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

/// Between unit quaternions on one side, by sines of the angle between them as vectors.
V4 by_sines(const V4& a, const V4& b, double t, double half) {
  if (half == 0) return a;
  return ((std::sin((1 - t) * half) * a + std::sin(t * half) * b) / std::sin(half)).normalized();
}
double angle_between(const V4& a, const V4& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}
V4 shorter_arc(const V4& a, const V4& b, const double& t) {
  const V4 to = a.dot(b) < 0 ? V4(-b) : b;
  return by_sines(a, to, t, angle_between(a, to));
}
/// Along the arc between the quaternions as they are, up to a rotation by 2 pi.
V4 arc_as_stored(const V4& a, const V4& b, const double& t) {
  const double half = angle_between(a, b);
  return std::sin(half) < 1e-6 ? shorter_arc(a, b, t) : by_sines(a, b, t, half);
}

// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> interpolations() {
  const auto row = rows_of(op::slerp, shorter_arc);
  return {
      row("threejs_14258", "three.js 0.92, 0.93", "mrdoob/three.js#14258", "angle < 2e-3", "0.5 for t = 0.1",
          "Where the sine of the half angle was below 0.001 the average was returned for every t.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            const V4 to = a.dot(b) < 0 ? V4(-b) : b;
            const double c = a.dot(to);
            return std::sqrt(std::max(0., 1 - c * c)) < 1e-3 ? V4((a + to).normalized())
                                                             : shorter_arc(a, b, t);
          }),
      row("threejs_7430", "three.js r73", "mrdoob/three.js#7430", "near rotations", "the norm is not 1",
          "The half angle was the acos of the dot product, and the sum of both terms was not normalised.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            const V4 to = a.dot(b) < 0 ? V4(-b) : b;
            const double c = a.dot(to);
            if (c >= 1) return a;
            const double half = std::acos(c), sine = std::sqrt(1 - c * c);
            if (sine < 1e-3) return shorter_arc(a, b, t);
            return (std::sin((1 - t) * half) * a + std::sin(t * half) * to) / sine;
          }),
      row("roma_3", "RoMa before 1.3.0", "naver/roma#3", "all", "the long way",
          "The second quaternion was multiplied by minus the sign of the dot product.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            return arc_as_stored(a, a.dot(b) < 0 ? b : V4(-b), t);
          }),
      row("mathgl_90", "mathgl before 2022-12", "go-gl/mathgl#90", "Q0 . Q1 < 0", "the long way",
          "A negative dot product was not turned into the shorter arc.",
          [](const V4& a, const V4& b, const double& t) -> V4 { return arc_as_stored(a, b, t); }),
      row("cgmath_498", "cgmath before 2020-08", "rustgd/cgmath#515", "Q1 near -Q0", "NaN",
          "For opposite quaternions both weights vanish, and their sum was normalised all the same.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            const double c = a.dot(b);
            if (c > -0.9999999) return shorter_arc(a, b, t);
            const double half = std::acos(std::max(-1., c));
            return (std::sin((1 - t) * half) * a + std::sin(t * half) * b).normalized();
          }),
      row("jeod_42", "JEOD to 2026-08", "nasa/jeod#42", "Q0 . Q1 < 0", "no rotation on the arc",
          "Of the second quaternion three numbers were negated and the fourth was not.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            if (!(a.dot(b) < 0)) return shorter_arc(a, b, t);
            const V4 to(-b[0], -b[1], b[2], -b[3]);
            return by_sines(a, to, t, std::acos(std::min(1., -a.dot(b))));
          }),
      row("fastgltf_108", "fastgltf to 2025-05", "spnda/fastgltf#108", "Q0 . Q1 < 0", "the long way",
          "For a negative dot product both quaternions were negated, which changes nothing.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            return a.dot(b) < 0 ? arc_as_stored(-a, -b, t) : shorter_arc(a, b, t);
          }),
      row("filament_3478", "Filament to 2021-01", "google/filament#3478", "Q1 near -Q0", "a jolt",
          "The linear interpolation of near quaternions did not look at the sign of the dot product.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            if (std::abs(a.dot(b)) < 1 - 1e-12) return shorter_arc(a, b, t);
            return ((1 - t) * a + t * b).normalized();
          }),
      row("shvdn_1732", "ScriptHookVDotNet 2.6 to 2026-05", "scripthookvdotnet/scripthookvdotnet#1732",
          "Q0 . Q1 = 0", "the start times a sine",
          "The end was multiplied by the sign of the dot product, and the sign of 0 is 0.",
          [](const V4& a, const V4& b, const double& t) -> V4 {
            if (a.dot(b) != 0) return shorter_arc(a, b, t);
            return std::sin((1 - t) * 1.5707963267948966) * a;
          }),
  };
}

double angle_of_product(const V4& a, const V4& b) {
  const V4 q = H::multiply(H::conjugate(a), b);
  return 2 * std::atan2(q.head<3>().stableNorm(), std::abs(q[3]));
}
double twist(const V4& Q, const V3& axis) {
  const double s = Q.head<3>().dot(axis);
  return Q[3] < 0 ? 2 * std::atan2(-s, -Q[3]) : 2 * std::atan2(s, Q[3]);
}

std::vector<HistoricBug> angles() {
  const auto relative = rows_of(op::relative_angle, angle_of_product);
  const auto of_twist = rows_of(op::twist_angle, twist);
  return {
      relative(
          "geometry2_185", "tf2", "ros/geometry2#185", "Q0 . Q1 < 0", "the angle of the long way",
          "angleShortestPath took the acos of the dot product with its sign.",
          [](const V4& a, const V4& b) -> double { return 2 * std::acos(std::clamp(a.dot(b), -1., 1.)); }),
      relative("gl_matrix_499_angle", "gl-matrix to 3.4.4", "toji/gl-matrix#499", "equal rotations", "NaN",
               "getAngle took the acos of 2 (Q0 . Q1)^2 - 1, which rounding carries above 1.",
               [](const V4& a, const V4& b) -> double { return std::acos(2 * a.dot(b) * a.dot(b) - 1); }),
      of_twist("newton_3434", "Newton before 2026-07", "newton-physics/newton#3434", "small angles",
               "a dead zone: 0", "The angle was 2 acos(w) with the sign of the vector part along the axis.",
               [](const V4& Q, const V3& axis) -> double {
                 const double s = Q.head<3>().dot(axis), angle = 2 * std::acos(std::min(1., std::abs(Q[3])));
                 return (s < 0) == (Q[3] < 0) ? angle : -angle;
               }),
      of_twist("moveit_core_282", "MoveIt before 2016-04", "moveit/moveit_core#282", "negative angles",
               "the opposite angle", "2 acos(w) has no sign, so that the joint turned only one way.",
               [](const V4& Q, const V3& axis) -> double { return std::abs(twist(Q, axis)); }),
  };
}

const HistoryRows slerp_rows(interpolations), angle_rows(angles);

}  // namespace
}  // namespace liecheck::properties::history
