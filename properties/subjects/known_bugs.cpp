#include <subjects/known_bugs.hpp>
#include <subjects/tree_bugs.hpp>

#include <Eigen/Dense>
#include <cmath>

namespace liecheck::properties {
namespace {

template <class S>
struct Bugs {
  using O = Operations<S>;
  using V3 = typename O::V3;
  using V4 = typename O::V4;
  using V6 = typename O::V6;
  using V7 = typename O::V7;
  using M3 = typename O::M3;
  using M6 = typename O::M6;
  using M76 = Mat<S, 7, 6>;
  using B = Body<S>;
  using P = Pose<S>;

  static O& good() {
    static O operations;
    return operations;
  }

  static M3 hat(const V3& v) {
    M3 m;
    m << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
    return m;
  }
  static V3 top(const V6& v) { return v.template head<3>(); }
  static V3 low(const V6& v) { return v.template tail<3>(); }
  static V6 stack(const V3& a, const V3& b) {
    V6 v;
    v << a, b;
    return v;
  }
  static V4 multiply(const V4& a, const V4& b) {
    V4 q;
    q << a[3] * b.template head<3>() + b[3] * a.template head<3>() +
             V3(a.template head<3>()).cross(V3(b.template head<3>())),
        a[3] * b[3] - a.template head<3>().dot(b.template head<3>());
    return q;
  }
  static V4 conjugate(const V4& q) { return {-q[0], -q[1], -q[2], q[3]}; }
  static V4 rotation_of(const V7& q) { return q.template tail<4>(); }
  static V7 moved(const V7& q, const V3& p, const V4& Q) {
    V7 r;
    r << q.template head<3>() + p, Q;
    return r;
  }
  /// [[J, C], [0, J]] with another J.
  static M6 blocks(const M3& J, const M3& C) {
    M6 m = M6::Zero();
    m.template topLeftCorner<3, 3>() = m.template bottomRightCorner<3, 3>() = J;
    m.template topRightCorner<3, 3>() = C;
    return m;
  }
  static P pose_exp(const V6& xi, M3 V) { return {good().exp3_matrix(low(xi)), V * top(xi)}; }
  static S angle(const V3& phi) { return phi.norm(); }

  struct Entry {
    const char *name, *fault, *origin;
    void (*plant)(O&);
  };

  static const std::vector<Entry>& entries() {
    static const std::vector<Entry> all{
        // exp and log of rotations
        {"exp_zero_limit", "below 1e-7 the vector part of the quaternion is zero",
         "kornia/kornia-rs pull 535",
         [](O& o) {
           o.exp3_quaternion = [](const V3& phi) -> V4 {
             if (angle(phi) < S(1e-7)) return {S(0), S(0), S(0), S(1)};
             return good().exp3_quaternion(phi);
           };
         }},
        {"exp_series_sign", "the second term of the series of sin(theta/2)/theta has the wrong sign",
         "stack-of-tasks/pinocchio issue 1964 (a series term of so3 questioned, untested)",
         [](O& o) {
           o.exp3_quaternion = [](const V3& phi) -> V4 {
             const S t = angle(phi);
             if (t > S(1e-2)) return good().exp3_quaternion(phi);
             V4 q = good().exp3_quaternion(phi);
             q.template head<3>() = (S(1) / S(2) + t * t / S(48)) * phi;
             return q;
           };
         }},
        {"exp_angle_not_halved", "the quaternion of exp turns by twice the angle",
         "heliorc/imuf-release issue 9 (quaternion kinematics that degrade)",
         [](O& o) {
           o.exp3_quaternion = [](const V3& phi) -> V4 { return good().exp3_quaternion(S(2) * phi); };
         }},
        {"exp_float_constant", "2 pi is a float constant in the reduction of the angle",
         "fedassa/SHOT issue 8 (float constants in a double path)",
         [](O& o) {
           o.exp3_matrix = [](const V3& phi) -> M3 {
             const S t = angle(phi);
             if (t < S(3)) return good().exp3_matrix(phi);
             const S turn = S(6.2831855f);
             return good().exp3_matrix(V3(phi * ((t - turn * std::floor(t / turn)) / t)));
           };
           if (sizeof(S) == 4)
             o.exp3_matrix = [](const V3& phi) -> M3 { return good().exp3_matrix(V3(phi * S(1.00001f))); };
         }},
        {"exp_no_overflow_guard", "theta^2 overflows and gives NaN",
         "gazebosim/gz-math pull 620 (guards by theta^2)",
         [](O& o) {
           o.exp3_matrix = [](const V3& phi) -> M3 {
             const S x = phi.dot(phi), t = std::sqrt(x);
             const M3 K = hat(phi);
             if (x < S(1)) return good().exp3_matrix(phi);
             return M3::Identity() + std::sin(t) / t * K + (S(1) - std::cos(t)) / x * K * K;
           };
         }},
        {"exp_cancelling_cosine", "(1 - cos theta) / theta^2 down to theta = 1e-6",
         "gazebosim/gz-math pull 620",
         [](O& o) {
           o.exp3_matrix = [](const V3& phi) -> M3 {
             const S t = angle(phi);
             if (t < S(1e-6) || t > S(3)) return good().exp3_matrix(phi);
             const M3 K = hat(phi);
             return M3::Identity() + std::sin(t) / t * K + (S(1) - std::cos(t)) / (t * t) * K * K;
           };
         }},
        {"exp_nan_at_zero", "0/0 at exactly zero", "kornia/kornia-rs pull 535",
         [](O& o) {
           o.exp6 = [](const V6& xi) -> P {
             P T = good().exp6(xi);
             T.p += S(0) * top(xi) / angle(low(xi));
             return T;
           };
         }},
        {"log_acos_w", "2 acos(w), which is NaN where |Q| is an ulp above one",
         "Yellow-Dog-Man/Resonite-Issues issue 4728",
         [](O& o) {
           o.log3_quaternion = [](const V4& Q) -> V3 {
             const V4 q = Q[3] < S(0) ? V4(-Q) : Q;
             const S s = q.template head<3>().norm();
             if (s == S(0)) return V3::Zero();
             return S(2) * std::acos(q[3]) / s * q.template head<3>();
           };
         }},
        {"log_no_sign", "the angle of a quaternion with negative w is beyond pi",
         "borglab/SwiftFusion pull 111",
         [](O& o) {
           o.log3_quaternion = [](const V4& Q) -> V3 {
             const S s = Q.template head<3>().norm();
             if (s == S(0)) return V3::Zero();
             return S(2) * std::atan2(s, Q[3]) / s * Q.template head<3>();
           };
         }},
        {"log_acos_trace", "acos((tr R - 1) / 2), which cancels near zero and is NaN above one",
         "stack-of-tasks/pinocchio issue 2768",
         [](O& o) {
           o.log3_matrix = [](const M3& R) -> V3 {
             const S t = std::acos((R.trace() - S(1)) / S(2));
             const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
             return t > S(3) ? good().log3_matrix(R) : V3(t / (S(2) * std::sin(t)) * a);
           };
         }},
        {"log_acos_clamped", "the trace is clamped, so that every small rotation is none",
         "bdaiinstitute/spatialmath-python pull 86",
         [](O& o) {
           o.log3_matrix = [](const M3& R) -> V3 {
             const S t = std::acos(std::min(S(1), S((R.trace() - S(1)) / S(2))));
             const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
             if (t > S(3)) return good().log3_matrix(R);
             return t == S(0) ? V3(a / S(2)) : V3(t / (S(2) * std::sin(t)) * a);
           };
         }},
        {"log_pivot_near_pi", "the pivot near pi is 2 + 2 R_ii instead of 1 + 2 R_ii - tr R",
         "borglab/gtsam pull 2723",
         [](O& o) {
           o.log3_matrix = [](const M3& R) -> V3 {
             if (R.trace() > S(-0.9)) return good().log3_matrix(R);
             int i = 0;
             R.diagonal().maxCoeff(&i);
             const V3 axis = (R.col(i) + V3::Unit(i)) / std::sqrt(S(2) + S(2) * R(i, i));
             const V3 exact = good().log3_matrix(R);
             return exact.norm() * (axis.dot(exact) < S(0) ? S(-1) : S(1)) * axis;
           };
         }},
        {"log_half_turn_zero", "half a turn has the logarithm zero", "OliverWu515/ommpc_controller issue 5",
         [](O& o) {
           o.log3_matrix = [](const M3& R) -> V3 {
             const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
             return a.norm() < S(1e-6) ? V3(a / S(2)) : good().log3_matrix(R);
           };
         }},
        {"log_axis_sign_at_pi", "symmetric rotation matrices give NaN", "tussedrotten/pylie issue 6",
         [](O& o) {
           o.log3_matrix = [](const M3& R) -> V3 {
             const V3 a(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
             const V3 exact = good().log3_matrix(R);
             return R.trace() < S(0) ? V3(exact.norm() * a.normalized() / (a.norm() > S(0) ? S(1) : S(0)))
                                     : exact;
           };
         }},
        {"log_transposed", "the rotation is inverted: R^T for R", "tud-phi/ros2-mocap_optitrack pull 17",
         [](O& o) {
           o.log3_matrix = [](const M3& R) -> V3 { return good().log3_matrix(M3(R.transpose())); };
         }},
        // exp and log of poses
        {"exp6_no_V", "the translation is rho, not V rho", "gbionics/idyntree issue 561",
         [](O& o) { o.exp6 = [](const V6& xi) -> P {
                      return {good().exp6(xi).R, top(xi)};
                    }; }},
        {"exp6_shared_cutoff", "one cutoff 1e-4 for every coefficient, two terms below it",
         "pettni/smooth, one cutoff for every scalar",
         [](O& o) {
           o.exp6 = [](const V6& xi) -> P {
             const S t = angle(low(xi));
             const M3 K = hat(low(xi));
             if (t > S(3)) return good().exp6(xi);
             const S b = t < S(1e-4) ? S(1) / S(6) : (t - std::sin(t)) / (t * t * t);
             const S a = t < S(1e-4) ? S(1) / S(2) : (S(1) - std::cos(t)) / (t * t);
             return pose_exp(xi, M3::Identity() + a * K + b * K * K);
           };
         }},
        {"exp6_right_V", "the right Jacobian multiplies rho", "artivis/manif pull 22",
         [](O& o) {
           o.exp6 = [](const V6& xi) -> P { return pose_exp(xi, good().right_jacobian3(low(xi))); };
         }},
        {"exp6_angular_first", "the twist is taken angular part first", "rail-berkeley/hil-serl issue 36",
         [](O& o) { o.exp6 = [](const V6& xi) -> P { return good().exp6(stack(low(xi), top(xi))); }; }},
        {"log6_no_V_inverse", "the linear part of log is p", "gbionics/idyntree issue 561",
         [](O& o) { o.log6 = [](const P& T) -> V6 { return stack(T.p, good().log3_matrix(T.R)); }; }},
        {"log6_theta_divided", "V^-1 is divided by theta where it should be multiplied",
         "Le0nX/ModernRoboticsCpp issue 31",
         [](O& o) {
           o.log6 = [](const P& T) -> V6 {
             const V6 xi = good().log6(T);
             const S t = angle(low(xi));
             return t > S(0) ? stack(top(xi) / (t * t), low(xi)) : xi;
           };
         }},
        {"log6_series_coefficient", "V^-1 has 1/6 for 1/12 below 1e-3", "stack-of-tasks/pinocchio issue 1983",
         [](O& o) {
           o.log6 = [](const P& T) -> V6 {
             const V3 phi = good().log3_matrix(T.R);
             if (angle(phi) > S(1e-3)) return good().log6(T);
             const M3 K = hat(phi);
             return stack(T.p - K * T.p / S(2) + K * K * T.p / S(6), phi);
           };
         }},
        // Jacobians
        {"jacobian_left_for_right", "the right Jacobian is the left one", "artivis/manif pull 22",
         [](O& o) {
           o.right_jacobian3 = o.left_jacobian3;
           o.right_jacobian6 = o.left_jacobian6;
         }},
        {"jacobian6_no_coupling", "the coupling block is half of [rho]", "artivis/manif pull 22",
         [](O& o) {
           o.left_jacobian6 = [](const V6& xi) -> M6 {
             return blocks(good().left_jacobian3(low(xi)), hat(top(xi)) / S(2));
           };
         }},
        {"jacobian6_coupling_sign", "the last term of the coupling block has the wrong sign",
         "dqrobotics/matlab issue 62 (a sign in a pose Jacobian)",
         [](O& o) {
           o.left_jacobian6 = [](const V6& xi) -> M6 {
             M6 J = good().left_jacobian6(xi);
             const V3 phi = low(xi), rho = top(xi);
             const M3 K = hat(phi);
             J.template topRightCorner<3, 3>() += S(1) / S(60) * phi.dot(rho) * K * K * std::exp(-phi.norm());
             return J;
           };
         }},
        {"jacobian6_cancelling", "the coupling block's coefficients cancel between 1e-5 and 0.1",
         "RainerKuemmerle/g2o issue 221 (closed forms from 1e-5)",
         [](O& o) {
           o.right_jacobian6 = [](const V6& xi) -> M6 {
             const S t = angle(low(xi));
             M6 J = good().right_jacobian6(xi);
             if (t < S(1e-5) || t > S(0.1)) return J;
             const M3 K = hat(low(xi)), Q = hat(top(xi));
             const S c2 = (S(1) - std::cos(t)) / (t * t), c3 = (t - std::sin(t)) / (t * t * t);
             const S phi_rho = low(xi).dot(top(xi));
             const S a = (t * std::sin(t) - S(2) * (S(1) - std::cos(t))) / (t * t * t * t);
             const S b = (t * (S(1) - std::cos(t)) - S(3) * (t - std::sin(t))) / (t * t * t * t * t);
             J.template topRightCorner<3, 3>() =
                 -c2 * Q + c3 * (K * Q + Q * K) - phi_rho * a * K + phi_rho * b * K * K;
             return J;
           };
         }},
        {"inverse_jacobian_coefficient", "1/10 for 1/12 below 1e-2", "stack-of-tasks/pinocchio issue 1964",
         [](O& o) {
           o.left_jacobian3_inverse = [](const V3& phi) -> M3 {
             const M3 K = hat(phi);
             if (angle(phi) > S(1e-2)) return good().left_jacobian3_inverse(phi);
             return M3::Identity() - K / S(2) + K * K / S(10);
           };
         }},
        {"inverse_jacobian_sign", "the first-order term of the inverse has the wrong sign",
         "artivis/manif pull 22",
         [](O& o) {
           o.right_jacobian6_inverse = [](const V6& xi) -> M6 { return good().left_jacobian6_inverse(xi); };
         }},
        // configurations
        {"integrate_w_first", "the increment's quaternion is read w x y z",
         "stack-of-tasks/pinocchio issue 16",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             const V4 e = good().exp3_quaternion(low(d));
             const V4 wrong(e[3], e[0], e[1], e[2]);
             return moved(q, good().rotate_point(rotation_of(q), good().exp6(d).p),
                          multiply(rotation_of(q), wrong));
           };
         }},
        {"integrate_left", "the increment multiplies on the left", "RobotLocomotion/drake issue 1129",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             V7 r = good().integrate(q, d);
             r.template tail<4>() = multiply(good().exp3_quaternion(low(d)), rotation_of(q));
             return r;
           };
         }},
        {"integrate_world_velocity", "the linear increment is taken in world axes",
         "ethz-asl/ros_vrpn_client pull 41",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             V7 r = good().integrate(q, d);
             r.template head<3>() = q.template head<3>() + good().exp6(d).p;
             return r;
           };
         }},
        {"integrate_euler", "p + R rho: the arc is a straight line",
         "robotology-legacy/mex-wholebodymodel issue 30 (velocities of the base)",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             V7 r = good().integrate(q, d);
             r.template head<3>() = q.template head<3>() + good().rotate_point(rotation_of(q), top(d));
             return r;
           };
         }},
        {"integrate_no_normalization", "the product of quaternions keeps the defect of its factors",
         "collabora/libsurvive pull 79",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             V7 r = good().integrate(q, d);
             const S n = rotation_of(q).norm();
             r.template tail<4>() *= n * n * n * n;
             return r;
           };
         }},
        {"integrate_no_sign_flip", "the quaternion jumps to its opposite where w of the product is negative",
         "DOI-USGS/ale issue 603",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             V7 r = good().integrate(q, d);
             if (r[6] < S(0)) r.template tail<4>() *= S(-1);
             return r;
           };
         }},
        {"integrate_stale", "the pose of the call before is returned for small increments",
         "loco-3d/crocoddyl issue 363 (data of the SE3 residual not updated)",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             thread_local V4 stale = V4::Unit(3);
             V7 r = good().integrate(q, d);
             if (angle(low(d)) > S(0.1))
               stale = good().exp3_quaternion(low(d));
             else if (angle(low(d)) > S(1e-3))
               r.template tail<4>() = multiply(rotation_of(q), stale);
             return r;
           };
         }},
        {"difference_world", "the relative translation stays in world axes", "loco-3d/crocoddyl issue 330",
         [](O& o) {
           o.difference = [](const V7& a, const V7& b) -> V6 {
             V7 origin = a;
             origin.template head<3>().setZero();
             V7 other = b;
             other.template head<3>() = good().rotate_point(rotation_of(a), V3((b - a).template head<3>()));
             return good().difference(origin, other);
           };
         }},
        {"difference_order", "from q1 to q0", "naver/roma issue 3",
         [](O& o) { o.difference = [](const V7& a, const V7& b) -> V6 { return good().difference(b, a); }; }},
        {"difference_naive", "log(Q0* Q1) without care for near poses: relative error 1 at 1e-16",
         "stack-of-tasks/pinocchio issue 1964",
         [](O& o) {
           o.difference = [](const V7& a, const V7& b) -> V6 {
             V6 v = good().difference(a, b);
             v.template tail<3>() =
                 good().log3_quaternion(multiply(conjugate(rotation_of(a)), rotation_of(b)));
             return v;
           };
         }},
        {"difference_double_cover", "Q and -Q are a whole turn apart", "bdero/flutter_scene pull 275",
         [](O& o) {
           o.difference = [](const V7& a, const V7& b) -> V6 {
             V6 v = good().difference(a, b);
             const S t = angle(low(v));
             if (rotation_of(a).dot(rotation_of(b)) < S(0) && t > S(0))
               v.template tail<3>() *= (t - S(6.283185307179586)) / t;
             return v;
           };
         }},
        {"first_order_on_input", "first-order normalization of both inputs, which need not be near one",
         "RobotLocomotion/drake issue 14800",
         [](O& o) {
           o.difference = [](const V7& a, const V7& b) -> V6 {
             const auto once = [](V7 q) {
               q.template tail<4>() *= (S(2.999) - rotation_of(q).squaredNorm()) / S(2);
               q.template head<3>() *= rotation_of(q).norm();
               return q;
             };
             return good().difference(once(a), once(b));
           };
         }},
        {"d_integrate_adjoint", "ARG0 is Ad(exp(d)), its inverse missing", "colmap/colmap pull 3155",
         [](O& o) {
           o.d_integrate_arg0 = [](const V7& q, const V6& d) -> M6 {
             return good().d_integrate_arg0(q, V6(-d));
           };
         }},
        {"d_integrate_transposed", "ARG0 is transposed", "pypose/pypose pull 2",
         [](O& o) {
           o.d_integrate_arg0 = [](const V7& q, const V6& d) -> M6 {
             return good().d_integrate_arg0(q, d).transpose();
           };
         }},
        {"d_difference_sign", "ARG0 lacks its minus",
         "borglab/gtsam pull 1938 (derivatives near the identity)",
         [](O& o) {
           o.d_difference_arg0 = [](const V7& a, const V7& b) -> M6 {
             return -good().d_difference_arg0(a, b);
           };
         }},
        {"d_difference_left", "ARG1 is J_l^-1", "artivis/manif pull 22",
         [](O& o) {
           o.d_difference_arg1 = [](const V7& a, const V7& b) -> M6 {
             return -good().d_difference_arg0(a, b);
           };
         }},
        {"coefficient_world", "Q_dot = (w, 0) Q / 2: the angular velocity is taken in world axes",
         "robotology-legacy/mex-wholebodymodel issue 30",
         [](O& o) {
           o.integrate_coefficient_jacobian = [](const V7& q) -> M76 {
             M76 J = good().integrate_coefficient_jacobian(q);
             const M3 K = hat(V3(q.template segment<3>(3))) / S(2);
             J.template block<3, 3>(3, 3) -= S(2) * K;
             return J;
           };
         }},
        {"coefficient_not_halved", "Q_dot lacks its 1/2", "betaflight/betaflight pull 5182",
         [](O& o) {
           o.integrate_coefficient_jacobian = [](const V7& q) -> M76 {
             M76 J = good().integrate_coefficient_jacobian(q);
             J.template bottomRightCorner<4, 3>() *= S(2);
             return J;
           };
         }},
        {"robot_idx_v", "joints behind the base read their increment one place too early",
         "erdc/proteus pull 911",
         [](O& o) {
           o.robot = [](const std::string& urdf, bool fixed) {
             RobotOperations<S> r = good().robot(urdf, fixed);
             r.integrate = [inner = r.integrate](const VecX<S>& q, const VecX<S>& d) -> VecX<S> {
               VecX<S> shifted = d;
               for (Eigen::Index i = 6; i + 1 < d.size(); ++i) shifted[i + 1] = d[i];
               return inner(q, shifted);
             };
             return r;
           };
         }},
        {"robot_same_by_coefficients", "Q and -Q are two configurations", "moble/quaternion pull 150",
         [](O& o) {
           o.robot = [](const std::string& urdf, bool fixed) {
             RobotOperations<S> r = good().robot(urdf, fixed);
             r.is_same = [](const VecX<S>& a, const VecX<S>& b) { return a == b; };
             return r;
           };
         }},
        // spatial algebra
        {"rotate_unnormalized", "Q x Q* without 1 / |Q|^2", "Mayitzin/ahrs issue 96",
         [](O& o) {
           o.rotate_point = [](const V4& Q, const V3& x) -> V3 {
             return Q.squaredNorm() * Q.squaredNorm() * good().rotate_point(Q, x);
           };
         }},
        {"rotate_conjugate", "the inverse rotation", "Guo-ziwei/fusion pull 2",
         [](O& o) {
           o.rotate_point = [](const V4& Q, const V3& x) -> V3 {
             return good().rotate_point(conjugate(Q), x);
           };
         }},
        {"force_as_motion", "forces are transformed as motions", "bdaiinstitute/spatialmath-python pull 207",
         [](O& o) { o.act_force = [](const P& X, const V6& F) -> V6 { return good().act_motion(X, F); }; }},
        {"force_transposed", "forces by Ad^T for Ad^-T", "bdaiinstitute/spatialmath-python pull 207",
         [](O& o) { o.act_force = o.act_inverse_force; }},
        {"adjoint_block", "the coupling block of Ad is below: the angular-first matrix",
         "rail-berkeley/hil-serl issue 36",
         [](O& o) {
           o.act_motion = [](const P& X, const V6& V) -> V6 {
             const V3 u = X.R * top(V);
             return stack(u, X.R * low(V) + X.p.cross(u));
           };
         }},
        {"cross_dual_sign", "the force cross product lacks its minus transpose",
         "UMich-CURLY-teaching/UMich-ROB-530-public issue 2",
         [](O& o) {
           o.cross_force = [](const V6& V, const V6& F) -> V6 { return -good().cross_force(V, F); };
         }},
        {"cross_half", "u x w_W is missing in the motion cross product", "pvangoor/pylie pull 1",
         [](O& o) {
           o.cross_motion = [](const V6& V, const V6& W) -> V6 {
             return stack(low(V).cross(top(W)), low(V).cross(low(W)));
           };
         }},
        {"inertia_not_rotated", "a moved body keeps the axes of its inertia",
         "erwincoumans/tiny-differentiable-simulator pull 102",
         [](O& o) {
           o.act_inertia = [](const P& X, const B& I) -> B { return {I.mass, X.R * I.c + X.p, I.I_C}; };
         }},
        {"inertia_rotated_back", "R^T I R for R I R^T", "Rhoban/onshape-to-robot issue 85",
         [](O& o) {
           o.act_inertia = [](const P& X, const B& I) -> B {
             return {I.mass, X.R * I.c + X.p, X.R.transpose() * I.I_C * X.R};
           };
         }},
        {"inertia_shift_com", "the shift is applied before the centre of mass is rotated",
         "simbody/simbody issue 334",
         [](O& o) {
           o.act_inertia = [](const P& X, const B& I) -> B {
             B b = good().act_inertia(X, I);
             b.c = X.R * (I.c + X.p);
             return b;
           };
         }},
        {"parallel_axis_sign", "the parallel-axis term has the wrong sign", "dimforge/parry pull 334",
         [](O& o) {
           o.inertia_matrix = [](const B& I) -> M6 {
             M6 M = good().inertia_matrix(I);
             const M3 C = hat(I.c);
             M.template bottomRightCorner<3, 3>() = I.I_C + I.mass * (C * C);
             return M;
           };
         }},
        {"parallel_axis_doubled", "the parallel-axis term is added twice",
         "ros/solidworks_urdf_exporter issue 117",
         [](O& o) {
           o.inertia_matrix = [](const B& I) -> M6 {
             M6 M = good().inertia_matrix(I);
             const M3 C = hat(I.c);
             M.template bottomRightCorner<3, 3>() -= I.mass * (C * C);
             return M;
           };
         }},
        {"momentum_diagonal", "only the diagonal of the inertia enters", "avianphysics/avian pull 745",
         [](O& o) {
           o.momentum = [](const B& I, const V6& V) -> V6 {
             B diagonal = I;
             diagonal.I_C = I.I_C.diagonal().asDiagonal();
             return good().momentum(diagonal, V);
           };
         }},
        {"energy_origin", "the inertia about the centre of mass is used with the velocity of the origin",
         "utiasSTARS/pyb-sim-models pull 4",
         [](O& o) {
           o.kinetic_energy = [](const B& I, const V6& V) -> S {
             return (I.mass * top(V).squaredNorm() + low(V).dot(I.I_C * low(V))) / S(2);
           };
         }},
    };
    return all;
  }

  using L = long double;
  using L3 = Eigen::Matrix<L, 3, 1>;
  using LM = Eigen::Matrix<L, 3, 3>;
  static L3 wide(const V3& v) { return v.template cast<L>(); }
  static V3 narrow(const L3& v) { return v.template cast<S>(); }
  static LM wide_hat(const L3& v) {
    LM m;
    m << L(0), -v.z(), v.y(), v.z(), L(0), -v.x(), -v.y(), v.x(), L(0);
    return m;
  }

  /// Correct ones: another operation order, another sign where the contract leaves it free, long double inside,
  /// another formula.
  static const std::vector<Entry>& alikes() {
    static const std::vector<Entry> all{
        {"exp_minus_Q", "exp returns -Q", "Q and -Q are one rotation",
         [](O& o) { o.exp3_quaternion = [](const V3& phi) -> V4 { return -good().exp3_quaternion(phi); }; }},
        {"exp_long_double", "sine and cosine of the half angle in long double", "another formula",
         [](O& o) {
           o.exp3_quaternion = [](const V3& phi) -> V4 {
             const L3 v = wide(phi);
             const L t = v.stableNorm(), s = t > 0 ? std::sin(t / 2) / t : L(0.5);
             V4 q;
             q << narrow(s * v), S(std::cos(t / 2));
             return q;
           };
         }},
        {"log_long_double", "2 atan2(|v|, w) in long double", "another formula",
         [](O& o) {
           o.log3_quaternion = [](const V4& Q) -> V3 {
             const L3 v = wide(Q.template head<3>());
             const L w = L(Q[3]), s = v.stableNorm();
             if (s == 0) return V3::Zero();
             const L t = w < 0 ? -2 * std::atan2(s, -w) : 2 * std::atan2(s, w);
             return narrow(t / s * v);
           };
         }},
        {"log_other_half_turn", "at exactly half a turn the opposite axis", "either sign is right there",
         [](O& o) {
           o.log3_quaternion = [](const V4& Q) -> V3 {
             const V3 phi = good().log3_quaternion(Q);
             return Q[3] == S(0) ? V3(-phi) : phi;
           };
         }},
        {"right_jacobian_transposed", "the right Jacobian of SO(3) is the transpose of the left one",
         "an identity",
         [](O& o) {
           o.right_jacobian3 = [](const V3& phi) -> M3 { return good().left_jacobian3(phi).transpose(); };
         }},
        {"left_jacobian_of_minus", "the left Jacobian is the right one at -xi", "an identity",
         [](O& o) { o.left_jacobian6 = [](const V6& xi) -> M6 { return good().right_jacobian6(V6(-xi)); }; }},
        {"d_difference_by_log", "J_r^-1 of difference", "the definition",
         [](O& o) {
           o.d_difference_arg1 = [](const V7& a, const V7& b) -> M6 {
             return good().right_jacobian6_inverse(good().difference(a, b));
           };
         }},
        {"integrate_sign_by_dot", "the sign of Q1 by its dot product with Q0", "another way to the same sign",
         [](O& o) {
           o.integrate = [](const V7& q, const V6& d) -> V7 {
             V7 r = good().integrate(q, d);
             if (r.template tail<4>().dot(rotation_of(q)) < S(0)) r.template tail<4>() *= S(-1);
             return r;
           };
         }},
        {"rotate_long_double", "by the rotation matrix, in long double", "another formula",
         [](O& o) {
           o.rotate_point = [](const V4& Q, const V3& x) -> V3 {
             const L3 v = wide(Q.template head<3>()), y = wide(x), vx = v.cross(y);
             const L w = L(Q[3]), n = v.squaredNorm() + w * w;
             return narrow(y + 2 / n * (w * vx + v.cross(vx)));
           };
         }},
        {"motion_long_double", "Ad V in long double", "another precision",
         [](O& o) {
           o.act_motion = [](const P& X, const V6& V) -> V6 {
             const LM R = X.R.template cast<L>();
             const L3 w = R * wide(low(V));
             return stack(narrow(R * wide(top(V)) + wide(X.p).cross(w)), narrow(w));
           };
         }},
        {"force_by_matrix", "n_A = R n + [p] (R f) as a matrix product", "another operation order",
         [](O& o) {
           o.act_force = [](const P& X, const V6& F) -> V6 {
             const LM R = X.R.template cast<L>();
             const L3 f = R * wide(top(F));
             return stack(narrow(f), narrow(R * wide(low(F)) + wide_hat(wide(X.p)) * f));
           };
         }},
        {"inertia_other_order", "R (I R^T) for (R I) R^T", "another operation order",
         [](O& o) {
           o.act_inertia = [](const P& X, const B& I) -> B {
             B b = good().act_inertia(X, I);
             const LM R = X.R.template cast<L>(), M = R * (I.I_C.template cast<L>() * R.transpose());
             b.I_C = M.template cast<S>();
             return b;
           };
         }},
        {"energy_by_momentum", "V . h / 2 in long double", "another route",
         [](O& o) {
           o.kinetic_energy = [](const B& I, const V6& V) -> S {
             const L3 u = wide(top(V)), w = wide(low(V)), c = wide(I.c), u_C = u + w.cross(c);
             const LM M = I.I_C.template cast<L>();
             return S((L(I.mass) * u_C.dot(u_C) + w.dot(M * w)) / 2);
           };
         }},
    };
    return all;
  }
};

}  // namespace

template <class S>
std::vector<Subject<S>> known_bugs(const Operations<S>& good) {
  Bugs<S>::good() = good;
  std::vector<Subject<S>> all;
  for (const auto& entry : Bugs<S>::entries()) {
    all.push_back({std::string("bug:") + entry.name, "a known bug", good, {}});
    all.back().operations.tree = nullptr;  // the same as without the bug
    entry.plant(all.back().operations);
  }
  for (const auto& entry : tree_bugs<S>()) {
    all.push_back({std::string("bug:") + entry.name, "a known bug", {}, {}});
    all.back().operations.tree = entry.tree;
  }
  for (const auto& entry : Bugs<S>::alikes()) {
    all.push_back({std::string("alike:") + entry.name, "a look-alike", good, {}});
    all.back().operations.tree = nullptr;
    entry.plant(all.back().operations);
  }
  return all;
}

const std::vector<KnownBug>& known_bug_table() {
  static const std::vector<KnownBug> table = [] {
    std::vector<KnownBug> all;
    for (const auto& e : Bugs<double>::entries())
      all.push_back({std::string("bug:") + e.name, e.fault, e.origin});
    for (const auto& e : tree_bugs<double>())
      all.push_back({std::string("bug:") + e.name, e.fault, e.origin});
    for (const auto& e : Bugs<double>::alikes())
      all.push_back({std::string("alike:") + e.name, e.fault, e.origin});
    return all;
  }();
  return table;
}

template std::vector<Subject<float>> known_bugs(const Operations<float>&);
template std::vector<Subject<double>> known_bugs(const Operations<double>&);

}  // namespace liecheck::properties
