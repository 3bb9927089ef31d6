// Ignition Math: Quaternion, Matrix3 and Pose3, in double. A quaternion is (w, x, y, z). Log() and Exp() are those of
// quaternions.

#include <ignition/math/Matrix3.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/config.hh>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

using ignition::math::Matrix3d, ignition::math::Pose3d, ignition::math::Quaterniond, ignition::math::Vector3d;

Vector3d vector(const double* x) {
  return {x[0], x[1], x[2]};
}
Quaterniond quaternion(const double* Q) {
  return {Q[3], Q[0], Q[1], Q[2]};
}
void put(const Vector3d& x, double* to) {
  to[0] = x.X(), to[1] = x.Y(), to[2] = x.Z();
}
void put(const Quaterniond& Q, double* to) {
  to[0] = Q.X(), to[1] = Q.Y(), to[2] = Q.Z(), to[3] = Q.W();
}
Quaterniond exp(const double* phi) {
  return Quaterniond(0, phi[0] / 2, phi[1] / 2, phi[2] / 2).Exp();
}

struct Ignition {
  static constexpr const char *name = "ignition-math", *version = IGNITION_MATH_VERSION_FULL;

  static void exp3_quaternion(In<double, 3> phi, Out<double, 4> Q) { put(exp(&phi[0]), &Q[0]); }
  static void exp3_matrix(In<double, 3> phi, Out<double, 9> R) {
    const Matrix3d M(exp(&phi[0]));
    for (std::size_t i = 0; i < 9; ++i) R[i] = M(i / 3, i % 3);
  }
  static void log3_quaternion(In<double, 4> Q, Out<double, 3> phi) {
    const Quaterniond half = quaternion(nearer_to_one<double>(Q).data()).Log();
    put(Vector3d(2 * half.X(), 2 * half.Y(), 2 * half.Z()), &phi[0]);
  }
  static void log3_matrix(In<double, 9> R, Out<double, 3> phi) {
    std::array<double, 4> Q;
    put(Quaterniond(Matrix3d(R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8])), Q.data());
    log3_quaternion(Q, phi);
  }
  static void rotate_point(In<double, 7> x, Out<double, 3> y) {
    put(quaternion(&x[0]).RotateVector(vector(&x[4])), &y[0]);
  }
  static void normalize(In<double, 4> Q, Out<double, 4> y) { put(quaternion(&Q[0]).Normalized(), &y[0]); }

  static void slerp(In<double, 9> x, Out<double, 4> y) {
    put(Quaterniond::Slerp(x[8], quaternion(&x[0]), quaternion(&x[4]), true), &y[0]);
  }
  static void rotation_between(In<double, 6> x, Out<double, 4> y) {
    Quaterniond q;
    q.From2Axes(vector(&x[0]), vector(&x[3]));
    put(q, &y[0]);
  }
  static void euler_to_quaternion(In<double, 4> x, Out<double, 4> y) {
    const auto [roll, pitch, yaw] = roll_pitch_yaw<double>(x);
    put(Quaterniond(roll, pitch, yaw), &y[0]);
  }
  static void euler_from_quaternion(In<double, 5> x, Out<double, 3> y) {
    const Vector3d angles = quaternion(&x[1]).Euler();
    put_roll_pitch_yaw<double>(x[0], angles.X(), angles.Y(), angles.Z(), y);
  }

  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"exp3_quaternion",
         PROGRAM("ignition/math/Matrix3.hh",
                 "double p[] = {{phi}};\n"
                 "auto q = ignition::math::Quaterniond(0, p[0] / 2, p[1] / 2, p[2] / 2).Exp();",
                 "q.X(), q.Y(), q.Z(), q.W()")},
        {"exp3_matrix",
         PROGRAM("ignition/math/Matrix3.hh",
                 "double p[] = {{phi}};\n"
                 "ignition::math::Matrix3d R(ignition::math::Quaterniond(0, p[0] / 2, p[1] / 2, p[2] / "
                 "2).Exp());",
                 "R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)")},
        {"log3_quaternion",
         PROGRAM("ignition/math/Matrix3.hh",
                 "double Q[] = {{Q}}, s = Q[3] < 0 ? -1 : 1;\n"
                 "auto v = ignition::math::Quaterniond(s * Q[3], s * Q[0], s * Q[1], s * Q[2]).Log();",
                 "2 * v.X(), 2 * v.Y(), 2 * v.Z()")},
        {"log3_matrix", PROGRAM("ignition/math/Matrix3.hh",
                                "ignition::math::Quaterniond q(ignition::math::Matrix3d({R}));\n"
                                "auto v = (q.W() < 0 ? -q : q).Log();",
                                "2 * v.X(), 2 * v.Y(), 2 * v.Z()")},
        {"normalize", PROGRAM("ignition/math/Matrix3.hh",
                              "double Q[] = {{Q}};\n"
                              "auto q = ignition::math::Quaterniond(Q[3], Q[0], Q[1], Q[2]).Normalized();",
                              "q.X(), q.Y(), q.Z(), q.W()")},
        {"slerp", PROGRAM("ignition/math/Matrix3.hh",
                          "using Q = ignition::math::Quaterniond; double a[] = {{Q0}}, b[] = {{Q1}};\n"
                          "Q q0(a[3], a[0], a[1], a[2]), q1(b[3], b[0], b[1], b[2]);\n"
                          "Q q = Q::Slerp({t}, q0, q1, true);",
                          "q.X(), q.Y(), q.Z(), q.W()")},
        {"rotation_between",
         PROGRAM("ignition/math/Matrix3.hh",
                 "ignition::math::Quaterniond q; ignition::math::Vector3d a({a}), b({b});\n"
                 "q.From2Axes(a, b);",
                 "q.X(), q.Y(), q.Z(), q.W()")},
        {"euler_from_quaternion",
         PROGRAM("ignition/math/Matrix3.hh",
                 "double Q[] = {{Q}};\n"
                 "auto v = ignition::math::Quaterniond(Q[3], Q[0], Q[1], Q[2]).Euler();",
                 "v.X(), v.Y(), v.Z()")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Ignition, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, rotate_point,
                 normalize, slerp, rotation_between, euler_to_quaternion, euler_from_quaternion)
