// ODE: rotation.h and points of a body, in double (Debian's precision). Quaternions are w, x, y, z; a
// dMatrix3 has rows of four numbers. ODE has no logarithm and no product of poses.

#include <ode/ode.h>
#include <ode/version.h>

#include <liecheck_adapter.hpp>
#include <stdexcept>

#include "numbers.hpp"

namespace {

static_assert(sizeof(dReal) == sizeof(double));

struct Matrix {
  dMatrix3 R;
  explicit Matrix(const double* x) : R{x[0], x[1], x[2], 0, x[3], x[4], x[5], 0, x[6], x[7], x[8], 0} {}
};

void put_rotation(const dReal* R, double* to) {
  for (int i = 0; i < 3; ++i) std::copy_n(R + 4 * i, 3, to + 3 * i);
}

/// A body of a world of its own.
dBodyID body() {
  struct World {
    World() { dInitODE2(0), id = dWorldCreate(); }
    ~World() { dWorldDestroy(id), dCloseODE(); }
    dWorldID id;
  };
  static const World world;
  static const dBodyID only = dBodyCreate(world.id);
  return only;
}

/// dSafeNormalize4 says whether it could; dNormalize4 and dBodySetQuaternion abort where it could not.
void refuse_unless(int could) {
  if (!could) throw std::domain_error("ODE cannot normalize this quaternion");
}

struct Ode {
  static constexpr const char *name = "ode", *version = dODE_VERSION;

  static void exp3_quaternion(In<double, 3> phi, Out<double, 4> Q) {
    const auto n = axis_of<double>(phi);
    dQuaternion q;
    dQFromAxisAndAngle(q, n[0], n[1], n[2], angle_of<double>(phi));
    Q[0] = q[1], Q[1] = q[2], Q[2] = q[3], Q[3] = q[0];
  }
  static void exp3_matrix(In<double, 3> phi, Out<double, 9> y) {
    const auto n = axis_of<double>(phi);
    dMatrix3 R;
    dRFromAxisAndAngle(R, n[0], n[1], n[2], angle_of<double>(phi));
    put_rotation(R, &y[0]);
  }
  static void act_point(In<double, 15> x, Out<double, 3> y) {
    dBodySetPosition(body(), x[9], x[10], x[11]);
    dBodySetRotation(body(), Matrix(&x[0]).R);
    dVector3 result;
    dBodyGetRelPointPos(body(), x[12], x[13], x[14], result);
    std::copy_n(result, 3, &y[0]);
  }
  static void rotate_point(In<double, 7> x, Out<double, 3> y) {
    const dQuaternion q = {x[3], x[0], x[1], x[2]};
    dQuaternion n = {q[0], q[1], q[2], q[3]};
    refuse_unless(dSafeNormalize4(n));
    dBodySetQuaternion(body(), q);
    dVector3 result;
    dBodyVectorToWorld(body(), x[4], x[5], x[6], result);
    std::copy_n(result, 3, &y[0]);
  }
  static void normalize(In<double, 4> Q, Out<double, 4> y) {
    dQuaternion q = {Q[3], Q[0], Q[1], Q[2]};
    refuse_unless(dSafeNormalize4(q));
    y[0] = q[1], y[1] = q[2], y[2] = q[3], y[3] = q[0];
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"exp3_quaternion",
         PROGRAM("ode/ode.h",
                 "double v[] = {{phi}}, a = dCalcVectorLength3(v), x = v[0] || v[1] || v[2] ? v[0] : 1;\n"
                 "dQuaternion q; dQFromAxisAndAngle(q, x, v[1], v[2], a);",
                 "q[1], q[2], q[3], q[0]")},
        {"exp3_matrix",
         PROGRAM("ode/ode.h",
                 "double v[] = {{phi}}, a = dCalcVectorLength3(v), x = v[0] || v[1] || v[2] ? v[0] : 1;\n"
                 "dMatrix3 R; dRFromAxisAndAngle(R, x, v[1], v[2], a);",
                 "R[0], R[1], R[2], R[4], R[5], R[6], R[8], R[9], R[10]")},
        {"normalize", PROGRAM("ode/ode.h",
                              "double Q[] = {{Q}};\n"
                              "dQuaternion q = {Q[3], Q[0], Q[1], Q[2]}; dSafeNormalize4(q);",
                              "q[1], q[2], q[3], q[0]")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Ode, exp3_quaternion, exp3_matrix, act_point, rotate_point, normalize)
