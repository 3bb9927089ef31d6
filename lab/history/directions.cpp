// The smallest rotation between two directions, and poses in the plane.

#include <algorithm>
#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

V4 quaternion(const V3& v, double w) {
  return {v[0], v[1], v[2], w};
}
V3 perpendicular(const V3& a) {
  int least = 0;
  a.cwiseAbs().minCoeff(&least);
  return a.cross(V3(V3::Unit(least))).normalized();
}
/// By half angles; the axis is that of a x (b - a), or beyond a right angle of a x (a + b).
V4 minimal(const V3& a, const V3& b) {
  const V3 minus = b - a, plus = a + b;
  V3 n = a.cross(a.dot(b) > 0 ? minus : plus);
  const double size = n.norm();
  if (size > 0) n /= size;
  n -= a.dot(n) * a;
  if (!(n.squaredNorm() > 0.5)) n = perpendicular(a);
  return quaternion(minus.norm() / 2 * n.normalized(), plus.norm() / 2).normalized();
}
bool opposite(const V3& a, const V3& b) {
  return a.dot(b) < -0.999999;
}
V4 about(const V3& axis, double angle) {
  return quaternion(std::sin(angle / 2) * axis, std::cos(angle / 2));
}

// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> rotations_between() {
  const auto row = rows_of(op::rotation_between, minimal);
  return {
      row("nalgebra_316", "nalgebra", "dimforge/nalgebra#316", "nearly equal directions", "NaN",
          "The angle was the acos of a dot product that rounding had carried above 1.",
          [](const V3& a, const V3& b) -> V4 {
            const V3 c = a.cross(b);
            if (c.isZero(0) || opposite(a, b)) return minimal(a, b);
            return a.dot(b) > 1 - 1e-6 ? about(c.normalized(), std::acos(a.dot(b))) : minimal(a, b);
          }),
      row("nalgebra_1262", "nalgebra, 2023-07", "dimforge/nalgebra#1262", "small angles",
          "half of the digits lost",
          "The angle was the acos of the dot product, which is flat where the angle is small.",
          [](const V3& a, const V3& b) -> V4 {
            const V3 c = a.cross(b);
            if (c.isZero(0) || opposite(a, b)) return minimal(a, b);
            return about(c.normalized(), std::acos(std::clamp(a.dot(b), -1., 1.)));
          }),
      row("rowan_3", "rowan, 2018-06", "glotzerlab/rowan#3", "opposite directions", "NaN",
          "The cross product was normalised although it is zero.",
          [](const V3& a, const V3& b) -> V4 {
            const V3 c = a.cross(b);
            return opposite(a, b) ? V4(quaternion(c / c.norm(), 0)) : minimal(a, b);
          }),
      row("joml_82", "JOML, 2016-06", "JOML-CI/JOML#82", "opposite directions", "NaN in all four numbers",
          "The quaternion (a x b, 1 + a . b) was normalised, which is zero for opposite directions.",
          [](const V3& a, const V3& b) -> V4 {
            const V4 q = quaternion(a.cross(b), 1 + a.dot(b));
            return opposite(a, b) ? V4(q / q.norm()) : minimal(a, b);
          }),
      row("godot_80249", "Godot, 2023-08", "godotengine/godot#80249", "opposite directions",
          "a is not turned into b", "The half turn was about the y axis whatever the directions were.",
          [](const V3& a, const V3& b) -> V4 { return opposite(a, b) ? V4(0, 1, 0, 0) : minimal(a, b); }),
      row("shvdn_1734", "ScriptHookVDotNet to 3.6.0", "scripthookvdotnet/scripthookvdotnet#1734", "all",
          "another rotation",
          "The angle about the axis was |a||b| + a . b, which is the w of an unscaled quaternion.",
          [](const V3& a, const V3& b) -> V4 {
            const V3 c = a.cross(b);
            return c.isZero(0) || opposite(a, b) ? minimal(a, b) : about(c.normalized(), 1 + a.dot(b));
          }),
      row("glm_691", "GLM, 2017-10", "g-truc/glm#691", "equal directions", "a zero quaternion",
          "The quaternion of equal directions was one that the default constructor had left zero.",
          [](const V3& a, const V3& b) -> V4 {
            return a.dot(b) >= 1 - 2.2e-16 ? V4(V4::Zero()) : minimal(a, b);
          }),
      row("quaternion_js_13", "Quaternion.js, 2023-03", "rawify/Quaternion.js#13", "opposite directions",
          "the identity",
          "The sum (a x b, 1 + a . b) is zero there, and a zero quaternion was normalised to the identity.",
          [](const V3& a, const V3& b) -> V4 { return opposite(a, b) ? V4(V4::Unit(3)) : minimal(a, b); }),
  };
}

V4 planar_exp(const V3& d) {
  const double t = d[2], half = std::sin(t / 2), a = t == 0 ? 1 : std::sin(t) / t,
               b = t == 0 ? 0 : 2 * half * half / t;
  return {a * d[0] - b * d[1], b * d[0] + a * d[1], std::cos(t), std::sin(t)};
}
V3 log_of(double x, double y, double angle) {
  const double b = angle / 2, a = b == 0 ? 1 : b / std::tan(b);
  return {a * x + b * y, a * y - b * x, angle};
}
V3 planar_log(const V4& q) {
  return log_of(q[0], q[1], std::atan2(q[3], q[2]));
}
V3 planar_difference(const V4& q0, const V4& q1) {
  const double x = q1[0] - q0[0], y = q1[1] - q0[1], c = q0[2], s = q0[3];
  // sin of the difference, from q1 - q0 so that nothing cancels.
  const double dc = q1[2] - c, ds = q1[3] - s;
  return log_of(c * x + s * y, c * y - s * x, std::atan2(c * ds - s * dc, c * q1[2] + s * q1[3]));
}

std::vector<HistoricBug> planar_poses() {
  const auto of_exp = rows_of(op::se2_exp, planar_exp);
  return {
      of_exp("gtsam_2043", "GTSAM before 2025-03", "borglab/gtsam#2043", "theta not small",
             "a stretched trajectory",
             "The default exponential of a planar pose was (rho, theta), without V.",
             [](const V3& d) -> V4 {
               return {d[0], d[1], std::cos(d[2]), std::sin(d[2])};
             }),
      of_exp("kornia_rs_534", "kornia-rs before 2025-11", "kornia/kornia-rs#534", "theta = 0",
             "the translation is lost", "Both coefficients were 0 for theta = 0.",
             [](const V3& d) -> V4 { return d[2] == 0 ? V4(0, 0, 1, 0) : planar_exp(d); }),
      {"liegroups_jl_44", "LieGroups.jl before 2025-07", "JuliaManifolds/LieGroups.jl#44", "theta = 1e-8",
       "Inf, NaN",
       "theta/2 sin(theta)/(1 - cos(theta)) was divided by a difference that is 0 for small angles.",
       forms(
           op::se2_log,
           [](const V4& q) -> V3 {
             const double t = std::atan2(q[3], q[2]), a = t / 2 * std::sin(t) / (1 - std::cos(t)), b = t / 2;
             return {a * q[0] + b * q[1], a * q[1] - b * q[0], t};
           },
           planar_log)},
      {"pinocchio_308", "Pinocchio before 2016-09", "stack-of-tasks/pinocchio#308", "planar joints",
       "q0 + (q1 - q0) != q1",
       "The translation of the difference was R0^T (p1 - p0) without V^-1, which integrate multiplied by V.",
       forms(
           op::se2_difference,
           [](const V4& q0, const V4& q1) -> V3 {
             V3 d = planar_difference(q0, q1);
             const double x = q1[0] - q0[0], y = q1[1] - q0[1];
             d[0] = q0[2] * x + q0[3] * y, d[1] = q0[2] * y - q0[3] * x;
             return d;
           },
           planar_difference)},
  };
}

const HistoryRows direction_rows(rotations_between), planar_rows(planar_poses);

}  // namespace
}  // namespace liecheck::properties::history
