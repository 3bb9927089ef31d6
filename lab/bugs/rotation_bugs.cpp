// Known bugs in exp and log of rotations and poses, and in their Jacobians.

#include <bugs/planted_bugs.hpp>

#include <cmath>

namespace liecheck::properties {

template <class S>
auto Bugs<S>::exp_of_rotations() -> Entries {
  return {
      {"exp_zero_limit", "below 1e-7 the vector part of the quaternion is zero", "kornia/kornia-rs pull 535",
       op::exp3_quaternion,
       [](const V3& phi) -> V4 {
         if (angle(phi) < S(1e-7)) return {S(0), S(0), S(0), S(1)};
         return good()[op::exp3_quaternion](phi);
       }},
      {"exp_series_sign", "the second term of the series of sin(theta/2)/theta has the wrong sign",
       "stack-of-tasks/pinocchio issue 1964 (a series term of so3 questioned, untested)",
       changed<op::exp3_quaternion>([](V4& q, const V3& phi) {
         const S t = angle(phi);
         if (t > S(1e-2)) return;
         q.template head<3>() = (S(1) / S(2) + t * t / S(48)) * phi;
       })},
      {"exp_angle_not_halved", "the quaternion of exp rotates by twice the angle",
       "heliorc/imuf-release issue 9 (quaternion kinematics that degrade)", op::exp3_quaternion,
       [](const V3& phi) -> V4 { return good()[op::exp3_quaternion](S(2) * phi); }},
      {"exp_float_constant", "2 pi is a float constant in the reduction of the angle",
       "fedassa/SHOT issue 8 (float constants in a double path)", op::exp3_matrix,
       [](const V3& phi) -> M3 {
         if (sizeof(S) == 4) return good()[op::exp3_matrix](V3(phi * S(1.00001f)));
         const S t = angle(phi);
         if (t < S(3)) return good()[op::exp3_matrix](phi);
         const S turn = S(6.2831855f);
         return good()[op::exp3_matrix](V3(phi * ((t - turn * std::floor(t / turn)) / t)));
       }},
      {"exp_no_overflow_guard", "theta^2 overflows and gives NaN",
       "gazebosim/gz-math pull 620 (guards by theta^2)", op::exp3_matrix,
       [](const V3& phi) -> M3 {
         const S x = phi.dot(phi), t = std::sqrt(x);
         const M3 K = hat(phi);
         if (x < S(1)) return good()[op::exp3_matrix](phi);
         return M3::Identity() + std::sin(t) / t * K + (S(1) - std::cos(t)) / x * K * K;
       }},
      {"exp_cancelling_cosine", "(1 - cos theta) / theta^2, which cancels, is used down to theta = 1e-6",
       "gazebosim/gz-math pull 620", op::exp3_matrix,
       [](const V3& phi) -> M3 {
         const S t = angle(phi);
         if (t < S(1e-6) || t > S(3)) return good()[op::exp3_matrix](phi);
         const M3 K = hat(phi);
         return M3::Identity() + std::sin(t) / t * K + (S(1) - std::cos(t)) / (t * t) * K * K;
       }},
      {"exp_nan_at_zero", "0/0 at theta = 0", "kornia/kornia-rs pull 535",
       changed<op::exp6>([](P& T, const V6& xi) { T.p += S(0) * top(xi) / angle(low(xi)); })},
  };
}

template <class S>
auto Bugs<S>::log_of_rotations() -> Entries {
  return {
      {"log_acos_w", "2 acos(w), which is NaN if w is one ulp above 1",
       "Yellow-Dog-Man/Resonite-Issues issue 4728", op::log3_quaternion,
       [](const V4& Q) -> V3 {
         const V4 q = Q[3] < S(0) ? V4(-Q) : Q;
         const S s = q.template head<3>().norm();
         if (s == S(0)) return V3::Zero();
         return S(2) * std::acos(q[3]) / s * q.template head<3>();
       }},
      {"log_no_sign", "the angle exceeds pi if w is negative", "borglab/SwiftFusion pull 111",
       op::log3_quaternion,
       [](const V4& Q) -> V3 {
         const S s = Q.template head<3>().norm();
         if (s == S(0)) return V3::Zero();
         return S(2) * std::atan2(s, Q[3]) / s * Q.template head<3>();
       }},
      {"log_acos_trace", "acos((tr R - 1) / 2), which cancels near theta = 0 and is NaN if tr R is above 3",
       "stack-of-tasks/pinocchio issue 2768", op::log3_matrix,
       [](const M3& R) -> V3 {
         const S t = std::acos((R.trace() - S(1)) / S(2));
         const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
         return t > S(3) ? good()[op::log3_matrix](R) : V3(t / (S(2) * std::sin(t)) * a);
       }},
      {"log_acos_clamped", "acos((tr R - 1) / 2) with the argument clamped at 1 but not at -1",
       "bdaiinstitute/spatialmath-python pull 86", op::log3_matrix,
       [](const M3& R) -> V3 {
         const S t = std::acos(std::min(S(1), S((R.trace() - S(1)) / S(2))));
         const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
         if (t > S(3)) return good()[op::log3_matrix](R);
         return t == S(0) ? V3(a / S(2)) : V3(t / (S(2) * std::sin(t)) * a);
       }},
      {"log_pivot_near_pi", "the pivot near pi is 2 + 2 R_ii instead of 1 + 2 R_ii - tr R",
       "borglab/gtsam pull 2723", op::log3_matrix,
       [](const M3& R) -> V3 {
         if (R.trace() > S(-0.9)) return good()[op::log3_matrix](R);
         int i = 0;
         R.diagonal().maxCoeff(&i);
         const V3 axis = (R.col(i) + V3::Unit(i)) / std::sqrt(S(2) + S(2) * R(i, i));
         const V3 exact = good()[op::log3_matrix](R);
         return exact.norm() * (axis.dot(exact) < S(0) ? S(-1) : S(1)) * axis;
       }},
      {"log_half_turn_zero", "the logarithm is zero at theta = pi", "OliverWu515/ommpc_controller issue 5",
       op::log3_matrix,
       [](const M3& R) -> V3 {
         const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
         return a.norm() < S(1e-6) ? V3(a / S(2)) : good()[op::log3_matrix](R);
       }},
      {"log_axis_sign_at_pi", "symmetric rotation matrices give NaN", "tussedrotten/pylie issue 6",
       op::log3_matrix,
       [](const M3& R) -> V3 {
         const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
         const V3 exact = good()[op::log3_matrix](R);
         return R.trace() < S(0) ? V3(exact.norm() * a.normalized() / (a.norm() > S(0) ? S(1) : S(0)))
                                 : exact;
       }},
      {"log_transposed", "the logarithm of R^T is returned", "tud-phi/ros2-mocap_optitrack pull 17",
       op::log3_matrix, [](const M3& R) -> V3 { return good()[op::log3_matrix](M3(R.transpose())); }},
  };
}

template <class S>
auto Bugs<S>::exp_and_log_of_poses() -> Entries {
  return {
      {"exp6_no_V", "the translation is rho, not V rho", "gbionics/idyntree issue 561", op::exp6,
       [](const V6& xi) -> P {
         return {good()[op::exp6](xi).R, top(xi)};
       }},
      {"exp6_shared_cutoff", "one cutoff 1e-4 for every coefficient, and only the first series term below it",
       "pettni/smooth, one cutoff for every scalar", op::exp6,
       [](const V6& xi) -> P {
         const S t = angle(low(xi));
         const M3 K = hat(low(xi));
         if (t > S(3)) return good()[op::exp6](xi);
         const S b = t < S(1e-4) ? S(1) / S(6) : (t - std::sin(t)) / (t * t * t);
         const S a = t < S(1e-4) ? S(1) / S(2) : (S(1) - std::cos(t)) / (t * t);
         return pose_exp(xi, M3::Identity() + a * K + b * K * K);
       }},
      {"exp6_right_V", "the translation is J_r rho instead of J_l rho", "artivis/manif pull 22", op::exp6,
       [](const V6& xi) -> P { return pose_exp(xi, good()[op::right_jacobian3](low(xi))); }},
      {"exp6_angular_first", "the twist is read with the angular part first",
       "rail-berkeley/hil-serl issue 36", op::exp6,
       [](const V6& xi) -> P { return good()[op::exp6](stack(low(xi), top(xi))); }},
      {"log6_no_V_inverse", "the linear part of log is p, not V^-1 p", "gbionics/idyntree issue 561",
       op::log6, [](const P& T) -> V6 { return stack(T.p, good()[op::log3_matrix](T.R)); }},
      {"log6_theta_divided", "V^-1 p is divided by theta instead of multiplied by it",
       "Le0nX/ModernRoboticsCpp issue 31", op::log6,
       [](const P& T) -> V6 {
         const V6 xi = good()[op::log6](T);
         const S t = angle(low(xi));
         return t > S(0) ? stack(top(xi) / (t * t), low(xi)) : xi;
       }},
      {"log6_series_coefficient", "V^-1 has the coefficient 1/6 instead of 1/12 below theta = 1e-3",
       "stack-of-tasks/pinocchio issue 1983", op::log6,
       [](const P& T) -> V6 {
         const V3 phi = good()[op::log3_matrix](T.R);
         if (angle(phi) > S(1e-3)) return good()[op::log6](T);
         const M3 K = hat(phi);
         return stack(T.p - K * T.p / S(2) + K * K * T.p / S(6), phi);
       }},
  };
}

template <class S>
auto Bugs<S>::jacobians() -> Entries {
  return {
      {"jacobian_left_for_right", "the left Jacobian is returned as the right one", "artivis/manif pull 22",
       [](O& o) {
         o[op::right_jacobian3] = o[op::left_jacobian3];
         o[op::right_jacobian6] = o[op::left_jacobian6];
       }},
      {"jacobian6_no_coupling", "the coupling block is [rho] / 2", "artivis/manif pull 22",
       op::left_jacobian6,
       [](const V6& xi) -> M6 { return blocks(good()[op::left_jacobian3](low(xi)), hat(top(xi)) / S(2)); }},
      {"jacobian6_coupling_sign", "the last term of the coupling block has the wrong sign",
       "dqrobotics/matlab issue 62 (a sign in a pose Jacobian)",
       changed<op::left_jacobian6>([](M6& J, const V6& xi) {
         const V3 phi = low(xi), rho = top(xi);
         const M3 K = hat(phi);
         J.template topRightCorner<3, 3>() += S(1) / S(60) * phi.dot(rho) * K * K * std::exp(-phi.norm());
       })},
      {"jacobian6_cancelling", "the coefficients of the coupling block cancel for theta from 1e-5 to 0.1",
       "RainerKuemmerle/g2o issue 221 (closed forms from 1e-5)",
       changed<op::right_jacobian6>([](M6& J, const V6& xi) {
         const S t = angle(low(xi));
         if (t < S(1e-5) || t > S(0.1)) return;
         const M3 K = hat(low(xi)), Q = hat(top(xi));
         const S c2 = (S(1) - std::cos(t)) / (t * t), c3 = (t - std::sin(t)) / (t * t * t);
         const S phi_rho = low(xi).dot(top(xi));
         const S a = (t * std::sin(t) - S(2) * (S(1) - std::cos(t))) / (t * t * t * t);
         const S b = (t * (S(1) - std::cos(t)) - S(3) * (t - std::sin(t))) / (t * t * t * t * t);
         J.template topRightCorner<3, 3>() =
             -c2 * Q + c3 * (K * Q + Q * K) - phi_rho * a * K + phi_rho * b * K * K;
       })},
      {"inverse_jacobian_coefficient", "the coefficient 1/10 instead of 1/12 below theta = 1e-2",
       "stack-of-tasks/pinocchio issue 1964", op::left_jacobian3_inverse,
       [](const V3& phi) -> M3 {
         const M3 K = hat(phi);
         if (angle(phi) > S(1e-2)) return good()[op::left_jacobian3_inverse](phi);
         return M3::Identity() - K / S(2) + K * K / S(10);
       }},
      {"inverse_jacobian_sign", "the first-order term of the inverse has the wrong sign",
       "artivis/manif pull 22", op::right_jacobian6_inverse,
       [](const V6& xi) -> M6 { return good()[op::left_jacobian6_inverse](xi); }},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties
