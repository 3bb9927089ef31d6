// tf2: its LinearMath, in double.

#include <tf2/LinearMath/Transform.h>

#include <liecheck_adapter.hpp>

#include "bullet_math.hpp"

namespace {

struct Library {
  using Scalar = tf2Scalar;
  using Vector = tf2::Vector3;
  using Quaternion = tf2::Quaternion;
  using Matrix = tf2::Matrix3x3;
  using Transform = tf2::Transform;

  static tf2::Quaternion quaternion_of(tf2Scalar roll, tf2Scalar pitch, tf2Scalar yaw) {
    tf2::Quaternion q;
    q.setRPY(roll, pitch, yaw);
    return q;
  }
  static tf2::Matrix3x3 matrix_of(tf2Scalar roll, tf2Scalar pitch, tf2Scalar yaw) {
    tf2::Matrix3x3 R;
    R.setRPY(roll, pitch, yaw);
    return R;
  }
  static void angles_of(const tf2::Matrix3x3& R, tf2Scalar& roll, tf2Scalar& pitch, tf2Scalar& yaw) {
    R.getRPY(roll, pitch, yaw);
  }
};

struct Tf2 : BulletMath<Library> {
  static constexpr const char *name = "tf2", *version = TF2_VERSION;

  /// getAngle is up to 2 pi, and getAxis does not turn with getAngleShortestPath. For w >= 0 all agree.
  static void log(const S* Q, S* phi) { put(quaternion(Q).getAxis() * quaternion(Q).getAngle(), phi); }

  static void log3_quaternion(In<S, 4> Q, Out<S, 3> phi) { log(nearer_to_one<S>(Q).data(), &phi[0]); }
  static void log3_matrix(In<S, 9> R, Out<S, 3> phi) {
    tf2::Quaternion q;
    matrix(&R[0]).getRotation(q);
    std::array<S, 4> Q;
    put(q, Q.data());
    log3_quaternion(Q, phi);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion", PROGRAM("tf2/LinearMath/Transform.h",
                                    "tf2::Quaternion q({Q});\n"
                                    "if (q.w() < 0) q *= -1; tf2::Vector3 v = q.getAxis() * q.getAngle();",
                                    "v.x(), v.y(), v.z()")},
        {"log3_matrix", PROGRAM("tf2/LinearMath/Transform.h",
                                "tf2::Quaternion q; tf2::Matrix3x3({R}).getRotation(q);\n"
                                "if (q.w() < 0) q *= -1; tf2::Vector3 v = q.getAxis() * q.getAngle();",
                                "v.x(), v.y(), v.z()")},
        {"exp3_quaternion", PROGRAM("tf2/LinearMath/Transform.h",
                                    "tf2::Vector3 v({phi}), n = v.isZero() ? tf2::Vector3(1, 0, 0) : v;\n"
                                    "tf2::Quaternion q(n, v.length());",
                                    "q.x(), q.y(), q.z(), q.w()")},
        {"exp3_matrix",
         PROGRAM("tf2/LinearMath/Transform.h",
                 "tf2::Vector3 v({phi}), n = v.isZero() ? tf2::Vector3(1, 0, 0) : v;\n"
                 "tf2::Matrix3x3 R(tf2::Quaternion(n, v.length()));",
                 "R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2]")},
        {"quaternion_from_matrix",
         PROGRAM("tf2/LinearMath/Transform.h", "tf2::Quaternion q; tf2::Matrix3x3({R}).getRotation(q);",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"axis_angle_from_quaternion",
         PROGRAM("tf2/LinearMath/Transform.h", "tf2::Quaternion q({Q}); tf2::Vector3 n = q.getAxis();",
                 "n.x(), n.y(), n.z(), q.getAngle()")},
        {"angle_between",
         PROGRAM("tf2/LinearMath/Transform.h", "tf2::Vector3 a({a}), b({b});", "a.angle(b)")},
        {"normalize", PROGRAM("tf2/LinearMath/Transform.h",
                              "tf2::Quaternion q({Q});\n"
                              "q.normalize();",
                              "q.x(), q.y(), q.z(), q.w()")},
        {"relative_angle", PROGRAM("tf2/LinearMath/Transform.h", "tf2::Quaternion q0({Q0}), q1({Q1});",
                                   "q0.angleShortestPath(q1)")},
        {"slerp",
         PROGRAM("tf2/LinearMath/Transform.h", "tf2::Quaternion q0({Q0}), q1({Q1}), q = q0.slerp(q1, {t});",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"rotation_between",
         PROGRAM("tf2/LinearMath/Transform.h",
                 "tf2::Quaternion q = tf2::shortestArcQuat(tf2::Vector3({a}), tf2::Vector3({b}));",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"euler_from_matrix",
         PROGRAM("tf2/LinearMath/Transform.h",
                 "double roll, pitch, yaw; tf2::Matrix3x3({R}).getRPY(roll, pitch, yaw);",
                 "roll, pitch, yaw")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Tf2, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, compose, inverse, act_point,
                 rotate_point, normalize, relative_angle, slerp, rotation_between, euler_to_quaternion,
                 euler_to_matrix, euler_from_matrix, quaternion_from_matrix, matrix_from_quaternion,
                 quaternion_product, quaternion_inverse, axis_angle_from_quaternion,
                 quaternion_from_axis_angle, angle_between)
