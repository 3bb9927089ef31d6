// Known bugs in integrate, difference and their derivatives, and in configurations of robots.

#include <bugs/planted_bugs.hpp>

#include <cmath>

namespace liecheck::properties {

template <class S>
auto Bugs<S>::integration() -> Entries {
  return {
      {"integrate_w_first", "the increment's quaternion is read in the order w x y z",
       "stack-of-tasks/pinocchio issue 16", op::integrate,
       [](const V7& q, const V6& d) -> V7 {
         const V4 e = good()[op::exp3_quaternion](low(d));
         const V4 wrong(e[3], e[0], e[1], e[2]);
         return moved(q, good()[op::rotate_point](rotation_of(q), good()[op::exp6](d).p),
                      multiply(rotation_of(q), wrong));
       }},
      {"integrate_left", "the increment multiplies on the left", "RobotLocomotion/drake issue 1129",
       changed<op::integrate>([](V7& r, const V7& q, const V6& d) {
         r.template tail<4>() = multiply(good()[op::exp3_quaternion](low(d)), rotation_of(q));
       })},
      {"integrate_world_velocity", "the linear increment is taken in world axes",
       "ethz-asl/ros_vrpn_client pull 41", changed<op::integrate>([](V7& r, const V7& q, const V6& d) {
         r.template head<3>() = q.template head<3>() + good()[op::exp6](d).p;
       })},
      {"integrate_euler", "p + R rho: the path is a straight line instead of an arc",
       "robotology-legacy/mex-wholebodymodel issue 30 (velocities of the base)",
       changed<op::integrate>([](V7& r, const V7& q, const V6& d) {
         r.template head<3>() = q.template head<3>() + good()[op::rotate_point](rotation_of(q), top(d));
       })},
      {"integrate_no_normalization", "the quaternion product is not normalised, so that its norm error grows",
       "collabora/libsurvive pull 79", changed<op::integrate>([](V7& r, const V7& q, const V6&) {
         const S n = rotation_of(q).norm();
         r.template tail<4>() *= n * n * n * n;
       })},
      {"integrate_no_sign_flip", "Q is replaced by -Q if w of the product is negative",
       "DOI-USGS/ale issue 603", changed<op::integrate>([](V7& r, const V7&, const V6&) {
         if (r[6] < S(0)) r.template tail<4>() *= S(-1);
       })},
      {"integrate_stale", "a small increment uses the rotation of an earlier, larger increment",
       "loco-3d/crocoddyl issue 363 (data of the SE3 residual not updated)",
       changed<op::integrate>([](V7& r, const V7& q, const V6& d) {
         thread_local V4 stale = V4::Unit(3);
         if (angle(low(d)) > S(0.1))
           stale = good()[op::exp3_quaternion](low(d));
         else if (angle(low(d)) > S(1e-3))
           r.template tail<4>() = multiply(rotation_of(q), stale);
       })},
  };
}

template <class S>
auto Bugs<S>::differences() -> Entries {
  return {
      {"difference_world", "the relative translation stays in world axes", "loco-3d/crocoddyl issue 330",
       op::difference,
       [](const V7& a, const V7& b) -> V6 {
         V7 origin = a;
         origin.template head<3>().setZero();
         V7 other = b;
         other.template head<3>() = good()[op::rotate_point](rotation_of(a), V3((b - a).template head<3>()));
         return good()[op::difference](origin, other);
       }},
      {"difference_order", "the difference is taken from q1 to q0", "naver/roma issue 3", op::difference,
       [](const V7& a, const V7& b) -> V6 { return good()[op::difference](b, a); }},
      {"difference_naive", "log(Q0* Q1) cancels for nearby poses: relative error 1 at 1e-16",
       "stack-of-tasks/pinocchio issue 1964", changed<op::difference>([](V6& v, const V7& a, const V7& b) {
         v.template tail<3>() =
             good()[op::log3_quaternion](multiply(conjugate(rotation_of(a)), rotation_of(b)));
       })},
      {"difference_double_cover", "Q and -Q have a difference of 2 pi", "bdero/flutter_scene pull 275",
       changed<op::difference>([](V6& v, const V7& a, const V7& b) {
         const S t = angle(low(v));
         if (rotation_of(a).dot(rotation_of(b)) < S(0) && t > S(0))
           v.template tail<3>() *= (t - S(6.283185307179586)) / t;
       })},
      {"first_order_on_input", "first-order normalisation of both inputs, whose norms need not be near 1",
       "RobotLocomotion/drake issue 14800", op::difference,
       [](const V7& a, const V7& b) -> V6 {
         const auto once = [](V7 q) {
           q.template tail<4>() *= (S(2.999) - rotation_of(q).squaredNorm()) / S(2);
           q.template head<3>() *= rotation_of(q).norm();
           return q;
         };
         return good()[op::difference](once(a), once(b));
       }},
  };
}

template <class S>
auto Bugs<S>::configuration_derivatives() -> Entries {
  return {
      {"d_integrate_adjoint", "ARG0 is Ad(exp(d)) instead of its inverse", "colmap/colmap pull 3155",
       op::d_integrate_arg0,
       [](const V7& q, const V6& d) -> M6 { return good()[op::d_integrate_arg0](q, V6(-d)); }},
      {"d_integrate_transposed", "ARG0 is transposed", "pypose/pypose pull 2", op::d_integrate_arg0,
       [](const V7& q, const V6& d) -> M6 { return good()[op::d_integrate_arg0](q, d).transpose(); }},
      {"d_difference_sign", "ARG0 lacks its minus sign",
       "borglab/gtsam pull 1938 (derivatives near the identity)", op::d_difference_arg0,
       [](const V7& a, const V7& b) -> M6 { return -good()[op::d_difference_arg0](a, b); }},
      {"d_difference_left", "ARG1 is J_l^-1 instead of J_r^-1", "artivis/manif pull 22",
       op::d_difference_arg1,
       [](const V7& a, const V7& b) -> M6 { return -good()[op::d_difference_arg0](a, b); }},
      {"coefficient_world", "Q_dot = (w, 0) Q / 2: the angular velocity is taken in world axes",
       "robotology-legacy/mex-wholebodymodel issue 30",
       changed<op::integrate_coefficient_jacobian>([](M76& J, const V7& q) {
         const M3 K = hat(V3(q.template segment<3>(3))) / S(2);
         J.template block<3, 3>(3, 3) -= S(2) * K;
       })},
      {"coefficient_not_halved", "Q_dot lacks its factor 1/2", "betaflight/betaflight pull 5182",
       changed<op::integrate_coefficient_jacobian>(
           [](M76& J, const V7&) { J.template bottomRightCorner<4, 3>() *= S(2); })},
  };
}

template <class S>
auto Bugs<S>::robots() -> Entries {
  return {
      {"robot_idx_v", "joints after the base read their increment one index too early",
       "erdc/proteus pull 911",
       [](O& o) {
         o.robot = [](const std::string& urdf, bool fixed) {
           RobotOperations<S> r = good().robot(urdf, fixed);
           r[op::robot_integrate] = [inner = r[op::robot_integrate]](const VecX<S>& q,
                                                                     const VecX<S>& d) -> VecX<S> {
             VecX<S> shifted = d;
             for (Eigen::Index i = 6; i + 1 < d.size(); ++i) shifted[i + 1] = d[i];
             return inner(q, shifted);
           };
           return r;
         };
       }},
      {"robot_same_by_coefficients", "Q and -Q are different configurations", "moble/quaternion pull 150",
       [](O& o) {
         o.robot = [](const std::string& urdf, bool fixed) {
           RobotOperations<S> r = good().robot(urdf, fixed);
           r[op::robot_is_same] = [](const VecX<S>& a, const VecX<S>& b) { return a == b; };
           return r;
         };
       }},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties
