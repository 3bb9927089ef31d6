// Ceres Solver: rotation.h, in float and double. Quaternions are w, x, y, z. "ceres" is a subject of
// liecheck, too; this adapter adds the functions whose documentation allows quaternions of any norm.

#include <ceres/rotation.h>
#include <ceres/version.h>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

template <class S>
std::array<S, 4> w_first(const S* Q) {
  return {Q[3], Q[0], Q[1], Q[2]};
}

struct Ceres {
  static constexpr const char *name = "ceres_adapter", *version = CERES_VERSION_STRING;

  template <class S>
  static void exp3_quaternion(In<S, 3> phi, Out<S, 4> Q) {
    S q[4];
    ceres::AngleAxisToQuaternion(&phi[0], q);
    Q[0] = q[1], Q[1] = q[2], Q[2] = q[3], Q[3] = q[0];
  }
  template <class S>
  static void exp3_matrix(In<S, 3> phi, Out<S, 9> R) {
    ceres::AngleAxisToRotationMatrix(&phi[0], ceres::RowMajorAdapter3x3(&R[0]));
  }
  template <class S>
  static void log3_quaternion(In<S, 4> Q, Out<S, 3> phi) {
    ceres::QuaternionToAngleAxis(w_first(&Q[0]).data(), &phi[0]);
  }
  template <class S>
  static void log3_matrix(In<S, 9> R, Out<S, 3> phi) {
    ceres::RotationMatrixToAngleAxis(ceres::RowMajorAdapter3x3(&R[0]), &phi[0]);
  }
  template <class S>
  static void rotate_point(In<S, 7> x, Out<S, 3> y) {
    ceres::UnitQuaternionRotatePoint(w_first(&x[0]).data(), &x[4], &y[0]);
  }
  template <class S>
  static void rotate_point_any_norm(In<S, 7> x, Out<S, 3> y) {
    ceres::QuaternionRotatePoint(w_first(&x[0]).data(), &x[4], &y[0]);
  }
  template <class S>
  static void matrix_from_quaternion_any_norm(In<S, 4> Q, Out<S, 9> R) {
    ceres::QuaternionToRotation(w_first(&Q[0]).data(), ceres::RowMajorAdapter3x3(&R[0]));
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion",
         PROGRAM("ceres/rotation.h",
                 "using S = {scalar}; S Q[] = {{Q}}, q[] = {Q[3], Q[0], Q[1], Q[2]}, v[3];\n"
                 "ceres::QuaternionToAngleAxis(q, v);",
                 "v[0], v[1], v[2]")},
        {"log3_matrix", PROGRAM("ceres/rotation.h",
                                "using S = {scalar}; S R[] = {{R}}, v[3];\n"
                                "ceres::RotationMatrixToAngleAxis(ceres::RowMajorAdapter3x3(R), v);",
                                "v[0], v[1], v[2]")},
        {"exp3_quaternion", PROGRAM("ceres/rotation.h",
                                    "using S = {scalar}; S phi[] = {{phi}}, q[4];\n"
                                    "ceres::AngleAxisToQuaternion(phi, q);",
                                    "q[1], q[2], q[3], q[0]")},
        {"exp3_matrix", PROGRAM("ceres/rotation.h",
                                "using S = {scalar}; S phi[] = {{phi}}, R[9];\n"
                                "ceres::AngleAxisToRotationMatrix(phi, ceres::RowMajorAdapter3x3(R));",
                                "R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]")},
        {"matrix_from_quaternion_any_norm",
         PROGRAM("ceres/rotation.h",
                 "using S = {scalar}; S Q[] = {{Q}}, q[] = {Q[3], Q[0], Q[1], Q[2]}, R[9];\n"
                 "ceres::QuaternionToRotation(q, ceres::RowMajorAdapter3x3(R));",
                 "R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]")},
        {"rotate_point_any_norm",
         PROGRAM("ceres/rotation.h",
                 "using S = {scalar}; S Q[] = {{Q}}, q[] = {Q[3], Q[0], Q[1], Q[2]}, p[] = {{p}}, v[3];\n"
                 "ceres::QuaternionRotatePoint(q, p, v);",
                 "v[0], v[1], v[2]")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Ceres, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, rotate_point,
                 rotate_point_any_norm, matrix_from_quaternion_any_norm)
