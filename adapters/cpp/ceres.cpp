// Ceres Solver: rotation.h, in float and double. Quaternions are w, x, y, z. "ceres" is a subject of
// liecheck, too; this adapter adds the functions whose documentation allows quaternions of any norm.

#include <ceres/rotation.h>
#include <ceres/version.h>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

template <class S>
struct Quaternion {
  S wxyz[4];
};
template <class S>
struct Vector {
  S x[3];
};
template <class S>
Quaternion<S> quaternion(const S* Q) {
  return {{Q[3], Q[0], Q[1], Q[2]}};
}
template <class S>
Vector<S> vector(const S* x) {
  return {{x[0], x[1], x[2]}};
}

struct Ceres {
  static constexpr const char *name = "ceres_adapter", *version = CERES_VERSION_STRING;

  template <class S>
  static auto exp3_quaternion(In<S, 3> x) {
    return [phi = vector(&x[0])] {
      Quaternion<S> q;
      ceres::AngleAxisToQuaternion(phi.x, q.wxyz);
      return q;
    };
  }
  template <class S>
  static void exp3_matrix(In<S, 3> phi, Out<S, 9> R) {
    ceres::AngleAxisToRotationMatrix(&phi[0], ceres::RowMajorAdapter3x3(&R[0]));
  }
  template <class S>
  static auto log3_quaternion(In<S, 4> Q) {
    return [q = quaternion(&Q[0])] {
      Vector<S> phi;
      ceres::QuaternionToAngleAxis(q.wxyz, phi.x);
      return phi;
    };
  }
  template <class S>
  static void log3_matrix(In<S, 9> R, Out<S, 3> phi) {
    ceres::RotationMatrixToAngleAxis(ceres::RowMajorAdapter3x3(&R[0]), &phi[0]);
  }
  template <class S>
  static auto rotate_point(In<S, 7> x) {
    return [q = quaternion(&x[0]), p = vector(&x[4])] {
      Vector<S> y;
      ceres::UnitQuaternionRotatePoint(q.wxyz, p.x, y.x);
      return y;
    };
  }
  template <class S>
  static auto rotate_point_any_norm(In<S, 7> x) {
    return [q = quaternion(&x[0]), p = vector(&x[4])] {
      Vector<S> y;
      ceres::QuaternionRotatePoint(q.wxyz, p.x, y.x);
      return y;
    };
  }
  template <class S>
  static void matrix_from_quaternion_any_norm(In<S, 4> Q, Out<S, 9> R) {
    ceres::QuaternionToRotation(quaternion(&Q[0]).wxyz, ceres::RowMajorAdapter3x3(&R[0]));
  }
  template <class S>
  static void write(const Quaternion<S>& q, Out<S, 4> Q) {
    Q[0] = q.wxyz[1], Q[1] = q.wxyz[2], Q[2] = q.wxyz[3], Q[3] = q.wxyz[0];
  }
  template <class S>
  static void write(const Vector<S>& v, Out<S, 3> y) {
    std::copy_n(v.x, 3, &y[0]);
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
