#include <bugs/weak_tests.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace liecheck::properties {
namespace {

using O = TypedOperations<double>;
using V3 = Vec<double, 3>;
using V4 = Vec<double, 4>;
using V6 = Vec<double, 6>;
using V7 = Vec<double, 7>;
using M3 = Mat<double, 3>;
using M6 = Mat<double, 6>;

M6 motion_matrix(const M3& R, const V3& p) {
  M6 X = M6::Zero();
  X.topLeftCorner<3, 3>() = X.bottomRightCorner<3, 3>() = R;
  X.topRightCorner<3, 3>() = hat(p) * R;
  return X;
}
/// A configuration (p, Q) or a twist (rho, phi).
template <class A, class B>
auto stacked(const A& a, const B& b) {
  Vec<double, int(A::RowsAtCompileTime) + int(B::RowsAtCompileTime)> v;
  v << a, b;
  return v;
}

/// Known values at a few angles about the axes, as in unit tests.
bool fixed_grid(const O& o) {
  bool killed = false;
  const auto differ = [](const auto& a, const auto& b) { return !((a - b).norm() <= 1e-9); };
  for (int axis = 0; axis < 3; ++axis)
    for (double angle : {0.0, M_PI / 6, M_PI / 4, M_PI / 2, 1.0, 3.0}) {
      const V3 n = V3::Unit(axis), phi = angle * n, p(1, 2, 3);
      const M3 R = Eigen::AngleAxisd(angle, n).toRotationMatrix();
      V4 Q = V4::Zero();
      Q << std::sin(angle / 2) * n, std::cos(angle / 2);
      killed |= differ(o[op::exp3_matrix](phi), R) || differ(o[op::exp3_quaternion](phi), Q);
      killed |= differ(o[op::log3_matrix](R), phi) || differ(o[op::log3_quaternion](Q), phi);
      killed |= differ(o[op::rotate_point](Q, p), R * p);
      const V6 xi = stacked(n, phi);  // a screw along its axis
      killed |= differ(o[op::exp6](xi).p, n) || differ(o[op::log6]({R, n}), xi);
      const V7 origin = stacked(V3::Zero(), V4::Unit(3));
      killed |= differ(o[op::integrate](origin, xi), stacked(n, Q));
      killed |= differ(o[op::difference](origin, stacked(n, Q)), xi);
      const V6 V = V6::LinSpaced(1, 6);
      killed |= differ(o[op::act_motion]({R, p}, V), motion_matrix(R, p) * V);
      killed |= differ(o[op::act_force]({R, p}, V), motion_matrix(R, p).transpose().inverse() * V);
    }
  return killed;
}

struct Sample {
  std::mt19937_64 random{1234};
  double number() { return std::uniform_real_distribution<double>(-1, 1)(random); }
  V3 vector() { return {number(), number(), number()}; }
  V4 quaternion() { return V4{number(), number(), number(), number()}.normalized(); }
  V6 small_twist() { return stacked(vector(), vector()); }  // |phi| < 1.8
};

/// Random poses compared with the textbook formulas, with the usual tolerance.
bool random_poses(const O& o) {
  Sample s;
  bool killed = false;
  const auto differ = [](const auto& a, const auto& b) { return !((a - b).norm() <= 1e-4); };
  for (int i = 0; i < 1000; ++i) {
    const V6 xi = s.small_twist(), V = s.small_twist(), F = s.small_twist();
    const V3 phi = xi.tail<3>(), x = s.vector();
    const double t = phi.norm();
    const M3 K = hat(phi), I = M3::Identity(), R = Eigen::AngleAxisd(t, phi / t).toRotationMatrix();
    const M3 J = I + (1 - std::cos(t)) / (t * t) * K + (t - std::sin(t)) / (t * t * t) * K * K;
    const V3 p = J * xi.head<3>();
    const Eigen::Quaterniond q(R);
    const V4 Q = q.coeffs(), Q0 = s.quaternion();
    const M3 R0 = Eigen::Quaterniond(Q0).toRotationMatrix();
    killed |= differ(o[op::exp3_matrix](phi), R) || differ(o[op::exp6](xi).p, p);
    killed |= differ(o[op::log3_matrix](R), phi) || differ(o[op::log3_quaternion](Q), phi);
    killed |= differ(o[op::log6]({R, p}), xi) || differ(o[op::left_jacobian3](phi), J);
    killed |= differ(o[op::right_jacobian3](phi), J.transpose());
    killed |= differ(o[op::left_jacobian3_inverse](phi), J.inverse());
    killed |= differ(o[op::rotate_point](Q0, x), R0 * x);
    const V7 next = o[op::integrate](stacked(x, Q0), xi);
    killed |= differ(next.head<3>(), x + R0 * p);
    killed |= differ(Eigen::Quaterniond(V4(next.tail<4>())).toRotationMatrix(), R0 * R);
    const M6 X = motion_matrix(R, x);
    killed |= differ(o[op::act_motion]({R, x}, V), X * V);
    killed |= differ(o[op::act_force]({R, x}, F), X.transpose().inverse() * F);
    const Body<double> body{2, x, I};
    M6 M = M6::Identity();
    M.topLeftCorner<3, 3>() = 2 * I, M.topRightCorner<3, 3>() = -2 * hat(x);
    M.bottomLeftCorner<3, 3>() = 2 * hat(x), M.bottomRightCorner<3, 3>() = I - 2 * hat(x) * hat(x);
    killed |= differ(o[op::inertia_matrix](body), M) || differ(o[op::momentum](body, V), M * V);
    killed |= !(std::fabs(o[op::kinetic_energy](body, V) - V.dot(M * V) / 2) <= 1e-4);
  }
  return killed;
}

bool round_trips(const O& o) {
  Sample s;
  bool killed = false;
  const auto differ = [](const auto& a, const auto& b) { return !((a - b).norm() <= 1e-9); };
  for (int i = 0; i < 1000; ++i) {
    const V6 xi = s.small_twist(), V = s.small_twist();
    const V3 phi = xi.tail<3>(), x = s.vector();
    const M3 I = M3::Identity();
    killed |= differ(o[op::log6](o[op::exp6](xi)), xi);
    killed |= differ(o[op::log3_matrix](o[op::exp3_matrix](phi)), phi);
    killed |= differ(o[op::log3_quaternion](o[op::exp3_quaternion](phi)), phi);
    const V7 q0 = stacked(x, s.quaternion());
    killed |= differ(o[op::difference](q0, o[op::integrate](q0, xi)), xi);
    killed |= differ(o[op::left_jacobian3](phi) * o[op::left_jacobian3_inverse](phi), I);
    killed |= differ(o[op::right_jacobian6](xi) * o[op::right_jacobian6_inverse](xi), M6::Identity());
    killed |= differ(o[op::left_jacobian6](xi) * o[op::left_jacobian6_inverse](xi), M6::Identity());
    const Pose<double> X{o[op::exp3_matrix](phi), x};
    killed |= differ(o[op::act_inverse_motion](X, o[op::act_motion](X, V)), V);
    killed |= differ(o[op::act_inverse_force](X, o[op::act_force](X, V)), V);
    const Body<double> body{2, x, V3(1, 1.5, 2).asDiagonal()};
    const auto back = o[op::act_inverse_inertia](X, o[op::act_inertia](X, body));
    killed |= differ(back.I_C, body.I_C) || differ(back.c, body.c);
  }
  return killed;
}

/// Jacobians compared with central differences in double, h = 1e-6.
bool finite_differences(const O& o) {
  Sample s;
  bool killed = false;
  constexpr double h = 1e-6;
  const auto differ = [](const auto& a, const auto& b) { return !((a - b).norm() <= 1e-5); };
  for (int i = 0; i < 200; ++i) {
    const V6 xi = s.small_twist();
    const V7 q0 = stacked(s.vector(), s.quaternion()), q1 = o[op::integrate](q0, xi);
    M6 right, arg0, difference0, difference1;
    Mat<double, 7, 6> rate;
    for (int k = 0; k < 6; ++k) {
      const V6 e = h * V6::Unit(k);
      const auto quotient = [&](const auto& plus, const auto& minus) {
        return ((plus - minus) / (2 * h)).eval();
      };
      right.col(k) = quotient(o[op::difference](q1, o[op::integrate](q0, V6(xi + e))),
                              o[op::difference](q1, o[op::integrate](q0, V6(xi - e))));
      arg0.col(k) = quotient(o[op::difference](q1, o[op::integrate](o[op::integrate](q0, e), xi)),
                             o[op::difference](q1, o[op::integrate](o[op::integrate](q0, V6(-e)), xi)));
      difference0.col(k) = quotient(o[op::difference](o[op::integrate](q0, e), q1),
                                    o[op::difference](o[op::integrate](q0, V6(-e)), q1));
      difference1.col(k) = quotient(o[op::difference](q0, o[op::integrate](q1, e)),
                                    o[op::difference](q0, o[op::integrate](q1, V6(-e))));
      rate.col(k) = quotient(o[op::integrate](q0, e), o[op::integrate](q0, V6(-e)));
    }
    killed |= differ(o[op::right_jacobian6](xi), right) || differ(o[op::d_integrate_arg1](q0, xi), right);
    killed |= differ(o[op::left_jacobian6](V6(-xi)), right);
    killed |= differ(o[op::right_jacobian3](xi.tail<3>()), right.bottomRightCorner<3, 3>());
    killed |= differ(o[op::d_integrate_arg0](q0, xi), arg0);
    killed |= differ(o[op::d_difference_arg0](q0, q1), difference0);
    killed |= differ(o[op::d_difference_arg1](q0, q1), difference1);
    killed |= differ(o[op::integrate_coefficient_jacobian](q0), rate);
  }
  return killed;
}

}  // namespace

const std::vector<WeakStyle>& weak_styles() {
  static const std::vector<WeakStyle> all{{"fixed grid", fixed_grid},
                                          {"random, 1e-4", random_poses},
                                          {"round trips", round_trips},
                                          {"FD in double", finite_differences}};
  return all;
}

}  // namespace liecheck::properties
