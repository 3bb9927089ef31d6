// Axis and angle of a rotation, modified Rodrigues parameters, and nearest rotations.

#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

V4 pair_of(const V4& Q) {
  const double n = Q.head<3>().stableNorm(), sign = Q[3] < 0 ? -1 : 1;
  return n == 0 ? V4(1, 0, 0, 0) : joined(V3(sign / n * Q.head<3>()), 2 * std::atan2(n, std::abs(Q[3])));
}
std::vector<HistoricBug> pairs_of_quaternions() {
  const auto row = rows_of(op::axis_angle_from_quaternion, pair_of);
  return {
      row("pysic_22", "pysic", "thynnine/pysic#22", "all", "an axis that is not of length 1",
          "The axis was divided by the sine of the whole angle.",
          [](const V4& Q) -> V4 {
            V4 a = pair_of(Q);
            const double s = std::sin(a[3]);
            if (s != 0) a.head<3>() *= std::sin(a[3] / 2) / s;
            return a;
          }),
      row("sympy_24925", "SymPy", "sympy/sympy#24925", "all", "half of the angle",
          "The angle was atan2(|v|, w), without the factor 2.",
          [](const V4& Q) -> V4 {
            V4 a = pair_of(Q);
            a[3] /= 2;
            return a;
          }),
      row("cesium_11665", "Cesium", "CesiumGS/cesium#11665", "w = -1", "NaN",
          "Only w near 1 was excluded from a division by sqrt(1 - w^2).",
          [](const V4& Q) -> V4 {
            if (std::abs(Q[3] - 1) < 1e-6) return pair_of(Q);
            return joined(V3(Q.head<3>() / std::sqrt(1 - Q[3] * Q[3])), 2 * std::acos(Q[3]));
          }),
      row("joml_202", "JOML 1.9.19", "JOML-CI/JOML#202", "small angles", "NaN",
          "The axis was divided by sqrt(1 - w^2), which is 0 where w rounds to 1.",
          [](const V4& Q) -> V4 {
            const double w = std::abs(Q[3]);
            V4 a = pair_of(Q);
            if (!Q.head<3>().isZero(0)) a.head<3>() = V3(Q.head<3>() / std::sqrt(1 - w * w));
            if (Q[3] < 0) a.head<3>() *= -1;
            return a;
          }),
      row("joml_203", "JOML", "JOML-CI/JOML#203", "near the identity", "NaN",
          "The angle was 2 acos(w), and rounding carries w above 1.",
          [](const V4& Q) -> V4 {
            V4 a = pair_of(Q);
            a[3] = 2 * std::acos(std::abs(Q[3]));
            return a;
          }),
      row("odin_1644", "Odin", "odin-lang/Odin#1644", "all", "another angle", "The angle was 2 acos(x).",
          [](const V4& Q) -> V4 {
            V4 a = pair_of(Q);
            a[3] = 2 * std::acos(std::clamp(Q[0], -1., 1.));
            return a;
          }),
      row("ostk_81", "open-space-toolkit-mathematics",
          "open-space-collective/open-space-toolkit-mathematics#81", "w < 0", "the inverse rotation",
          "The angle was 2 acos(|w|) and the axis was not turned.",
          [](const V4& Q) -> V4 {
            V4 a = pair_of(Q);
            if (Q[3] < 0) a.head<3>() *= -1;
            return a;
          }),
      row("webots_7009", "Webots", "cyberbotics/webots#7009", "Q = (0, 0, 0, -1)", "NaN",
          "2 acos(-1) is no zero, so that the axis 0/0 was taken.",
          [](const V4& Q) -> V4 {
            const double angle = 2 * std::acos(std::clamp(Q[3], -1., 1.));
            return angle < 1e-6 || Q[3] > -0.999999 ? pair_of(Q)
                                                    : joined(V3(Q.head<3>() / Q.head<3>().norm()), angle);
          }),
      row("kornia_84", "kornia 0.1.1", "kornia/kornia#84", "identity", "NaN",
          "The factor 2 theta/|v| was computed and then masked by a multiplication.",
          [](const V4& Q) -> V4 {
            const double n = Q.head<3>().norm(), sign = Q[3] < 0 ? -1 : 1;
            return joined(V3(sign / n * Q.head<3>()), 2 * std::atan2(n, std::abs(Q[3])));
          }),
      row("geometry_6", "tf", "ros/geometry#6", "w < 0", "the angle of the long way, about the short axis",
          "The sign was that of Q . Q, which is never negative.",
          [](const V4& Q) -> V4 {
            V4 a = pair_of(Q);
            if (Q[3] < 0) a[3] = 2 * std::acos(std::clamp(Q[3], -1., 1.));
            return a;
          }),
  };
}
V4 pair_of_matrix(const M3& R) {
  return pair_of(by_pivot(R));
}
std::vector<HistoricBug> pairs_of_matrices() {
  const auto row = rows_of(op::axis_angle_from_matrix, pair_of_matrix);
  return {
      row("glm_1058", "GLM", "g-truc/glm#1058", "identity", "pi/4",
          "The value of acos(1) was written as pi/4.",
          [](const M3& R) -> V4 {
            V4 a = pair_of_matrix(R);
            if (std::abs((R.trace() - 1) / 2 - 1) < 1e-7) a[3] = 0.7853981633974483;
            return a;
          }),
      row("nalgebra_1382", "nalgebra", "dimforge/nalgebra#1382", "theta = pi", "no axis",
          "The axis was that of the antisymmetric part, which is zero at pi.",
          [](const M3& R) -> V4 {
            const V3 d = differences(R);
            if (d.norm() < 1e-15) return {1, 0, 0, clamped_angle(R)};
            return joined(d.normalized(), std::atan2(d.norm() / 2, (R.trace() - 1) / 2));
          }),
      row("spacevecalg_42", "SpaceVecAlg", "jrl-umi3218/SpaceVecAlg#42", "near pi", "2.5e6 for pi",
          "A vanishing antisymmetric part was multiplied by theta/sin(theta).",
          [](const M3& R) -> V4 {
            const double theta = clamped_angle(R);
            const V3 phi = theta < 1e-6 ? skew_part(R) : V3(theta / std::sin(theta) * skew_part(R));
            const double n = phi.norm();
            return n == 0 ? V4(1, 0, 0, 0) : joined(V3(phi / n), n);
          }),
      row("basilisk_a53bde1", "Basilisk", "commit a53bde1 of AVSLab/basilisk", "identity and pi", "NaN",
          "The book's formula with acos and sin had no branch at its ends.",
          [](const M3& R) -> V4 {
            const double theta = clamped_angle(R);
            return joined(V3(skew_part(R) / std::sin(theta)), theta);
          }),
  };
}
V4 of_pair(const V3& axis, const double& angle) {
  return joined(V3(std::sin(angle / 2) * axis), std::cos(angle / 2));
}
M3 matrix_of_pair(const V3& a, const double& angle) {
  const double half = std::sin(angle / 2);
  return M3::Identity() + std::sin(angle) * hat<double>(a) +
         2 * half * half * hat<double>(a) * hat<double>(a);
}
std::vector<HistoricBug> from_pairs() {
  const auto row = rows_of(op::quaternion_from_axis_angle, of_pair);
  const auto matrix = rows_of(op::matrix_from_axis_angle, matrix_of_pair);
  return {
      row("cgmath_33", "cgmath, 2014", "rustgd/cgmath#33", "all", "a norm that is not 1",
          "The sine was that of the whole angle.",
          [](const V3& a, const double& t) -> V4 { return joined(V3(std::sin(t) * a), std::cos(t / 2)); }),
      row("rajawali_283", "Rajawali", "Rajawali/Rajawali#283", "all", "a small turn",
          "Radians were passed to a function that takes degrees.",
          [](const V3& a, const double& t) -> V4 { return of_pair(a, t * 0.017453292519943295); }),
      matrix("sparky_42", "Sparky", "TheCherno/Sparky#42", "axes not along a coordinate", "no rotation",
             "The diagonal was x (1 - cos) + cos, with x in place of x^2.",
             [](const V3& a, const double& t) -> M3 {
               M3 R = matrix_of_pair(a, t);
               for (int i = 0; i < 3; ++i) R(i, i) = a[i] * (1 - std::cos(t)) + std::cos(t);
               return R;
             }),
      matrix("essentialmath_57", "essentialmath", "jvanverth/essentialmath#57", "z (x - y) != 0",
             "no rotation", "The product y z was a copy of x z.",
             [](const V3& a, const double& t) -> M3 {
               M3 R = matrix_of_pair(a, t);
               const double d = (1 - std::cos(t)) * a[2] * (a[0] - a[1]);
               R(1, 2) += d, R(2, 1) += d;
               return R;
             }),
      matrix("dead_reckoning_3", "IMU-Dead-Reckoning", "Abekabe/IMU-Dead-Reckoning#3", "all", "no rotation",
             "The square of the skew matrix was subtracted.",
             [](const V3& a, const double& t) -> M3 {
               return M3::Identity() + std::sin(t) * hat<double>(a) -
                      (1 - std::cos(t)) * hat<double>(a) * hat<double>(a);
             }),
      matrix("linmath_39", "linmath.h", "datenwolf/linmath.h#39", "about y", "the inverse rotation",
             "Both sines of a rotation about y had the wrong sign.",
             [](const V3& a, const double& t) -> M3 {
               return matrix_of_pair(a, std::abs(a[1]) > 1 - 1e-15 ? -t : t);
             }),
  };
}

V3 short_parameters(const V4& Q) {
  const double n = Q.norm();
  return Q.head<3>() / (Q[3] < 0 ? Q[3] - n : Q[3] + n);
}
M3 polar(const M3& A) {
  M3 X = A;
  for (int i = 0; i < 12; ++i) X = (X + X.inverse().transpose()) / 2;
  return X;
}
std::vector<HistoricBug> parameters_and_nearest() {
  const auto nearest = rows_of(op::nearest_rotation, polar);
  return {
      {"basilisk_dbe604b", "Basilisk before 2020-05", "commit dbe604b of AVSLab/basilisk", "w near -1",
       "a division by zero", "The parameters v/(1 + w) were not switched to their shadow for w < 0.",
       forms(
           op::mrp_from_quaternion, [](const V4& Q) -> V3 { return Q.head<3>() / (1 + Q[3]); },
           short_parameters)},
      {"rotations_jl_152", "Rotations.jl", "JuliaGeometry/Rotations.jl#152", "all", "another rotation",
       "A norm stood where the square of the norm belongs.",
       forms(
           op::quaternion_from_mrp,
           [](const V3& s) -> V4 {
             const double n = s.norm();
             return V4(2 * s[0], 2 * s[1], 2 * s[2], 1 - n) / (1 + n);
           },
           [](const V3& s) -> V4 {
             return V4(2 * s[0], 2 * s[1], 2 * s[2], 1 - s.squaredNorm()) / (1 + s.squaredNorm());
           })},
      nearest("scipy_22417", "SciPy before 1.16", "scipy/scipy#22417", "far from orthogonal",
              "another rotation", "The quaternion of one pivot was normalised, which is not the nearest.",
              [](const M3& A) -> M3 { return matrix_of(by_pivot(A)); }),
      nearest("liegroups_e60ad53", "liegroups", "commit e60ad53 of utiasSTARS/liegroups", "all",
              "another rotation", "The second factor of the decomposition was transposed once too often.",
              [](const M3& A) -> M3 {
                const M3 R = polar(A);
                return R * R;
              }),
      {"linmath_32", "linmath.h", "datenwolf/linmath.h#32", "far from orthogonal",
       "two columns are not orthogonal", "The third column was not projected; the second was twice.",
       forms(
           op::gram_schmidt,
           [](const M3& A) -> M3 {
             M3 R = A;
             R.col(0).normalize();
             for (int i = 0; i < 2; ++i) R.col(1) -= R.col(0).dot(R.col(1)) * R.col(0);
             R.col(1).normalize();
             R.col(2) = (A.col(2) - R.col(1).dot(A.col(2)) * R.col(1)).normalized();
             return R;
           },
           [](const M3& A) -> M3 {
             M3 R = A;
             R.col(0).normalize();
             R.col(1) = (A.col(1) - R.col(0).dot(A.col(1)) * R.col(0)).normalized();
             R.col(2) = R.col(0).cross(R.col(1));
             return R;
           })},
  };
}

const HistoryRows of_quaternion_pairs(pairs_of_quaternions), of_matrix_pairs(pairs_of_matrices),
    of_pairs(from_pairs), of_parameters(parameters_and_nearest);

}  // namespace
}  // namespace liecheck::properties::history
