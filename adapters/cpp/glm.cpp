// GLM: quaternions (exp, log, product with a vector) and 4 x 4 matrices, in float and double. Matrices have
// columns.

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_common.hpp>
#include <glm/ext/quaternion_exponential.hpp>
#include <glm/ext/quaternion_geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/orthonormalize.hpp>
#include <glm/gtx/rotate_vector.hpp>
#include <glm/gtx/vector_angle.hpp>
#include <glm/mat4x4.hpp>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

#define TEXT_OF(x) #x
#define VERSION(major, minor, patch, revision) \
  TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch) "." TEXT_OF(revision)

namespace {

template <class S>
using Vec = glm::vec<3, S>;
template <class S>
using Quaternion = glm::qua<S>;

template <class S>
Vec<S> vector(const S* x) {
  return {x[0], x[1], x[2]};
}
template <class S>
glm::mat<3, 3, S> rotation(const S* R) {
  return {R[0], R[3], R[6], R[1], R[4], R[7], R[2], R[5], R[8]};
}
template <class S>
glm::mat<4, 4, S> pose(const S* X) {
  glm::mat<4, 4, S> M(rotation(X));
  M[3] = {vector(X + 9), 1};
  return M;
}
template <class S>
Quaternion<S> quaternion(const S* Q) {
  return {Q[3], Q[0], Q[1], Q[2]};
}

template <class S>
void put(const Quaternion<S>& Q, S* to) {
  to[0] = Q.x, to[1] = Q.y, to[2] = Q.z, to[3] = Q.w;
}
template <class S>
void put(const Vec<S>& x, S* to) {
  to[0] = x.x, to[1] = x.y, to[2] = x.z;
}
template <class M, class S>
void put_rotation(const M& R, S* to) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) to[3 * i + j] = R[j][i];
}
template <class S>
void put(const glm::mat<4, 4, S>& X, S* to) {
  put_rotation(X, to), put(Vec<S>(X[3]), to + 9);
}

struct Glm {
  static constexpr const char *name = "glm", *version = VERSION(0, GLM_VERSION_MINOR, GLM_VERSION_PATCH,
                                                                GLM_VERSION_REVISION);

  // exp and log are those of quaternions, exp(0, phi/2) and (0, phi/2).
  template <class S>
  static void exp3_quaternion(In<S, 3> phi, Out<S, 4> Q) {
    put(glm::exp(Quaternion<S>(0, vector(&phi[0]) / S(2))), &Q[0]);
  }
  template <class S>
  static void exp3_matrix(In<S, 3> phi, Out<S, 9> R) {
    put_rotation(glm::rotate(glm::mat<4, 4, S>(1), angle_of<S>(phi), vector(axis_of<S>(phi).data())), &R[0]);
  }
  template <class S>
  static void log3_quaternion(In<S, 4> Q, Out<S, 3> phi) {
    const Quaternion<S> half = glm::log(quaternion(nearer_to_one<S>(Q).data()));
    put(S(2) * Vec<S>(half.x, half.y, half.z), &phi[0]);
  }
  template <class S>
  static void log3_matrix(In<S, 9> R, Out<S, 3> phi) {
    std::array<S, 4> Q;
    put(glm::quat_cast(rotation(&R[0])), Q.data());
    log3_quaternion<S>(Q, phi);
  }
  template <class S>
  static void compose(In<S, 24> x, Out<S, 12> y) {
    put(pose(&x[0]) * pose(&x[12]), &y[0]);
  }
  template <class S>
  static void inverse(In<S, 12> x, Out<S, 12> y) {
    put(glm::inverse(pose(&x[0])), &y[0]);
  }
  template <class S>
  static void act_point(In<S, 15> x, Out<S, 3> y) {
    put(Vec<S>(pose(&x[0]) * glm::vec<4, S>(vector(&x[12]), 1)), &y[0]);
  }
  template <class S>
  static void rotate_point(In<S, 7> x, Out<S, 3> y) {
    put(quaternion(&x[0]) * vector(&x[4]), &y[0]);
  }
  template <class S>
  static void normalize(In<S, 4> Q, Out<S, 4> y) {
    put(glm::normalize(quaternion(&Q[0])), &y[0]);
  }
  // angle() is up to 2 pi: the one between two rotations is that of Q or -Q with w >= 0.
  template <class S>
  static void relative_angle(In<S, 8> x, Out<S, 1> y) {
    std::array<S, 4> Q;
    put(glm::conjugate(quaternion(&x[0])) * quaternion(&x[4]), Q.data());
    y[0] = glm::angle(quaternion(nearer_to_one<S>(Q).data()));
  }
  template <class S>
  static void slerp(In<S, 9> x, Out<S, 4> y) {
    put(glm::slerp(quaternion(&x[0]), quaternion(&x[4]), x[8]), &y[0]);
  }
  template <class S>
  static void rotation_between(In<S, 6> x, Out<S, 4> y) {
    put(Quaternion<S>(vector(&x[0]), vector(&x[3])), &y[0]);
  }
  template <class S>
  static void euler_to_quaternion(In<S, 4> x, Out<S, 4> y) {
    put(Quaternion<S>(vector(roll_pitch_yaw<S>(x).data())), &y[0]);
  }
  template <class S>
  static void euler_from_quaternion(In<S, 5> x, Out<S, 3> y) {
    const Vec<S> angles = glm::eulerAngles(quaternion(&x[1]));
    put_roll_pitch_yaw<S>(x[0], in_range(angles.x), angles.y, angles.z, y);
  }
  template <class S>
  static void quaternion_from_matrix(In<S, 9> R, Out<S, 4> Q) {
    put(glm::quat_cast(rotation(&R[0])), &Q[0]);
  }
  template <class S>
  static void matrix_from_quaternion(In<S, 4> Q, Out<S, 9> R) {
    put_rotation(glm::mat3_cast(quaternion(&Q[0])), &R[0]);
  }
  template <class S>
  static void quaternion_product(In<S, 8> x, Out<S, 4> y) {
    put(quaternion(&x[0]) * quaternion(&x[4]), &y[0]);
  }
  template <class S>
  static void quaternion_inverse(In<S, 4> Q, Out<S, 4> y) {
    put(glm::inverse(quaternion(&Q[0])), &y[0]);
  }
  template <class S>
  static void axis_angle_from_quaternion(In<S, 4> Q, Out<S, 4> y) {
    put(glm::axis(quaternion(&Q[0])), &y[0]);
    y[3] = glm::angle(quaternion(&Q[0]));
  }
  template <class S>
  static void quaternion_from_axis_angle(In<S, 4> x, Out<S, 4> y) {
    put(glm::angleAxis(x[3], vector(&x[0])), &y[0]);
  }
  template <class S>
  static void matrix_from_axis_angle(In<S, 4> x, Out<S, 9> R) {
    put_rotation(glm::rotate(glm::mat<4, 4, S>(1), x[3], vector(&x[0])), &R[0]);
  }
  template <class S>
  static void gram_schmidt(In<S, 9> A, Out<S, 9> R) {
    put_rotation(glm::orthonormalize(rotation(&A[0])), &R[0]);
  }
  template <class S>
  static void angle_between(In<S, 6> x, Out<S, 1> y) {
    y[0] = glm::angle(vector(&x[0]), vector(&x[3]));
  }
  template <class S>
  static void slerp_directions(In<S, 7> x, Out<S, 3> y) {
    put(glm::slerp(vector(&x[0]), vector(&x[3]), x[6]), &y[0]);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion", PROGRAM("glm/ext.hpp",
                                    "using S = {scalar}; S Q[] = {{Q}}, s = Q[3] < 0 ? -1 : 1;\n"
                                    "auto v = glm::log(glm::qua<S>(s * Q[3], s * Q[0], s * Q[1], s * Q[2]));",
                                    "2 * v.x, 2 * v.y, 2 * v.z")},
        {"log3_matrix",
         PROGRAM("glm/ext.hpp",
                 "using S = {scalar}; auto q = glm::quat_cast(glm::transpose(glm::mat<3, 3, S>({R})));\n"
                 "auto v = glm::log(q.w < 0 ? -q : q);",
                 "2 * v.x, 2 * v.y, 2 * v.z")},
        {"quaternion_from_matrix",
         PROGRAM("glm/ext.hpp",
                 "using S = {scalar}; auto q = glm::quat_cast(glm::transpose(glm::mat<3, 3, S>({R})));",
                 "q.x, q.y, q.z, q.w")},
        {"axis_angle_from_quaternion", PROGRAM("glm/ext.hpp",
                                               "using S = {scalar}; S Q[] = {{Q}}; glm::qua<S> q(Q[3], Q[0], "
                                               "Q[1], Q[2]); auto n = glm::axis(q);",
                                               "n.x, n.y, n.z, glm::angle(q)")},
        {"angle_between",
         "#define GLM_ENABLE_EXPERIMENTAL\n" PROGRAM(
             "glm/gtx/vector_angle.hpp", "using V = glm::vec<3, {scalar}>;", "glm::angle(V({a}), V({b}))")},
        {"slerp_directions",
         "#define GLM_ENABLE_EXPERIMENTAL\n" PROGRAM(
             "glm/gtx/rotate_vector.hpp",
             "using S = {scalar}; using V = glm::vec<3, S>; auto v = glm::slerp(V({a}), V({b}), S({t}));",
             "v.x, v.y, v.z")},
        {"exp3_quaternion", PROGRAM("glm/ext.hpp",
                                    "using S = {scalar}; glm::vec<3, S> phi({phi});\n"
                                    "auto q = glm::exp(glm::qua<S>(0, phi / S(2)));",
                                    "q.x, q.y, q.z, q.w")},
        {"exp3_matrix",
         PROGRAM("glm/ext.hpp",
                 "using S = {scalar}; glm::vec<3, S> phi({phi}), n = phi == glm::vec<3, S>(0) ? glm::vec<3, "
                 "S>(1, 0, 0) : phi;\n"
                 "auto R = glm::rotate(glm::mat<4, 4, S>(1), glm::length(phi), n);",
                 "R[0][0], R[1][0], R[2][0], R[0][1], R[1][1], R[2][1], R[0][2], R[1][2], R[2][2]")},
        {"normalize", PROGRAM("glm/ext.hpp",
                              "using S = {scalar}; S Q[] = {{Q}};\n"
                              "auto q = glm::normalize(glm::qua<S>(Q[3], Q[0], Q[1], Q[2]));",
                              "q.x, q.y, q.z, q.w")},
        {"relative_angle",
         PROGRAM("glm/ext.hpp",
                 "using S = {scalar}; using Q = glm::qua<S>; S a[] = {{Q0}}, b[] = {{Q1}};\n"
                 "Q q = glm::conjugate(Q(a[3], a[0], a[1], a[2])) * Q(b[3], b[0], b[1], b[2]);",
                 "glm::angle(q.w < 0 ? -q : q)")},
        {"slerp", PROGRAM("glm/ext.hpp",
                          "using S = {scalar}; using Q = glm::qua<S>; S a[] = {{Q0}}, b[] = {{Q1}};\n"
                          "Q q = glm::slerp(Q(a[3], a[0], a[1], a[2]), Q(b[3], b[0], b[1], b[2]), S({t}));",
                          "q.x, q.y, q.z, q.w")},
        {"rotation_between", PROGRAM("glm/ext.hpp",
                                     "using S = {scalar}; using V = glm::vec<3, S>;\n"
                                     "glm::qua<S> q(V({a}), V({b}));",
                                     "q.x, q.y, q.z, q.w")},
        {"euler_from_quaternion", PROGRAM("glm/ext.hpp",
                                          "using S = {scalar}; S Q[] = {{Q}};\n"
                                          "auto v = glm::eulerAngles(glm::qua<S>(Q[3], Q[0], Q[1], Q[2]));",
                                          "std::remainder(v.x, S(2 * M_PI)), v.y, v.z")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Glm, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, compose, inverse, act_point,
                 rotate_point, normalize, relative_angle, slerp, rotation_between, euler_to_quaternion,
                 euler_from_quaternion, quaternion_from_matrix, matrix_from_quaternion, quaternion_product,
                 quaternion_inverse, axis_angle_from_quaternion, quaternion_from_axis_angle,
                 matrix_from_axis_angle, gram_schmidt, angle_between, slerp_directions)
