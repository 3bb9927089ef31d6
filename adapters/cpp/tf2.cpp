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
                                    "if (q.w() < 0) q = -q; tf2::Vector3 v = q.getAxis() * q.getAngle();",
                                    "v.x(), v.y(), v.z()")},
        {"log3_matrix", PROGRAM("tf2/LinearMath/Transform.h",
                                "tf2::Quaternion q; tf2::Matrix3x3({R}).getRotation(q);\n"
                                "if (q.w() < 0) q = -q; tf2::Vector3 v = q.getAxis() * q.getAngle();",
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
        {"normalize", PROGRAM("tf2/LinearMath/Transform.h",
                              "tf2::Quaternion q({Q});\n"
                              "q.normalize();",
                              "q.x(), q.y(), q.z(), q.w()")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Tf2, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, compose, inverse, act_point,
                 rotate_point, normalize)
