// MuJoCo: engine_util_spatial, in double. Quaternions are w, x, y, z, motions (angular, linear), forces
// (moment, force). MuJoCo integrates a free joint as p + u and Q exp(omega), which is not the exponential of
// SE(3), so that integrate and difference are not offered.

#include <mujoco/mujoco.h>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

using Four = std::array<double, 4>;
using Six = std::array<double, 6>;

Four w_first(const double* Q) {
  return {Q[3], Q[0], Q[1], Q[2]};
}
void put(const Four& q, double* to) {
  to[0] = q[1], to[1] = q[2], to[2] = q[3], to[3] = q[0];
}

/// The identity, integrated for unit time with the velocity phi.
Four exp(const double* phi) {
  Four q = {1, 0, 0, 0};
  mju_quatIntegrate(q.data(), phi, 1);
  return q;
}

/// From the frame A to the frame B, whose origin is p and whose axes are R in A.
void transform_inverse(const double* X, const double* V, bool is_force, double* to) {
  const Six x = {V[3], V[4], V[5], V[0], V[1], V[2]};
  const double origin[3] = {0, 0, 0};
  Six y;
  mju_transformSpatial(y.data(), x.data(), is_force, X + 9, origin, X);
  std::copy_n(&y[3], 3, to), std::copy_n(&y[0], 3, to + 3);
}

struct MuJoCo {
  static constexpr const char* name = "mujoco";
  static inline const char* const version = mj_versionString();

  static void exp3_quaternion(In<double, 3> phi, Out<double, 4> Q) { put(exp(&phi[0]), &Q[0]); }
  static void exp3_matrix(In<double, 3> phi, Out<double, 9> R) { mju_quat2Mat(&R[0], exp(&phi[0]).data()); }
  static void log3_quaternion(In<double, 4> Q, Out<double, 3> phi) {
    mju_quat2Vel(&phi[0], w_first(&Q[0]).data(), 1);
  }
  static void log3_matrix(In<double, 9> R, Out<double, 3> phi) {
    Four q;
    mju_mat2Quat(q.data(), &R[0]);
    mju_quat2Vel(&phi[0], q.data(), 1);
  }
  static void rotate_point(In<double, 7> x, Out<double, 3> y) {
    mju_rotVecQuat(&y[0], &x[4], w_first(&x[0]).data());
  }
  static void normalize(In<double, 4> Q, Out<double, 4> y) {
    Four q = w_first(&Q[0]);
    mju_normalize4(q.data());
    put(q, &y[0]);
  }
  static void act_inverse_motion(In<double, 18> x, Out<double, 6> y) {
    transform_inverse(&x[0], &x[12], false, &y[0]);
  }
  static void act_inverse_force(In<double, 18> x, Out<double, 6> y) {
    // mju_transformSpatial takes a force as (moment, force), as it takes a motion as (angular, linear).
    transform_inverse(&x[0], &x[12], true, &y[0]);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion", PROGRAM("mujoco/mujoco.h",
                                    "double Q[] = {{Q}}, q[] = {Q[3], Q[0], Q[1], Q[2]}, v[3];\n"
                                    "mju_quat2Vel(v, q, 1);",
                                    "v[0], v[1], v[2]")},
        {"log3_matrix", PROGRAM("mujoco/mujoco.h",
                                "double R[] = {{R}}, q[4], v[3];\n"
                                "mju_mat2Quat(q, R); mju_quat2Vel(v, q, 1);",
                                "v[0], v[1], v[2]")},
        {"exp3_quaternion", PROGRAM("mujoco/mujoco.h",
                                    "double phi[] = {{phi}}, q[] = {1, 0, 0, 0};\n"
                                    "mju_quatIntegrate(q, phi, 1);",
                                    "q[1], q[2], q[3], q[0]")},
        {"exp3_matrix", PROGRAM("mujoco/mujoco.h",
                                "double phi[] = {{phi}}, q[] = {1, 0, 0, 0}, R[9];\n"
                                "mju_quatIntegrate(q, phi, 1); mju_quat2Mat(R, q);",
                                "R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]")},
        {"normalize", PROGRAM("mujoco/mujoco.h",
                              "double Q[] = {{Q}}, q[] = {Q[3], Q[0], Q[1], Q[2]};\n"
                              "mju_normalize4(q);",
                              "q[1], q[2], q[3], q[0]")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(MuJoCo, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, rotate_point, normalize,
                 act_inverse_motion, act_inverse_force)
