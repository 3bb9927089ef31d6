// cglm, a library in C: quaternions and matrices in float. Quaternions are x, y, z, w, matrices column by column.

#include <cglm/cglm.h>
#include <cglm/version.h>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

#define TEXT_OF(x) #x
#define VERSION(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

namespace {

struct Quaternion {
  alignas(16) versor q;
  explicit Quaternion(const float* Q) { std::copy_n(Q, 4, q); }
  Quaternion() { glm_quat_identity(q); }
};
struct Pose {
  mat4 M;
  explicit Pose(const float* X) {
    glm_mat4_identity(M);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) M[j][i] = X[3 * i + j];
      M[3][i] = X[9 + i];
    }
  }
  Pose() { glm_mat4_identity(M); }
  void put(float* X) const {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) X[3 * i + j] = M[j][i];
      X[9 + i] = M[3][i];
    }
  }
};

struct Cglm {
  static constexpr const char *name = "cglm",
                              *version = VERSION(CGLM_VERSION_MAJOR, CGLM_VERSION_MINOR, CGLM_VERSION_PATCH);

  static void exp3_quaternion(In<float, 3> phi, Out<float, 4> Q) {
    vec3 v{phi[0], phi[1], phi[2]};
    Quaternion r;
    glm_quatv(r.q, glm_vec3_norm(v), v);
    std::copy_n(r.q, 4, Q.data());
  }
  // The angle is up to 2 pi: the rotation's is that of Q or -Q with w >= 0.
  static void log3_quaternion(In<float, 4> Q, Out<float, 3> phi) {
    Quaternion q(nearer_to_one<float>(Q).data());
    vec3 axis;
    glm_quat_axis(q.q, axis);
    const float angle = glm_quat_angle(q.q);
    for (std::size_t i = 0; i < 3; ++i) phi[i] = angle * axis[i];
  }
  static void compose(In<float, 24> x, Out<float, 12> y) {
    Pose X(&x[0]), Y(&x[12]), Z;
    glm_mat4_mul(X.M, Y.M, Z.M);
    Z.put(&y[0]);
  }
  static void inverse(In<float, 12> x, Out<float, 12> y) {
    Pose X(&x[0]);
    glm_inv_tr(X.M);
    X.put(&y[0]);
  }
  static void act_point(In<float, 15> x, Out<float, 3> y) {
    Pose X(&x[0]);
    vec3 p{x[12], x[13], x[14]}, to;
    glm_mat4_mulv3(X.M, p, 1, to);
    std::copy_n(to, 3, y.data());
  }
  static void rotate_point(In<float, 7> x, Out<float, 3> y) {
    Quaternion q(&x[0]);
    vec3 p{x[4], x[5], x[6]}, to;
    glm_quat_rotatev(q.q, p, to);
    std::copy_n(to, 3, y.data());
  }
  static void normalize(In<float, 4> Q, Out<float, 4> y) {
    Quaternion q(&Q[0]);
    glm_quat_normalize(q.q);
    std::copy_n(q.q, 4, y.data());
  }
  static void slerp(In<float, 9> x, Out<float, 4> y) {
    Quaternion q0(&x[0]), q1(&x[4]), q;
    glm_quat_slerp(q0.q, q1.q, x[8], q.q);
    std::copy_n(q.q, 4, y.data());
  }
  static void rotation_between(In<float, 6> x, Out<float, 4> y) {
    vec3 a{x[0], x[1], x[2]}, b{x[3], x[4], x[5]};
    Quaternion q;
    glm_quat_from_vecs(a, b, q.q);
    std::copy_n(q.q, 4, y.data());
  }
  static const char* source(std::string_view operation) {
    if (operation == "log3_quaternion")
      return PROGRAM("cglm/cglm.h",
                     "float Q[] = {{Q}}, s = Q[3] < 0 ? -1 : 1; vec3 v;\n"
                     "versor q = {s * Q[0], s * Q[1], s * Q[2], s * Q[3]};\n"
                     "glm_quat_axis(q, v); float a = glm_quat_angle(q);",
                     "a * v[0], a * v[1], a * v[2]");
    if (operation == "exp3_quaternion")
      return PROGRAM("cglm/cglm.h", "vec3 v = {{phi}};\nversor q; glm_quatv(q, glm_vec3_norm(v), v);",
                     "q[0], q[1], q[2], q[3]");
    if (operation == "slerp")
      return PROGRAM("cglm/cglm.h", "versor q0 = {{Q0}}, q1 = {{Q1}}, q;\nglm_quat_slerp(q0, q1, {t}, q);",
                     "q[0], q[1], q[2], q[3]");
    if (operation == "rotation_between")
      return PROGRAM("cglm/cglm.h", "vec3 a = {{a}}, b = {{b}};\nversor q; glm_quat_from_vecs(a, b, q);",
                     "q[0], q[1], q[2], q[3]");
    return nullptr;
  }
};

}  // namespace

LIECHECK_ADAPTER(Cglm, exp3_quaternion, log3_quaternion, compose, inverse, act_point, rotate_point, normalize,
                 slerp, rotation_between)
