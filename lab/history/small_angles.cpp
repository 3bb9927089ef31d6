// Exponentials and logarithms near theta = 0.

#include <algorithm>
#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

/// The logarithm of a matrix as angle times the normalised skew part: `angle` is the bug.
V3 along_skew_part(const M3& R, double angle) {
  const V3 a = skew_part(R);
  return a.isZero(0) ? V3::Zero() : V3(angle / a.stableNorm() * a);
}
/// The logarithm of a quaternion as angle times axis.
V3 along_vector_part(const V4& Q, double angle) {
  const V3 v = Q.head<3>();
  return v.isZero(0) ? V3::Zero() : V3(angle / v.stableNorm() * v);
}
bool near_half_turn(const M3& R) {
  return R.trace() < 0;
}
/// 2 sin(theta/2) / theta, which must not be 0/0.
double sine_ratio(double t) {
  return t < 1e-3 ? 1 - t * t / 24 * (1 - t * t / 80) : 2 * std::sin(t / 2) / t;
}
V4 half_angle_quaternion(const V3& phi, double ratio) {
  V4 Q;
  Q << ratio / 2 * phi, std::cos(phi.norm() / 2);
  return Q;
}

// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> exponentials() {
  return {
      {"sophus_186", "Sophus", "strasdat/Sophus#186", "theta < 1e-10", "translation off by theta/2 relative",
       "The matrix V of the translation was replaced by R below the cutoff of the rotation.",
       forms(
           op::exp6,
           [](const V6& xi) -> P {
             const P T = H::good()[op::exp6](xi);
             return H::low(xi).stableNorm() < 1e-10 ? P{T.R, T.R * H::top(xi)} : T;
           },
           [](const V6& xi) -> P {
             const P T = H::good()[op::exp6](xi);
             const V3 rho = H::top(xi), phi = H::low(xi);
             return phi.stableNorm() < 1e-10 ? P{T.R, rho + phi.cross(rho) / 2} : T;
           })},
      {"sophus_108", "Sophus before c1a0ba18", "strasdat/Sophus#108", "theta < 1e-10",
       "4e-21, which no double shows",
       "The series of cos(theta/2) had 1/2 instead of 1/8 before theta^2, in a branch where theta^2 < 1e-20.",
       forms(
           op::exp3_quaternion,
           [](const V3& phi) -> V4 {
             const double t = phi.stableNorm();
             V4 Q = H::good()[op::exp3_quaternion](phi);
             if (t < 1e-10) Q << (0.5 - t * t / 48) * phi, 1 - t * t / 2;
             return Q;
           },
           [](const V3& phi) -> V4 {
             const double t = phi.stableNorm();
             V4 Q = H::good()[op::exp3_quaternion](phi);
             if (t < 1e-10) Q << (0.5 - t * t / 48) * phi, 1 - t * t / 8;
             return Q;
           }),
       HistoryKind::control},
      {"g2o_221", "g2o before df9ac4e0", "RainerKuemmerle/g2o#221", "theta < 1e-5",
       "translation off by theta/2 relative",
       "Below the cutoff R was I + [phi] + [phi]^2 without the factor 1/2, and V was R.",
       forms(
           op::exp6,
           [](const V6& xi) -> P {
             const M3 K = hat(H::low(xi)), R = M3::Identity() + K + K * K;
             return H::low(xi).stableNorm() < 1e-5 ? P{R, R * H::top(xi)} : H::good()[op::exp6](xi);
           },
           [](const V6& xi) -> P {
             const V3 rho = H::top(xi), u = H::low(xi).cross(rho);
             const M3 K = hat(H::low(xi));
             if (H::low(xi).stableNorm() >= 1e-5) return H::good()[op::exp6](xi);
             return {M3::Identity() + K + K * K / 2, rho + (u / 2 + H::low(xi).cross(u) / 6)};
           })},
      {"geometry_13", "tomstewart89/Geometry", "tomstewart89/Geometry#13", "theta < 1e-5",
       "angle 16 % too small", "Below the cutoff theta was set to 1 and then used in sin(theta) [phi/theta].",
       forms(
           op::exp3_matrix,
           [](const V3& phi) -> M3 {
             const M3 K = hat(phi);
             if (phi.stableNorm() >= 1e-5) return H::good()[op::exp3_matrix](phi);
             return M3::Identity() + std::sin(1.0) * K + (1 - std::cos(1.0)) * K * K;
           },
           [](const V3& phi) -> M3 {
             const M3 K = hat(phi);
             return phi.stableNorm() < 1e-5 ? M3(M3::Identity() + K + K * K / 2)
                                            : H::good()[op::exp3_matrix](phi);
           })},
      {"scipy_25725", "SciPy", "scipy/scipy#25725", "theta = 0, theta^2 underflows", "0/0",
       "The series of sin(theta/2)/theta was dropped for speed, so that the quotient is 0/0.",
       forms(
           op::exp3_quaternion,
           [](const V3& phi) -> V4 {
             const double t = phi.norm();
             if (t > 3) return H::good()[op::exp3_quaternion](phi);
             return half_angle_quaternion(phi, 2 * std::sin(t / 2) / t);
           },
           [](const V3& phi) -> V4 {
             const double t = phi.norm();
             if (t > 3) return H::good()[op::exp3_quaternion](phi);
             return half_angle_quaternion(phi, sine_ratio(t));
           })},
      {"idyntree_561_exp", "iDynTree", "gbionics/idyntree#561", "theta > 0",
       "translation rho instead of V rho", "The exponential left the linear part of the twist unchanged.",
       forms(
           op::exp6,
           [](const V6& xi) -> P {
             return {H::good()[op::exp3_matrix](H::low(xi)), H::top(xi)};
           },
           [](const V6& xi) -> P {
             const V3 rho = H::top(xi), phi = H::low(xi);
             const double t = phi.norm(), x = t * t, s = sine_ratio(t);
             if (!(t < 3)) return H::good()[op::exp6](xi);
             const double c3 =
                 t < 1 ? 1 / 6. -
                             x / 120 *
                                 (1 - x / 42 * (1 - x / 72 * (1 - x / 110 * (1 - x / 156 * (1 - x / 210)))))
                       : (t - std::sin(t)) / (t * x);
             const V3 u = phi.cross(rho);
             return {H::good()[op::exp3_matrix](phi), rho + (s * s / 2 * u + c3 * phi.cross(u))};
           })},
      {"rebvo_11", "REBVO", "JuanTarrio/rebvo#11", "theta > 0", "translation rho instead of V rho",
       "The reporter found that the linear part of the increment is added as the translation.",
       forms(
           op::integrate,
           [](const V7& q, const V6& d) -> V7 {
             V7 r = H::good()[op::integrate](q, d);
             r.head<3>() = q.head<3>() + H::good()[op::rotate_point](H::rotation_of(q), H::top(d));
             return r;
           },
           [](const V7& q, const V6& d) -> V7 {
             V7 r = H::good()[op::integrate](q, d);
             r.head<3>() =
                 q.head<3>() + H::good()[op::rotate_point](H::rotation_of(q), H::good()[op::exp6](d).p);
             return r;
           })},
  };
}

/// Rows in which only the angle of a logarithm was wrong. The repaired angle is 2 atan2 of a pivot's quaternion.
// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> logarithms_of_matrices() {
  const auto row = rows_of(op::log3_matrix, log_by_pivot);
  return {
      {"gtsam_746", "GTSAM before f47d7737f", "borglab/gtsam#746", "3 - tr R < 1e-7", "8 digits lost",
       "The series of theta/(2 sin theta) in tr R - 3 squared its first-order term.",
       forms(
           op::log3_matrix,
           [](const M3& R) -> V3 {
             const double x = R.trace() - 3;
             return x > -1e-7 ? V3(2 * (0.5 - x * x / 12) * skew_part(R)) : H::good()[op::log3_matrix](R);
           },
           [](const M3& R) -> V3 {
             const double x = R.trace() - 3;
             return x > -1e-7 ? V3(2 * (0.5 - x / 12) * skew_part(R)) : H::good()[op::log3_matrix](R);
           })},
      row("pinocchio_1405_near_0", "Pinocchio before 46f650870", "stack-of-tasks/pinocchio#1405",
          "theta < 1e-8", "0 instead of theta", "The angle was set to 0 wherever the trace rounds to 3.",
          [](const M3& R) -> V3 {
            if (near_half_turn(R)) return H::good()[op::log3_matrix](R);
            return along_skew_part(R, R.trace() >= 3                    ? 0
                                      : skew_part(R).stableNorm() < 0.9 ? std::asin(skew_part(R).stableNorm())
                                                                        : log_by_pivot(R).norm());
          }),
      row("kdl_352", "KDL 1.5.1", "orocos/orocos_kinematics_dynamics#352", "theta <= 1e-6",
          "0 instead of theta", "GetRot returned zero for every angle up to its tolerance of 1e-6.",
          [](const M3& R) -> V3 {
            return R.trace() > 0 && skew_part(R).stableNorm() <= 1e-6 ? V3::Zero()
                                                                      : H::good()[op::log3_matrix](R);
          }),
      row("kdl_pr_smart_robotics", "KDL before 865f53f",
          "commit 865f53f of orocos/orocos_kinematics_dynamics", "R slightly not orthogonal", "NaN",
          "acos((tr R - 1)/2) was taken without clamping its argument.",
          [](const M3& R) -> V3 {
            return near_half_turn(R) ? H::good()[op::log3_matrix](R)
                                     : along_skew_part(R, std::acos((R.trace() - 1) / 2));
          }),
      row("evo_216", "evo before PR 231", "MichaelGrupp/evo#216", "theta < 1e-4", "unstable angle",
          "The angle was acos((tr R - 1)/2), clamped to [-1, 1], which cancels near 0.",
          [](const M3& R) -> V3 {
            return near_half_turn(R) ? H::good()[op::log3_matrix](R) : along_skew_part(R, clamped_angle(R));
          }),
      row("ssik_199", "ssik", "personalrobotics/ssik#199", "theta < 3e-8", "0 instead of theta",
          "An angle by acos of the trace that is below 1e-9 was taken for zero, which hides angles below "
          "3e-8.",
          [](const M3& R) -> V3 {
            return clamped_angle(R) < 1e-9 ? V3::Zero() : H::good()[op::log3_matrix](R);
          }),
      row("glm_638", "GLM before 0.9.9", "g-truc/glm#638", "tr R near and above 3", "NaN",
          "axisAngle took acos of a cosine above 1, while the axis came out right.",
          [](const M3& R) -> V3 {
            const V3 right = H::good()[op::log3_matrix](R);
            const double c = (R.trace() - 1) / 2;
            return near_half_turn(R) ? right : V3(std::acos(c) * right.stableNormalized());
          }),
      row("pytransform3d_43", "pytransform3d", "dfki-ric/pytransform3d#43", "near 0 and near pi",
          "half of the digits lost",
          "The angle came from arccos on its whole range, with the axis from the skew part.",
          [](const M3& R) -> V3 {
            const V3 right = H::good()[op::log3_matrix](R);
            return right.isZero(0) ? right : V3(clamped_angle(R) * right.stableNormalized());
          }),
      row("scikit_kinematics_13", "scikit-kinematics", "thomas-haslwanter/scikit-kinematics#13",
          "near 0 and axes", "NaN",
          "A component of the quaternion was the root of 1 - R11 - R22 + R33, which may be negative.",
          [](const M3& R) -> V3 {
            V4 Q = quaternion_by_pivot(R);
            for (int k = 0; k < 3; ++k)
              Q[k] = std::copysign(std::sqrt(1 + 2 * R(k, k) - R.trace()) / 2, skew_part(R)[k]);
            Q[3] = std::sqrt(1 + R.trace()) / 2;
            return log_by_atan2(Q);
          }),
      row("linalg_8", "linalg", "sgorsten/linalg#8", "half turns, and theta < 1e-3",
          "wrong signs, digits lost",
          "Each component was a clamped root with the sign of the skew part, which is zero at a half turn.",
          [](const M3& R) -> V3 {
            V4 Q;
            for (int k = 0; k < 3; ++k)
              Q[k] = std::copysign(std::sqrt(std::max(0., 1 + 2 * R(k, k) - R.trace())) / 2, skew_part(R)[k]);
            Q[3] = std::sqrt(std::max(0., 1 + R.trace())) / 2;
            return log_by_atan2(Q);
          }),
      row("gl_matrix_116", "gl-matrix 2.2.1", "toji/gl-matrix#116", "all", "the inverse rotation",
          "fromMat3 read the matrix transposed.",
          [](const M3& R) -> V3 { return log_by_pivot(M3(R.transpose())); }),
  };
}

// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> logarithms_of_quaternions() {
  const auto row = rows_of(op::log3_quaternion, log_by_atan2);
  return {
      {"sophus_238", "Sophus before d63ad091", "strasdat/Sophus#238", "|v| < 1e-10",
       "1e-20, which no double shows",
       "The series of 2 atan(n/w)/n lacked a factor 1/3 in its second term, in a branch where n^2 < 1e-20.",
       forms(
           op::log3_quaternion,
           [](const V4& Q) -> V3 {
             const double n = Q.head<3>().stableNorm(), w = Q[3];
             return n < 1e-10 ? V3((2 / w - 2 * n * n / (w * w * w)) * Q.head<3>()) : log_by_atan2(Q);
           },
           [](const V4& Q) -> V3 {
             const double n = Q.head<3>().stableNorm(), w = Q[3];
             return n < 1e-10 ? V3((2 / w - 2 * n * n / (3 * w * w * w)) * Q.head<3>()) : log_by_atan2(Q);
           }),
       HistoryKind::control},
      row("bullet_2555", "Bullet 3.24", "bulletphysics/bullet3#2555", "theta < 1e-8", "0 instead of theta",
          "getAngle is 2 acos(w), which is zero where w rounds to 1.",
          [](const V4& Q) -> V3 {
            return Q[3] < 0 ? log_by_atan2(Q) : along_vector_part(Q, 2 * std::acos(std::min(1., Q[3])));
          }),
      row("gl_matrix_502", "gl-matrix 3.4.4", "toji/gl-matrix#502", "w > 1 by rounding", "NaN",
          "getAxisAngle took acos of a w that rounding had brought above 1.",
          [](const V4& Q) -> V3 {
            return Q[3] > 1 ? along_vector_part(Q, 2 * std::acos(Q[3])) : log_by_atan2(Q);
          }),
      row("ladybird_7448", "Ladybird", "LadybirdBrowser/ladybird#7448", "theta < 2e-5",
          "the angle is about 1", "Below a threshold the component w was returned as the angle.",
          [](const V4& Q) -> V3 {
            return Q.head<3>().stableNorm() < 1e-5 ? along_vector_part(Q, Q[3]) : log_by_atan2(Q);
          }),
      row("drake_3449", "Drake", "RobotLocomotion/drake#3449", "theta < 1e-7", "the axis is zero",
          "quat2axis returned a zero axis where 1 - w^2 is below a tolerance.",
          [](const V4& Q) -> V3 { return 1 - Q[3] * Q[3] < 1e-15 ? V3::Zero() : log_by_atan2(Q); }),
      row("px4_matrix_117", "PX4-Matrix", "PX4/PX4-Matrix#117", "theta < 1e-4; w < 0",
          "odd flights in simulation", "The angle was 2 acos(w), and the axis v / sin(angle/2).",
          [](const V4& Q) -> V3 {
            const double angle = 2 * std::acos(Q[3]), mag = std::sin(angle / 2);
            return std::abs(mag) > 0 ? V3(angle / mag * Q.head<3>()) : V3::Zero();
          }),
      row("px4_matrix_25", "PX4-Matrix", "PX4/PX4-Matrix#25", "all; identity", "half of the digits, 0/0",
          "The angle was 2 acosf(w) in single precision, and the axis was divided by a sine of 0.",
          [](const V4& Q) -> V3 {
            const double angle = 2 * static_cast<double>(std::acos(static_cast<float>(Q[3])));
            return angle / std::sin(angle / 2) * Q.head<3>();
          }),
      row("ceres_66", "Ceres 1.1.1", "ceres-solver/ceres-solver#66", "w < 0", "the angle is above pi",
          "QuaternionToAngleAxis did not use the sign of w.",
          [](const V4& Q) -> V3 {
            return along_vector_part(Q, 2 * std::atan2(Q.head<3>().stableNorm(), Q[3]));
          }),
      row("resonite_3440", "Resonite", "Yellow-Dog-Man/Resonite-Issues#3440", "w < 0",
          "the angle is above pi", "ToAxisAngle is 2 acos(w), clamped, for either sign of w.",
          [](const V4& Q) -> V3 {
            return Q[3] < 0 ? along_vector_part(Q, 2 * std::acos(std::max(-1., Q[3]))) : log_by_atan2(Q);
          }),
      row("tf_102", "tf before 0.7.6", "ros/geometry#102", "all", "the angle of the long way",
          "getAngleShortestPath compared the quaternion with itself, so that w had the wrong sign.",
          [](const V4& Q) -> V3 { return along_vector_part(Q, 2 * std::acos(std::clamp(-Q[3], -1., 1.))); }),
      row("wrenfold_201", "wrenfold", "wrenfold/wrenfold#201", "w < 0", "the inverse rotation",
          "to_rotation_vector lost the sign of w.",
          [](const V4& Q) -> V3 {
            return along_vector_part(Q, 2 * std::atan2(Q.head<3>().stableNorm(), std::abs(Q[3])));
          }),
      row("odin_6607", "Odin", "odin-lang/Odin#6607", "w < 0", "axis of -Q with the angle of Q",
          "The angle of a negated quaternion was that of the other way, while its axis was right.",
          [](const V4& Q) -> V3 {
            return Q[3] < 0 ? along_vector_part(V4(-Q), 2 * std::atan2(Q.head<3>().stableNorm(), Q[3]))
                            : log_by_atan2(Q);
          }),
      row("pypose_172", "PyPose", "pypose/pypose#172", "w = 0", "0 for a half turn",
          "Log divided by w, with a guard that returned zero where w is zero.",
          [](const V4& Q) -> V3 { return Q[3] == 0 ? V3::Zero() : log_by_atan2(Q); }),
  };
}

/// The angle of q0* q1 in difference, from acos: two reports.
template <int form>
V6 difference_by_acos(const V7& a, const V7& b) {
  V6 v = H::good()[op::difference](a, b);
  const V4 A = H::rotation_of(a), B = H::rotation_of(b);
  const double d = form == 0 ? A.dot(B) : std::abs(A.dot(B));
  const double angle = form == 0 ? std::acos(2 * d * d - 1) : 2 * std::acos(d);
  if (!(angle > 3)) v.tail<3>() = angle * H::low(v).stableNormalized();
  return v;
}
V6 difference_by_atan2(const V7& a, const V7& b) {
  V6 v = H::good()[op::difference](a, b);
  const V4 Q = H::multiply(H::conjugate(H::rotation_of(a)), H::rotation_of(b));
  // Nearer rotations need a formula that does not cancel, which neither report asked for.
  if (Q.head<3>().norm() > 0.1 && std::abs(Q[3]) > 0.1) v.tail<3>() = log_by_atan2(Q);
  return v;
}

std::vector<HistoricBug> differences() {
  return {
      {"gl_matrix_499", "gl-matrix 3.4.4", "toji/gl-matrix#499", "equal quaternions", "NaN",
       "getAngle took acos(2 d^2 - 1) of a dot product d that rounding had brought above 1.",
       forms(op::difference, difference_by_acos<0>, difference_by_atan2)},
      {"hector_gazebo_20", "hector_gazebo", "tu-darmstadt-ros-pkg/hector_gazebo#20", "a robot at rest", "NaN",
       "The angular velocity took acos of a relative w slightly above 1.",
       forms(op::difference, difference_by_acos<1>, difference_by_atan2)},
  };
}

const HistoryRows registered_small_angles[] = {HistoryRows(exponentials), HistoryRows(logarithms_of_matrices),
                                               HistoryRows(logarithms_of_quaternions),
                                               HistoryRows(differences)};

}  // namespace
}  // namespace liecheck::properties::history
