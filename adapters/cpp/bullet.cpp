// Bullet: LinearMath, in double if BT_USE_DOUBLE_PRECISION is defined, and in float otherwise.

#include <LinearMath/btSpatialAlgebra.h>
#include <LinearMath/btTransform.h>
#include <LinearMath/btTransformUtil.h>

#include <liecheck_adapter.hpp>

#include "bullet_math.hpp"

namespace {

struct Library {
  using Scalar = btScalar;
  using Vector = btVector3;
  using Quaternion = btQuaternion;
  using Matrix = btMatrix3x3;
  using Transform = btTransform;

  static btQuaternion quaternion_of(btScalar roll, btScalar pitch, btScalar yaw) {
    btQuaternion q;
    q.setEulerZYX(yaw, pitch, roll);
    return q;
  }
  static btMatrix3x3 matrix_of(btScalar roll, btScalar pitch, btScalar yaw) {
    btMatrix3x3 R;
    R.setEulerZYX(roll, pitch, yaw);
    return R;
  }
  static void angles_of(const btMatrix3x3& R, btScalar& roll, btScalar& pitch, btScalar& yaw) {
    R.getEulerZYX(yaw, pitch, roll);
  }
};

static_assert(BT_BULLET_VERSION == 324);

struct Bullet : BulletMath<Library> {
#ifdef BT_USE_DOUBLE_PRECISION
  static constexpr const char* name = "bullet";
#else
  static constexpr const char* name = "bullet_float";
#endif
  static constexpr const char* version = "3.24";

  // The angular velocity that turns the identity to Q in unit time.
  static void log3_quaternion(In<S, 4> Q, Out<S, 3> phi) {
    const btVector3 p(0, 0, 0);
    btVector3 u, w;
    btTransformUtil::calculateVelocityQuaternion(p, p, btQuaternion::getIdentity(), quaternion(&Q[0]), 1, u,
                                                 w);
    put(w, &phi[0]);
  }
  /// By a quaternion: btTransformUtil's difference of two matrices may be longer than pi.
  static void log3_matrix(In<S, 9> R, Out<S, 3> phi) {
    btQuaternion q;
    matrix(&R[0]).getRotation(q);
    std::array<S, 4> Q;
    put(q, Q.data());
    log3_quaternion(Q, phi);
  }

  static void euler_from_quaternion(In<S, 5> x, Out<S, 3> y) {
    S roll, pitch, yaw;
    quaternion(&x[1]).getEulerZYX(yaw, pitch, roll);
    put_roll_pitch_yaw<S>(x[0], in_range(roll), pitch, in_range(yaw), y);
  }

  // A spatial vector is (angular, linear) for motions and (force, moment) for forces. The translation of a
  // spatial transformation is that from the new origin to the old one, in the new axes: -p.
  static btSpatialTransformationMatrix transformation(const S* X) {
    return {matrix(X), -vector(X + 9)};
  }
  static btSpatialMotionVector motion(const S* V) {
    return {vector(V + 3), vector(V)};
  }
  static btSpatialForceVector force(const S* F) {
    return {vector(F + 3), vector(F)};
  }
  static void put_motion(const btSpatialMotionVector& V, S* to) {
    put(V.getLinear(), to), put(V.getAngular(), to + 3);
  }
  static void put_force(const btSpatialForceVector& F, S* to) {
    put(F.getLinear(), to), put(F.getAngular(), to + 3);
  }

  static void act_motion(In<S, 18> x, Out<S, 6> y) {
    put_motion(transformation(&x[0]) * motion(&x[12]), &y[0]);
  }
  static void act_force(In<S, 18> x, Out<S, 6> y) {
    put_force(transformation(&x[0]) * force(&x[12]), &y[0]);
  }
  static void act_inverse_motion(In<S, 18> x, Out<S, 6> y) {
    btSpatialMotionVector V;
    transformation(&x[0]).transformInverse(motion(&x[12]), V);
    put_motion(V, &y[0]);
  }
  static void act_inverse_force(In<S, 18> x, Out<S, 6> y) {
    btSpatialForceVector F;
    transformation(&x[0]).transformInverse(force(&x[12]), F);
    put_force(F, &y[0]);
  }
  static void cross_motion(In<S, 12> x, Out<S, 6> y) {
    put_motion(motion(&x[0]).cross(motion(&x[6])), &y[0]);
  }
  static void cross_force(In<S, 12> x, Out<S, 6> y) {
    put_force(motion(&x[0]).cross(force(&x[6])), &y[0]);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion",
         PROGRAM(
             "LinearMath/btTransformUtil.h",
             "btVector3 p(0, 0, 0), u, w; btQuaternion q({Q});\n"
             "btTransformUtil::calculateVelocityQuaternion(p, p, btQuaternion::getIdentity(), q, 1, u, w);",
             "w.x(), w.y(), w.z()")},
        {"log3_matrix",
         PROGRAM(
             "LinearMath/btTransformUtil.h",
             "btVector3 p(0, 0, 0), u, w; btQuaternion q; btMatrix3x3({R}).getRotation(q);\n"
             "btTransformUtil::calculateVelocityQuaternion(p, p, btQuaternion::getIdentity(), q, 1, u, w);",
             "w.x(), w.y(), w.z()")},
        {"exp3_quaternion", PROGRAM("LinearMath/btTransformUtil.h",
                                    "btVector3 v({phi}), n = v.isZero() ? btVector3(1, 0, 0) : v;\n"
                                    "btQuaternion q(n, v.length());",
                                    "q.x(), q.y(), q.z(), q.w()")},
        {"exp3_matrix",
         PROGRAM("LinearMath/btTransformUtil.h",
                 "btVector3 v({phi}), n = v.isZero() ? btVector3(1, 0, 0) : v;\n"
                 "btMatrix3x3 R(btQuaternion(n, v.length()));",
                 "R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2]")},
        {"quaternion_from_matrix",
         PROGRAM("LinearMath/btTransformUtil.h", "btQuaternion q; btMatrix3x3({R}).getRotation(q);",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"axis_angle_from_quaternion",
         PROGRAM("LinearMath/btTransformUtil.h", "btQuaternion q({Q}); btVector3 n = q.getAxis();",
                 "n.x(), n.y(), n.z(), q.getAngle()")},
        {"angle_between", PROGRAM("LinearMath/btTransformUtil.h", "btVector3 a({a}), b({b});", "a.angle(b)")},
        {"normalize", PROGRAM("LinearMath/btTransformUtil.h",
                              "btQuaternion q({Q});\n"
                              "q.normalize();",
                              "q.x(), q.y(), q.z(), q.w()")},
        {"relative_angle", PROGRAM("LinearMath/btTransformUtil.h", "btQuaternion q0({Q0}), q1({Q1});",
                                   "q0.angleShortestPath(q1)")},
        {"slerp",
         PROGRAM("LinearMath/btTransformUtil.h", "btQuaternion q0({Q0}), q1({Q1}), q = q0.slerp(q1, {t});",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"rotation_between", PROGRAM("LinearMath/btTransformUtil.h",
                                     "btQuaternion q = shortestArcQuat(btVector3({a}), btVector3({b}));",
                                     "q.x(), q.y(), q.z(), q.w()")},
        {"euler_from_quaternion",
         PROGRAM("LinearMath/btTransformUtil.h",
                 "btScalar yaw, pitch, roll; btQuaternion({Q}).getEulerZYX(yaw, pitch, roll);",
                 "std::remainder(roll, SIMD_2_PI), pitch, std::remainder(yaw, SIMD_2_PI)")},
        {"euler_from_matrix",
         PROGRAM("LinearMath/btTransformUtil.h",
                 "btScalar yaw, pitch, roll; btMatrix3x3({R}).getEulerZYX(yaw, pitch, roll);",
                 "roll, pitch, yaw")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Bullet, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, compose, inverse,
                 act_point, rotate_point, normalize, act_motion, act_force, act_inverse_motion,
                 act_inverse_force, cross_motion, cross_force, relative_angle, slerp, rotation_between,
                 euler_to_quaternion, euler_to_matrix, euler_from_quaternion, euler_from_matrix,
                 quaternion_from_matrix, matrix_from_quaternion, quaternion_product, quaternion_inverse,
                 axis_angle_from_quaternion, quaternion_from_axis_angle, angle_between)
