// Known bugs between rotations and directions, in Euler angles, in the rates of stored numbers and in SE(2).

#include <bugs/planted_bugs.hpp>

#include <cmath>

namespace liecheck::properties {

template <class S>
auto Bugs<S>::relative_rotations() -> Entries {
  return {
      {"relative_angle_acos", "2 acos(|Q0 . Q1|), which is 1e-8 or NaN for equal quaternions",
       "toji/gl-matrix pull 499", op::relative_angle,
       [](const V4& a, const V4& b) -> S { return S(2) * std::acos(std::abs(a.dot(b))); }},
      {"relative_angle_long_way", "an angle above pi if Q0 . Q1 < 0", "ros/geometry2 issue 185",
       op::relative_angle,
       [](const V4& a, const V4& b) -> S {
         const V4 q = multiply(conjugate(a), b);
         return S(2) * std::atan2(q.template head<3>().norm(), q[3]);
       }},
      {"twist_dead_zone", "the angle is 2 acos(w) with the sign of v . axis: 0 for small angles",
       "newton-physics/newton issue 3434", op::twist_angle,
       [](const V4& Q, const V3& axis) -> S {
         const S s = Q.template head<3>().dot(axis), w = std::min(S(1), std::abs(Q[3]));
         const S angle = S(2) * std::acos(w);
         return (s < S(0)) == (Q[3] < S(0)) ? angle : -angle;
       }},
      {"twist_beyond_pi", "the sign of w is ignored", "ros/geometry2 issue 185", op::twist_angle,
       [](const V4& Q, const V3& axis) -> S {
         return S(2) * std::atan2(Q.template head<3>().dot(axis), Q[3]);
       }},
      {"slerp_long_way", "the longer arc if Q0 . Q1 < 0", "naver/roma issue 3", op::slerp,
       [](const V4& a, const V4& b, const S& t) -> V4 {
         const S h = std::acos(std::max(S(-1), std::min(S(1), a.dot(b)))), sine = std::sin(h);
         if (!(sine > S(1e-3))) return good()[op::slerp](a, b, t);
         return ((std::sin((S(1) - t) * h) * a + std::sin(t * h) * b) / sine).normalized();
       }},
      {"slerp_midpoint", "the midpoint for every t if the angle is small", "mrdoob/three.js issue 14258",
       op::slerp,
       [](const V4& a, const V4& b, const S& t) -> V4 {
         return good()[op::slerp](a, b, std::abs(a.dot(b)) > S(0.9999995) ? S(0.5) : t);
       }},
      {"slerp_linear", "linear interpolation up to 0.2 rad",
       "linear interpolation near cos = 0.9995, Shoemake 1985", op::slerp,
       [](const V4& a, const V4& b, const S& t) -> V4 {
         const S d = a.dot(b);
         if (std::abs(d) < S(0.995)) return good()[op::slerp](a, b, t);
         return ((S(1) - t) * a + (d < S(0) ? S(-t) : t) * b).normalized();
       }},
      {"between_no_opposite", "0/0 for opposite directions", "dimforge/nalgebra issue 316",
       op::rotation_between,
       [](const V3& a, const V3& b) -> V4 {
         V4 q;
         q << a.cross(b), S(1) + a.dot(b);
         return q / q.norm();
       }},
      {"between_equal_threshold", "the identity for a . b > 0.99999", "dimforge/nalgebra issue 316",
       op::rotation_between,
       [](const V3& a, const V3& b) -> V4 {
         return a.dot(b) > S(0.99999) ? V4(V4::Unit(3)) : good()[op::rotation_between](a, b);
       }},
      {"between_fixed_axis",
       "for nearly opposite directions a half turn about an axis that is perpendicular to x only",
       "mrdoob/three.js, setFromUnitVectors", op::rotation_between,
       [](const V3& a, const V3& b) -> V4 {
         if (a.dot(b) > S(-0.999)) return good()[op::rotation_between](a, b);
         return {S(0), S(1), S(0), S(0)};
       }},
  };
}

template <class S>
auto Bugs<S>::euler_angles() -> Entries {
  return {
      {"euler_static_as_rotating", "the three rotations are multiplied in the opposite order",
       "ros/geometry issue 102", op::euler_to_quaternion,
       [](const S& order, const V3& x) -> V4 {
         return good()[op::euler_to_quaternion](std::fmod(order, S(2)) > S(0) ? order - S(1) : order + S(1),
                                                x);
       }},
      {"euler_lock_45_degrees",
       "near gimbal lock the first angle is atan2 of rounding errors and the third is 0",
       "ros2/geometry2 issue 796", changed<op::euler_from_quaternion>([](V3& x, const S& order, const V4&) {
         if (order < S(12) && std::abs(std::abs(x[1]) - S(M_PI_2)) < S(1e-3)) x[0] = S(M_PI_4), x[2] = S(0);
       })},
      {"euler_asin_above_one", "asin of an entry that rounding has carried above 1 is NaN",
       "dimforge/nalgebra issue 494", op::euler_from_matrix,
       [](const S& order, const M3& R) -> V3 {
         V3 x = good()[op::euler_from_matrix](order, R);
         if (order == S(11)) x[1] = std::asin(-R(2, 0) * (S(1) + std::numeric_limits<S>::epsilon()));
         return x;
       }},
      {"euler_middle_beyond_range", "the middle angle is pi - b, with the other two turned by pi",
       "the second set of Euler angles, Diebel 2006",
       changed<op::euler_from_matrix>([](V3& x, const S& order, const M3&) {
         const auto turned = [](S a) { return a > S(0) ? S(a - S(M_PI)) : S(a + S(M_PI)); };
         x = V3(turned(x[0]), order < S(12) ? S(S(M_PI) - x[1]) : S(-x[1]), turned(x[2]));
       })},
      {"euler_matrix_transposed", "R^T is returned", "toji/gl-matrix issue 116", op::euler_to_matrix,
       [](const S& order, const V3& x) -> M3 { return good()[op::euler_to_matrix](order, x).transpose(); }},
  };
}

template <class S>
auto Bugs<S>::rates_and_planar_poses() -> Entries {
  return {
      {"rate_omega_of_parent", "Q_dot = 1/2 (omega, 0) Q, as if omega were in axes of the parent",
       "RobotLocomotion/drake issue 8177", op::velocity_to_rate,
       [](const V7& q, const V6& V) -> V7 {
         V7 rate = good()[op::velocity_to_rate](q, V);
         V4 omega;
         omega << low(V) / S(2), S(0);
         rate.template tail<4>() = multiply(omega, rotation_of(q));
         return rate;
       }},
      {"rate_narrow_constant", "1/2 is 0.49999, as after a conversion that loses digits",
       "RobotLocomotion/drake issue 4121", changed<op::velocity_to_rate>([](V7& rate, const V7&, const V6&) {
         rate.template tail<4>() *= S(0.99998);
       })},
      {"velocity_factor", "omega = 1/2 Q* Q_dot: the transpose of N for its inverse",
       "RobotLocomotion/drake issue 8177",
       changed<op::rate_to_velocity>([](V6& V, const V7&, const V7&) { V.template tail<3>() /= S(4); })},
      {"se2_exp_without_V", "the translation is rho", "borglab/gtsam pull 2043", op::se2_exp,
       [](const V3& d) -> V4 {
         return {d[0], d[1], std::cos(d[2]), std::sin(d[2])};
       }},
      {"se2_log_small_angle", "0/0 at omega = 0 and lost digits near it",
       "JuliaManifolds/LieGroups.jl issue 44", op::se2_log,
       [](const V4& q) -> V3 {
         const S t = std::atan2(q[3], q[2]), a = t / S(2) * std::sin(t) / (S(1) - std::cos(t)), b = t / S(2);
         return {a * q[0] + b * q[1], a * q[1] - b * q[0], t};
       }},
      {"se2_compose_no_rotation", "the second translation is added without a rotation",
       "kornia/kornia-rs issue 534", changed<op::se2_compose>([](V4& q, const V4& a, const V4& b) {
         q.template head<2>() = a.template head<2>() + b.template head<2>();
       })},
      {"se2_difference_in_parent", "the translation is p1 - p0 in axes of the parent",
       "stack-of-tasks/pinocchio issue 308", changed<op::se2_difference>([](V3& d, const V4& a, const V4& b) {
         d.template head<2>() = b.template head<2>() - a.template head<2>();
       })},
      {"se2_integrate_before_turn", "p1 = p0 + R(angle0 + omega) rho, without V",
       "stack-of-tasks/pinocchio issue 308", changed<op::se2_integrate>([](V4& q, const V4& q0, const V3& d) {
         q[0] = q0[0] + q[2] * d[0] - q[3] * d[1], q[1] = q0[1] + q[3] * d[0] + q[2] * d[1];
       })},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties
