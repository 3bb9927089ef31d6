// Logarithms near theta = pi.

#include <algorithm>
#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

/// The axis of a half turn with the given signs: roots of (R_ii + 1)/2.
V3 roots_of_diagonal(const M3& R, const V3& signs) {
  return ((R.diagonal().array() + 1) / 2).max(0).sqrt().matrix().cwiseProduct(signs);
}
V3 signs_of(const V3& a) {
  return a.unaryExpr([](double x) { return x > 0 ? 1. : x < 0 ? -1. : 0.; });
}

// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> logarithms() {
  const auto row = rows_of(op::log3_matrix, log_by_pivot);
  return {
      row("gtsam_1233", "GTSAM 4.2a7 to 2026-08", "borglab/gtsam#1233", "tr R + 1 < 1e-3",
          "2.3e-4 relative, a jump",
          "The pivot was 2 + 2 R_ii instead of 1 + 2 R_ii - tr R, and the angle was pi - 2 w to first order.",
          [](const M3& R) -> V3 {
            if (R.trace() + 1 >= 1e-3) return log_by_pivot(R);
            int i = 0;
            R.diagonal().maxCoeff(&i);
            V3 u = R.col(i) + R.row(i).transpose();
            u[i] = 2 + 2 * R(i, i);
            const double r = std::sqrt(u[i]), w = 2 * skew_part(R)[i];
            const double angle = 3.141592653589793 - 2 * std::abs(w) / std::hypot(u.norm(), w);
            return (w < 0 ? -angle : angle) / (2 * r) * u;
          }),
      row("pinocchio_1405_near_pi", "Pinocchio before 46f650870", "stack-of-tasks/pinocchio#1405",
          "tr R near -1", "pi instead of theta",
          "The angle was set to pi over a whole neighbourhood of the half turn.",
          [](const M3& R) -> V3 {
            const V3 right = log_by_pivot(R);
            return R.trace() < -1 + 1e-12 ? V3(3.141592653589793 * right.normalized()) : right;
          }),
      row("ommpc_5", "ommpc_controller", "OliverWu515/ommpc_controller#5", "theta near pi",
          "0; tracking is lost",
          "Where sin(theta) is small, half of the skew part was returned, also at a half turn.",
          [](const M3& R) -> V3 {
            const V3 a = skew_part(R);
            return a.norm() < 1e-6 ? a : log_by_pivot(R);
          }),
      row("drake_601", "Drake", "RobotLocomotion/drake#601", "symmetric R", "a zero axis",
          "rotmat2axis normalised the skew part, which is zero for a symmetric matrix.",
          [](const M3& R) -> V3 {
            const V3 a = skew_part(R);
            return a.isZero(0) ? V3::Zero() : log_by_pivot(R);
          }),
      row("drake_3451", "Drake", "RobotLocomotion/drake#3451", "theta = pi",
          "a half turn about the zero vector", "rotmat2axis handled theta = 0 and not theta = pi.",
          [](const M3& R) -> V3 {
            const double t = clamped_angle(R);
            return t < 3.14159 ? log_by_pivot(R) : V3(t / (2 * std::sin(t) + 1e-300) * skew_part(R) * 2);
          }),
      row("pytorch3d_413", "PyTorch3D", "facebookresearch/pytorch3d#413", "|sin theta| < 5e-5",
          "0 for a half turn",
          "The factor theta/sin(theta) was replaced by 1 where the sine is small, also near pi.",
          [](const M3& R) -> V3 {
            const double t = clamped_angle(R);
            return std::sin(t) < 5e-5 ? skew_part(R) : log_by_pivot(R);
          }),
      row("fast_lio_103", "FAST_LIO", "hku-mars/FAST_LIO#103", "theta near pi", "0 for a half turn",
          "theta/(2 sin theta) times the skew part was used up to theta = pi.",
          [](const M3& R) -> V3 {
            const double t = clamped_angle(R);
            return t < 1.5 ? log_by_pivot(R) : V3(t / std::sin(t) * skew_part(R));
          }),
      row("manipulapy_42", "ManipulaPy 1.3.2", "boelnasr/ManipulaPy#42", "theta = pi about a coordinate axis",
          "0", "The branch of pi took the axis from products that vanish for a coordinate axis.",
          [](const M3& R) -> V3 {
            const V3 off(R(1, 2), R(0, 2), R(0, 1));
            return R.trace() < -1 + 1e-9 && off.norm() < 1e-9 ? V3::Zero() : log_by_pivot(R);
          }),
      row("pytransform3d_370", "pytransform3d", "dfki-ric/pytransform3d#370", "theta = pi, general axis",
          "a different rotation in 40 %",
          "The signs of the axis came from the skew part, which is noise at pi.",
          [](const M3& R) -> V3 {
            if (R.trace() > -1 + 1e-10) return log_by_pivot(R);
            V3 signs = signs_of(skew_part(R));
            for (double& s : signs) s = s == 0 ? 1 : s;
            return clamped_angle(R) * roots_of_diagonal(R, signs).normalized();
          }),
      row("pytransform3d_364", "pytransform3d", "dfki-ric/pytransform3d#364",
          "theta = pi about a coordinate axis", "NaN", "The sign of zero is zero, so that the axis was 0/0.",
          [](const M3& R) -> V3 {
            if (R.trace() > -1 + 1e-10) return log_by_pivot(R);
            const V3 axis = roots_of_diagonal(R, signs_of(skew_part(R)));
            return axis.isZero(0) ? V3(clamped_angle(R) / axis.norm() * axis) : log_by_pivot(R);
          }),
      row("pylie_6", "pylie", "tussedrotten/pylie#6", "symmetric R, tr R <= 0", "NaN",
          "The skew part was normalised although it is zero.",
          [](const M3& R) -> V3 {
            const V3 a = skew_part(R);
            return R.trace() <= 0 && a.isZero(0) ? V3(a / a.norm()) : log_by_pivot(R);
          }),
      row("cardillo_68", "cardillo", "cardilloproject/cardillo#68", "theta = pi", "the skew part",
          "The check against a division by zero took the first order of theta = 0 at theta = pi, too.",
          [](const M3& R) -> V3 {
            const double t = clamped_angle(R), s = std::sin(t);
            return s < 1e-12 ? skew_part(R) : t > 3 ? V3(t / s * skew_part(R)) : log_by_pivot(R);
          }),
      row("pointnetlk_21", "PointNetLK", "hmgoforth/PointNetLK#21", "theta near pi", "0",
          "The generators' coefficients were taken from the skew part, which rounding removes near pi.",
          [](const M3& R) -> V3 {
            const double t = clamped_angle(R);
            return t > 3 && skew_part(R).norm() < 1e-5 ? V3::Zero() : log_by_pivot(R);
          }),
      row("strands_2439", "strands robots", "strands-labs/robots#2439", "theta >= 120 degrees",
          "the identity",
          "Only the branch tr R > 0 of the quaternion was written; the other one returned the identity.",
          [](const M3& R) -> V3 { return R.trace() > 0 ? log_by_pivot(R) : V3::Zero(); }),
      row("orocos_32", "KDL before PR 32", "orocos/orocos_kinematics_dynamics#32", "tr R near -1",
          "digits lost",
          "The trace's branch was taken wherever 1 + tr R exceeds 1e-12, so that it divides by nearly zero.",
          [](const M3& R) -> V3 {
            if (1 + R.trace() <= 1e-12 || R.trace() > 0) return log_by_pivot(R);
            const double s = 0.5 / std::sqrt(1 + R.trace());
            V4 Q;
            Q << 2 * s * skew_part(R), 0.25 / s;
            return log_by_atan2(Q);
          }),
      row("graphene_287", "graphene", "ebassi/graphene#287", "tr R = -1", "another rotation",
          "The branch of the largest diagonal entry failed where the trace is exactly -1.",
          [](const M3& R) -> V3 {
            if (R.trace() > -1) return log_by_pivot(R);
            V4 Q;
            Q << skew_part(R), 0;
            return log_by_atan2(Q);
          }),
  };
}

const HistoryRows registered_near_pi(logarithms);

}  // namespace
}  // namespace liecheck::properties::history
