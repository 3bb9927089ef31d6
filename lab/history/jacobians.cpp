// Jacobians, configurations of a floating base, and their derivatives.

#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

using M76 = H::M76;

/// sum_j (-x)^j / (2j + k)!, or twice the derivative of c_{k-2}: the same sum with -(2j + 2) in the numerator.
double series(int k, double x, bool slope = false) {
  double sum = 0, term = 1;
  for (int i = 2; i <= k; ++i) term /= i;
  for (int j = 0; j < 9; ++j) {
    sum += slope ? -(2 * j + 2) * term : term;
    term *= -x / ((2 * j + k + 1) * (2 * j + k + 2));
  }
  return sum;
}
/// The coupling block of the left Jacobian of SE(3): c2 [rho] + c3 ([phi][rho] + [rho][phi]) +
/// (phi . rho) (a [phi] + b [phi]^2), with a = 2 c2' and b = 2 c3'. Below each cutoff a series is used.
M6 left_jacobian(const V6& xi, double cutoff) {
  const V3 phi = H::low(xi), rho = H::top(xi);
  const double t = phi.norm(), x = t * t, s = std::sin(t), v = 2 * std::sin(t / 2) * std::sin(t / 2);
  if (!(t < 3)) return H::good()[op::left_jacobian6](xi);
  const bool near = t < cutoff;
  const double c2 = near ? series(2, x) : v / x, c3 = near ? series(3, x) : (t - s) / (x * t),
               a = near ? series(4, x, true) : (t * s - 2 * v) / (x * x),
               b = near ? series(5, x, true) : (3 * s - 2 * t - t * std::cos(t)) / (x * x * t);
  const M3 K = hat(phi), N = hat(rho);
  return H::blocks(M3::Identity() + c2 * K + c3 * K * K,
                   c2 * N + c3 * (K * N + N * K) + phi.dot(rho) * (a * K + b * K * K));
}
/// The right inverse: I + [phi]/2 + d [phi]^2, and its derivative along rho.
M6 right_inverse(const V6& xi, double d, double slope) {
  const V3 phi = H::low(xi), rho = H::top(xi);
  const M3 K = hat(phi), N = hat(rho);
  return H::blocks(M3::Identity() + K / 2 + d * K * K,
                   N / 2 + d * (K * N + N * K) + phi.dot(rho) * slope * K * K);
}
M3 inverse3(const V3& phi, double linear, double square) {
  const M3 K = hat(phi);
  return M3::Identity() + linear * K + square * K * K;
}

std::vector<HistoricBug> jacobians() {
  return {
      {"multicalc_230", "multicalc", "kmolan/multicalc-rust#230", "6.7e-15 < theta < 1e-3", "digits lost",
       "One cutoff served every coefficient, although two of them cancel below 1e-3.",
       forms(
           op::left_jacobian6, [](const V6& xi) -> M6 { return left_jacobian(xi, 6.7e-15); },
           [](const V6& xi) -> M6 { return left_jacobian(xi, 1); })},
      {"jaxlie_20ae3c5", "jaxlie before 20ae3c5", "commit 20ae3c5 of brentyi/jaxlie", "1e-10 < theta < 1e-2",
       "a wrong coupling block",
       "The closed forms of two cancelling coefficients of jlog were used down to 1e-10.",
       forms(
           op::right_jacobian6_inverse,
           [](const V6& xi) -> M6 {
             const double t = H::low(xi).norm(), x = t * t, v = 2 * (1 - std::cos(t)), s = std::sin(t) / t;
             if (!(t < 3)) return H::good()[op::right_jacobian6_inverse](xi);
             if (t < 1e-10) return right_inverse(xi, 1 / 12., 1 / 360.);
             return right_inverse(xi, 1 / x - s / v, -2 / (x * x) + (1 + s) / (x * v));
           },
           [](const V6& xi) -> M6 {
             const double t = H::low(xi).norm(), x = t * t;
             if (t > 0.1) return H::good()[op::right_jacobian6_inverse](xi);
             const double d = 1 / 12. + x / 720 * (1 + x / 42 * (1 + x / 40));
             return right_inverse(xi, d, 1 / 360. + x / 7560 * (1 + x / 26.6666666667 * (1 + x / 29.7)));
           })},
      {"manif_223", "manif", "artivis/manif#223", "theta^2 < eps", "theta instead of -theta",
       "The inverse of the left Jacobian was I + [phi]/2 below its cutoff.",
       forms(
           op::left_jacobian3_inverse,
           [](const V3& phi) -> M3 {
             return phi.norm() < 1.5e-8 ? inverse3(phi, 0.5, 0) : H::good()[op::left_jacobian3_inverse](phi);
           },
           [](const V3& phi) -> M3 {
             return phi.norm() < 1.5e-8 ? inverse3(phi, -0.5, 0) : H::good()[op::left_jacobian3_inverse](phi);
           })},
      {"ice_ba_25", "ICE-BA", "baidu/ICE-BA#25", "all", "a wrong coefficient of [phi]^2",
       "The coefficient had 1 - cos(theta) instead of 1 + cos(theta).",
       forms(
           op::left_jacobian3_inverse,
           [](const V3& phi) -> M3 {
             const double t = phi.norm();
             if (!(t > 0.5 && t < 2.5)) return H::good()[op::left_jacobian3_inverse](phi);
             return inverse3(phi, -0.5, 1 / (t * t) - (1 - std::cos(t)) / (2 * t * std::sin(t)));
           },
           [](const V3& phi) -> M3 {
             const double t = phi.norm();
             if (!(t > 0.5 && t < 2.5)) return H::good()[op::left_jacobian3_inverse](phi);
             return inverse3(phi, -0.5, 1 / (t * t) - (1 + std::cos(t)) / (2 * t * std::sin(t)));
           })},
      {"g2o_97885180", "g2o before 97885180", "commit 97885180 of RainerKuemmerle/g2o", "all",
       "slow convergence", "The derivative of log(q0^-1 q1) lacked the inverse Jacobian of the logarithm.",
       forms(
           op::d_difference_arg1, [](const V7&, const V7&) -> M6 { return M6::Identity(); },
           [](const V7& a, const V7& b) -> M6 {
             return H::good()[op::right_jacobian6_inverse](H::good()[op::difference](a, b));
           })},
      {"g2o_200", "g2o", "RainerKuemmerle/g2o#200", "all", "the derivative of the pose, not of its log",
       "The reporter found that the first argument's derivative is the adjoint alone.",
       forms(
           op::d_difference_arg0,
           [](const V7& a, const V7& b) -> M6 {
             return -H::good()[op::d_integrate_arg0](a, H::good()[op::difference](a, b));
           },
           [](const V7& a, const V7& b) -> M6 {
             return -H::good()[op::left_jacobian6_inverse](H::good()[op::difference](a, b));
           })},
      {"pinocchio_858", "Pinocchio", "stack-of-tasks/pinocchio#858", "zero increment", "a NaN block",
       "The coupling block divided by the angle of the increment.",
       forms(
           op::d_integrate_arg1,
           [](const V7&, const V6& d) -> M6 {
             M6 J = H::good()[op::right_jacobian6](d);
             const double t = H::low(d).norm();
             if (t < 1e-3) J.topRightCorner<3, 3>() *= t / t;
             return J;
           },
           [](const V7&, const V6& d) -> M6 { return H::good()[op::right_jacobian6](d); })},
  };
}

V7 with_rotation(V7 r, const V4& Q) {
  r.tail<4>() = Q;
  return r;
}

V7 good(const V7& q, const V6& d) {
  return H::good()[op::integrate](q, d);
}
V7 fixed(const V7& q, const V6& d) {
  const V4 Q = H::multiply(H::rotation_of(q), H::good()[op::exp3_quaternion](H::low(d))).normalized();
  return with_rotation(good(q, d), Q.dot(H::rotation_of(q)) < 0 ? V4(-Q) : Q);
}
M76 fixed_map(const V7& q) {
  M76 J = H::good()[op::integrate_coefficient_jacobian](q);
  const V4 Q = H::rotation_of(q);
  J.bottomRightCorner<4, 3>() << M3(Q[3] * M3::Identity() + hat(V3(Q.head<3>()))) / 2,
      -Q.head<3>().transpose() / 2;
  return J;
}

std::vector<HistoricBug> configurations() {
  const auto of_integrate = rows_of(op::integrate, fixed);
  const auto of_map = rows_of(op::integrate_coefficient_jacobian, fixed_map);
  return {
      of_integrate("dart_122", "DART before PR 168", "dartsim/dart#122", "dq not parallel to q",
                   "another orientation",
                   "The rotation vector of the increment was added to that of the orientation.",
                   [](const V7& q, const V6& d) -> V7 {
                     const V3 phi = H::good()[op::log3_quaternion](H::rotation_of(q)) + H::low(d);
                     return with_rotation(good(q, d), H::good()[op::exp3_quaternion](phi));
                   }),
      of_integrate("dart_518", "DART before PR 518", "dartsim/dart#518", "theta near 180 degrees",
                   "the motion reverses", "Beyond a half turn the rotation vector went back the way it came.",
                   [](const V7& q, const V6& d) -> V7 {
                     const V7 r = good(q, d);
                     const V4 Q = H::rotation_of(q)[3] < 0 ? V4(-H::rotation_of(q)) : H::rotation_of(q);
                     if (H::multiply(Q, H::good()[op::exp3_quaternion](H::low(d)))[3] >= 0) return r;
                     return with_rotation(
                         r, H::multiply(Q, H::conjugate(H::good()[op::exp3_quaternion](H::low(d)))));
                   }),
      of_integrate("sofa_172", "SOFA", "sofa-framework/sofa#172", "|omega| h not small",
                   "less than the angle",
                   "The increment was the Cayley map (1, phi/2) instead of the exponential.",
                   [](const V7& q, const V6& d) -> V7 {
                     V4 Q;
                     Q << H::low(d) / 2, 1;
                     return with_rotation(good(q, d), H::multiply(H::rotation_of(q), Q).normalized());
                   }),
      of_map("drake_4121", "Drake before PR 4965", "RobotLocomotion/drake#4121", "all", "4 digits lost",
             "The report gives the loss and not its cause: this form is the right map with an error of that "
             "size.",
             [](const V7& q) -> M76 {
               M76 J = fixed_map(q);
               J.bottomRightCorner<4, 3>() *= 1 + 0x1p-37;
               return J;
             }),
      of_map("drake_8177", "Drake before PR 8192", "RobotLocomotion/drake#8177", "all",
             "a wrong map, hidden by integration tests", "N(q) took the angular velocity in the other frame.",
             [](const V7& q) -> M76 {
               M76 J = fixed_map(q);
               const V4 Q = H::rotation_of(q);
               J.block<3, 3>(3, 3) = (Q[3] * M3::Identity() - hat(V3(Q.head<3>()))) / 2;
               return J;
             }),
  };
}

const HistoryRows registered_jacobians[] = {HistoryRows(jacobians), HistoryRows(configurations)};

}  // namespace
}  // namespace liecheck::properties::history
