// Orocos KDL: frames.hpp and its inertias. Twists and wrenches are linear first and at the origin of the
// frame, as liecheck's. KDL has no exponential of SE(3): its addDelta(Frame, Twist) moves the origin to p +
// rho. It keeps inertias about the origin, so that one about the centre of mass, of a moved body, is not
// asked for.

#include <kdl/config.h>
#include <kdl/articulatedbodyinertia.hpp>
#include <kdl/frames.hpp>
#include <kdl/rigidbodyinertia.hpp>
#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

using KDL::Frame, KDL::RigidBodyInertia, KDL::Rotation, KDL::RotationalInertia, KDL::Twist, KDL::Vector,
    KDL::Wrench;

Vector vector(const double* x) {
  return {x[0], x[1], x[2]};
}
Rotation rotation(const double* R) {
  return {R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]};
}
Frame frame(const double* X) {
  return {rotation(X), vector(X + 9)};
}
Twist twist(const double* V) {
  return {vector(V), vector(V + 3)};
}
Wrench wrench(const double* F) {
  return {vector(F), vector(F + 3)};
}
RigidBodyInertia inertia(const double* I) {
  return RigidBodyInertia(I[0], vector(I + 1), RotationalInertia(I[4], I[8], I[12], I[5], I[6], I[9]));
}

void put(const Vector& x, double* to) {
  std::copy_n(x.data, 3, to);
}
void put(const Rotation& R, double* to) {
  std::copy_n(R.data, 9, to);
}
void put(const Frame& X, double* to) {
  put(X.M, to), put(X.p, to + 9);
}
void put(const Twist& V, double* to) {
  put(V.vel, to), put(V.rot, to + 3);
}
void put(const Wrench& F, double* to) {
  put(F.force, to), put(F.torque, to + 3);
}

struct Kdl {
  static constexpr const char *name = "kdl", *version = KDL_VERSION_STRING;

  static void exp3_matrix(In<double, 3> phi, Out<double, 9> R) {
    put(addDelta(Rotation::Identity(), vector(&phi[0])), &R[0]);
  }
  static void exp3_quaternion(In<double, 3> phi, Out<double, 4> Q) {
    addDelta(Rotation::Identity(), vector(&phi[0])).GetQuaternion(Q[0], Q[1], Q[2], Q[3]);
  }
  static void log3_matrix(In<double, 9> R, Out<double, 3> phi) { put(rotation(&R[0]).GetRot(), &phi[0]); }
  static void log3_quaternion(In<double, 4> Q, Out<double, 3> phi) {
    put(Rotation::Quaternion(Q[0], Q[1], Q[2], Q[3]).GetRot(), &phi[0]);
  }
  static void rotate_point(In<double, 7> x, Out<double, 3> y) {
    put(Rotation::Quaternion(x[0], x[1], x[2], x[3]) * vector(&x[4]), &y[0]);
  }
  static void compose(In<double, 24> x, Out<double, 12> y) { put(frame(&x[0]) * frame(&x[12]), &y[0]); }
  static void inverse(In<double, 12> x, Out<double, 12> y) { put(frame(&x[0]).Inverse(), &y[0]); }
  static void act_point(In<double, 15> x, Out<double, 3> y) { put(frame(&x[0]) * vector(&x[12]), &y[0]); }
  static void act_motion(In<double, 18> x, Out<double, 6> y) { put(frame(&x[0]) * twist(&x[12]), &y[0]); }
  static void act_inverse_motion(In<double, 18> x, Out<double, 6> y) {
    put(frame(&x[0]).Inverse(twist(&x[12])), &y[0]);
  }
  static void act_force(In<double, 18> x, Out<double, 6> y) { put(frame(&x[0]) * wrench(&x[12]), &y[0]); }
  static void act_inverse_force(In<double, 18> x, Out<double, 6> y) {
    put(frame(&x[0]).Inverse(wrench(&x[12])), &y[0]);
  }
  static void cross_motion(In<double, 12> x, Out<double, 6> y) { put(twist(&x[0]) * twist(&x[6]), &y[0]); }
  static void cross_force(In<double, 12> x, Out<double, 6> y) { put(twist(&x[0]) * wrench(&x[6]), &y[0]); }
  static void momentum(In<double, 19> x, Out<double, 6> y) { put(inertia(&x[0]) * twist(&x[13]), &y[0]); }
  static void inertia_matrix(In<double, 13> x, Out<double, 36> y) {
    const KDL::ArticulatedBodyInertia I(inertia(&x[0]));  // f = M u + H^T omega, n = H u + I omega
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        y[6 * i + j] = I.M(i, j);
        y[6 * i + j + 3] = I.H(j, i);
        y[6 * i + j + 18] = I.H(i, j);
        y[6 * i + j + 21] = I.I(i, j);
      }
  }
  static void relative_angle(In<double, 8> x, Out<double, 1> y) {
    Vector axis;
    y[0] = (Rotation::Quaternion(x[0], x[1], x[2], x[3]).Inverse() *
            Rotation::Quaternion(x[4], x[5], x[6], x[7]))
               .GetRotAngle(axis);
  }
  static void quaternion_from_matrix(In<double, 9> R, Out<double, 4> Q) {
    rotation(&R[0]).GetQuaternion(Q[0], Q[1], Q[2], Q[3]);
  }
  static void matrix_from_quaternion(In<double, 4> Q, Out<double, 9> R) {
    put(Rotation::Quaternion(Q[0], Q[1], Q[2], Q[3]), &R[0]);
  }
  static void axis_angle_from_matrix(In<double, 9> R, Out<double, 4> y) {
    Vector axis;
    y[3] = rotation(&R[0]).GetRotAngle(axis);
    put(axis, &y[0]);
  }
  static void matrix_from_axis_angle(In<double, 4> x, Out<double, 9> R) {
    put(Rotation::Rot2(vector(&x[0]), x[3]), &R[0]);
  }
  static void euler_to_matrix(In<double, 4> x, Out<double, 9> y) {
    if (x[0] == 23) return put(Rotation::EulerZYZ(x[1], x[2], x[3]), &y[0]);  // Z Y Z with rotating axes
    const auto [roll, pitch, yaw] = roll_pitch_yaw<double>(x);
    put(Rotation::RPY(roll, pitch, yaw), &y[0]);
  }
  static void euler_from_matrix(In<double, 10> x, Out<double, 3> y) {
    if (x[0] == 23) return rotation(&x[1]).GetEulerZYZ(y[0], y[1], y[2]);
    double roll, pitch, yaw;
    rotation(&x[1]).GetRPY(roll, pitch, yaw);
    put_roll_pitch_yaw<double>(x[0], roll, pitch, yaw, y);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion",
         PROGRAM("kdl/frames.hpp", "KDL::Vector v = KDL::Rotation::Quaternion({Q}).GetRot();",
                 "v.x(), v.y(), v.z()")},
        {"log3_matrix",
         PROGRAM("kdl/frames.hpp", "KDL::Vector v = KDL::Rotation({R}).GetRot();", "v.x(), v.y(), v.z()")},
        {"exp3_quaternion",
         PROGRAM("kdl/frames.hpp",
                 "double x, y, z, w;\n"
                 "addDelta(KDL::Rotation::Identity(), KDL::Vector({phi})).GetQuaternion(x, y, z, w);",
                 "x, y, z, w")},
        {"exp3_matrix", PROGRAM("kdl/frames.hpp",
                                "KDL::Rotation R = addDelta(KDL::Rotation::Identity(), KDL::Vector({phi}));",
                                "R.data[0], R.data[1], R.data[2], R.data[3], R.data[4], R.data[5], "
                                "R.data[6], R.data[7], R.data[8]")},
        {"relative_angle", PROGRAM("kdl/frames.hpp",
                                   "auto Q = KDL::Rotation::Quaternion; KDL::Vector axis;\n"
                                   "double angle = (Q({Q0}).Inverse() * Q({Q1})).GetRotAngle(axis);",
                                   "angle")},
        {"quaternion_from_matrix",
         PROGRAM("kdl/frames.hpp", "double x, y, z, w; KDL::Rotation({R}).GetQuaternion(x, y, z, w);",
                 "x, y, z, w")},
        {"axis_angle_from_matrix",
         PROGRAM("kdl/frames.hpp", "KDL::Vector n; double angle = KDL::Rotation({R}).GetRotAngle(n);",
                 "n.x(), n.y(), n.z(), angle")},
        {"euler_from_matrix", PROGRAM("kdl/frames.hpp",
                                      "double a, b, c; KDL::Rotation R({R});\n"
                                      "if ({order} == 23) R.GetEulerZYZ(a, b, c); else R.GetRPY(a, b, c);",
                                      "a, b, c")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Kdl, exp3_matrix, exp3_quaternion, log3_matrix, log3_quaternion, rotate_point, compose,
                 inverse, act_point, act_motion, act_inverse_motion, act_force, act_inverse_force,
                 cross_motion, cross_force, momentum, inertia_matrix, relative_angle, euler_to_matrix,
                 euler_from_matrix, quaternion_from_matrix, matrix_from_quaternion, axis_angle_from_matrix,
                 matrix_from_axis_angle)
