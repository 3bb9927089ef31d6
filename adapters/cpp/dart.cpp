// DART: dart/math/Geometry.hpp and dynamics::Inertia, in double. Motions are (angular, linear), forces
// (moment, force). Products of poses are Eigen's. A FreeJoint integrates (exp(omega), u), which is not the
// exponential of SE(3). Inertias are not transformed: transformInertia rounds the zeros of its tensor, and
// Inertia calls such a tensor invalid.

#include <dart/config.hpp>
#include <dart/dynamics/Inertia.hpp>
#include <dart/math/Geometry.hpp>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

using Eigen::Isometry3d, Eigen::Map, Eigen::Matrix3d, Eigen::Matrix6d, Eigen::Quaterniond, Eigen::Vector3d,
    Eigen::Vector6d;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Vector3d vector(const double* x) {
  return Map<const Vector3d>(x);
}
Matrix3d rotation(const double* R) {
  return Map<const Rows>(R);
}
Isometry3d pose(const double* X) {
  Isometry3d T = Isometry3d::Identity();
  T.linear() = rotation(X), T.translation() = vector(X + 9);
  return T;
}
Vector6d angular_first(const double* V) {
  return (Vector6d() << vector(V + 3), vector(V)).finished();
}
Quaterniond quaternion(const double* Q) {
  return Quaterniond(Map<const Eigen::Vector4d>(Q));
}

void put(const Vector3d& x, double* to) {
  Map<Vector3d> y(to);
  y = x;
}
void put(const Matrix3d& R, double* to) {
  Map<Rows> y(to);
  y = R;
}
void put(const Isometry3d& T, double* to) {
  put(Matrix3d(T.linear()), to), put(Vector3d(T.translation()), to + 9);
}
void put(const Vector6d& V, double* to) {
  put(Vector3d(V.tail<3>()), to), put(Vector3d(V.head<3>()), to + 3);
}

struct Dart {
  static constexpr const char *name = "dart", *version = DART_VERSION;

  static void exp3_quaternion(In<double, 3> phi, Out<double, 4> Q) {
    Map<Eigen::Vector4d> y(&Q[0]);
    y = dart::math::expToQuat(vector(&phi[0])).coeffs();
  }
  static void exp3_matrix(In<double, 3> phi, Out<double, 9> R) {
    put(dart::math::expMapRot(vector(&phi[0])), &R[0]);
  }
  static void log3_quaternion(In<double, 4> Q, Out<double, 3> phi) {
    put(dart::math::quatToExp(quaternion(nearer_to_one<double>(Q).data())), &phi[0]);
  }
  static void log3_matrix(In<double, 9> R, Out<double, 3> phi) {
    put(dart::math::logMap(rotation(&R[0])), &phi[0]);
  }
  static void exp6(In<double, 6> xi, Out<double, 12> X) {
    put(dart::math::expMap(angular_first(&xi[0])), &X[0]);
  }
  static void log6(In<double, 12> X, Out<double, 6> xi) { put(dart::math::logMap(pose(&X[0])), &xi[0]); }
  static void left_jacobian3(In<double, 3> phi, Out<double, 9> J) {
    put(dart::math::expMapJac(vector(&phi[0])), &J[0]);
  }
  static void rotate_point(In<double, 7> x, Out<double, 3> y) {
    put(dart::math::rotatePoint(quaternion(&x[0]), vector(&x[4])), &y[0]);
  }
  static void act_motion(In<double, 18> x, Out<double, 6> y) {
    put(dart::math::AdT(pose(&x[0]), angular_first(&x[12])), &y[0]);
  }
  static void act_inverse_motion(In<double, 18> x, Out<double, 6> y) {
    put(dart::math::AdInvT(pose(&x[0]), angular_first(&x[12])), &y[0]);
  }
  static void act_force(In<double, 18> x, Out<double, 6> y) {
    put(dart::math::dAdInvT(pose(&x[0]), angular_first(&x[12])), &y[0]);
  }
  static void act_inverse_force(In<double, 18> x, Out<double, 6> y) {
    put(dart::math::dAdT(pose(&x[0]), angular_first(&x[12])), &y[0]);
  }
  static void cross_motion(In<double, 12> x, Out<double, 6> y) {
    put(dart::math::ad(angular_first(&x[0]), angular_first(&x[6])), &y[0]);
  }
  static void cross_force(In<double, 12> x, Out<double, 6> y) {  // dad is the transpose of ad
    put(Vector6d(-dart::math::dad(angular_first(&x[0]), angular_first(&x[6]))), &y[0]);
  }
  static void inertia_matrix(In<double, 13> x, Out<double, 36> y) {
    const Matrix6d I = dart::dynamics::Inertia(x[0], vector(&x[1]), rotation(&x[4])).getSpatialTensor();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) y[6 * i + j] = I((i + 3) % 6, (j + 3) % 6);
  }
  // Euler angles about the axes of the body: X Y Z ... Z Y X are the odd orders up to 11.
  static void euler_to_matrix(In<double, 4> x, Out<double, 9> y) {
    static constexpr decltype(&dart::math::eulerXYZToMatrix) all[] = {
        dart::math::eulerXYZToMatrix, dart::math::eulerXZYToMatrix, dart::math::eulerYXZToMatrix,
        dart::math::eulerYZXToMatrix, dart::math::eulerZXYToMatrix, dart::math::eulerZYXToMatrix,
        dart::math::eulerXYXToMatrix, dart::math::eulerXZXToMatrix, dart::math::eulerYXYToMatrix,
        dart::math::eulerYZYToMatrix, dart::math::eulerZXZToMatrix, dart::math::eulerZYZToMatrix};
    put(all[rotating(x[0], 24)](vector(&x[1])), &y[0]);
  }
  static void euler_from_matrix(In<double, 10> x, Out<double, 3> y) {
    static constexpr decltype(&dart::math::matrixToEulerXYZ) all[] = {
        dart::math::matrixToEulerXYZ, dart::math::matrixToEulerXZY, dart::math::matrixToEulerYXZ,
        dart::math::matrixToEulerYZX, dart::math::matrixToEulerZXY, dart::math::matrixToEulerZYX};
    put(all[rotating(x[0], 12)](rotation(&x[1])), &y[0]);
  }
  static std::size_t rotating(double order, double end) {
    const auto number = static_cast<std::size_t>(order);
    if (number % 2 == 0 || order >= end)
      throw std::invalid_argument("the library has no function for this order of Euler angles");
    return number / 2;
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion",
         PROGRAM(
             "dart/math/Geometry.hpp",
             "double Q[] = {{Q}}, s = Q[3] < 0 ? -1 : 1;\n"
             "auto v = dart::math::quatToExp(Eigen::Quaterniond(s * Q[3], s * Q[0], s * Q[1], s * Q[2]));",
             "v[0], v[1], v[2]")},
        {"log3_matrix", PROGRAM("dart/math/Geometry.hpp",
                                "Eigen::Matrix3d R;\n"
                                "R << {R}; Eigen::Vector3d v = dart::math::logMap(R);",
                                "v[0], v[1], v[2]")},
        {"exp3_quaternion",
         PROGRAM("dart/math/Geometry.hpp", "auto q = dart::math::expToQuat(Eigen::Vector3d({phi}));",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"exp3_matrix",
         PROGRAM("dart/math/Geometry.hpp",
                 "Eigen::Matrix3d R = dart::math::expMapRot(Eigen::Vector3d({phi}));",
                 "R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)")},
        {"exp6", PROGRAM("dart/math/Geometry.hpp",
                         "Eigen::Vector6d x; x << {xi}; x << x.tail<3>().eval(), x.head<3>().eval();\n"
                         "auto T = dart::math::expMap(x); auto R = T.linear(); auto p = T.translation();",
                         "R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2), "
                         "p[0], p[1], p[2]")},
        {"log6", PROGRAM("dart/math/Geometry.hpp",
                         "Eigen::Matrix<double, 3, 4> X; Eigen::Matrix<double, 12, 1> x; x << {X}; "
                         "Eigen::Isometry3d T(Eigen::Isometry3d::Identity());\n"
                         "T.linear() = Eigen::Map<Eigen::Matrix3d>(x.data()).transpose(); T.translation() = "
                         "x.tail<3>(); auto v = dart::math::logMap(T);",
                         "v[3], v[4], v[5], v[0], v[1], v[2]")},
        {"left_jacobian3",
         PROGRAM("dart/math/Geometry.hpp",
                 "Eigen::Matrix3d R = dart::math::expMapJac(Eigen::Vector3d({phi}));",
                 "R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)")},
        {"euler_from_matrix",
         PROGRAM("dart/math/Geometry.hpp",
                 "using namespace dart::math; Eigen::Matrix3d R; R << {R};\n"
                 "decltype(&matrixToEulerXYZ) all[] = {matrixToEulerXYZ, matrixToEulerXZY, matrixToEulerYXZ, "
                 "matrixToEulerYZX, matrixToEulerZXY, matrixToEulerZYX};\n"
                 "Eigen::Vector3d v = all[int({order}) / 2](R);",
                 "v[0], v[1], v[2]")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Dart, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, exp6, log6, left_jacobian3,
                 rotate_point, act_motion, act_inverse_motion, act_force, act_inverse_force, cross_motion,
                 cross_force, inertia_matrix, euler_to_matrix, euler_from_matrix)
