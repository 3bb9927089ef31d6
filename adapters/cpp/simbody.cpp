// Simbody: SimTKcommon's Rotation, Quaternion, Transform, shifts of spatial vectors and MassProperties, in
// double. Quaternions are w, x, y, z and are normalized when they are made. Spatial vectors are (angular,
// linear).

#include <SimTKcommon/internal/MassProperties.h>
#include <SimTKcommon/internal/SpatialAlgebra.h>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

using SimTK::Inertia, SimTK::Mat33, SimTK::MassProperties, SimTK::Quaternion, SimTK::Rotation,
    SimTK::SpatialVec, SimTK::Transform, SimTK::Vec3, SimTK::Vec4;

Vec3 vector(const double* x) {
  return {x[0], x[1], x[2]};
}
Rotation rotation(const double* R) {
  return Rotation(Mat33(R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]), true);  // as it is
}
Transform pose(const double* X) {
  return {rotation(X), vector(X + 9)};
}
Quaternion quaternion(const double* Q) {
  return {Q[3], Q[0], Q[1], Q[2]};
}
SpatialVec spatial(const double* V) {
  return {vector(V + 3), vector(V)};
}
MassProperties body(const double* I) {
  const Inertia central(I[4], I[8], I[12], I[5], I[6], I[9]);
  return {I[0], vector(I + 1), central.shiftFromMassCenter(vector(I + 1), I[0])};
}

void put(const Vec3& x, double* to) {
  std::copy_n(&x[0], 3, to);
}
template <class Matrix>
void put_matrix(const Matrix& R, double* to) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) to[3 * i + j] = R[i][j];
}
void put(const Vec4& q, double* to) {
  to[0] = q[1], to[1] = q[2], to[2] = q[3], to[3] = q[0];
}
void put(const Transform& X, double* to) {
  put_matrix(X.R(), to), put(X.p(), to + 9);
}
void put(const SpatialVec& V, double* to) {
  put(V[1], to), put(V[0], to + 3);
}
void put_angle_axis(const Vec4& a, double* to) {
  put(a[0] * a.getSubVec<3>(1), to);
}

std::string version_text() {
  int major, minor, patch;
  SimTK_version_SimTKcommon(&major, &minor, &patch);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

struct Simbody {
  static constexpr const char* name = "simbody";
  static inline const std::string text = version_text();
  static inline const char* const version = text.c_str();

  static void exp3_quaternion(In<double, 3> phi, Out<double, 4> Q) {
    const Vec3 n = vector(axis_of<double>(phi).data());
    Quaternion q;
    q.setQuaternionFromAngleAxis(angle_of<double>(phi), SimTK::UnitVec3(n));
    put(q.asVec4(), &Q[0]);
  }
  static void exp3_matrix(In<double, 3> phi, Out<double, 9> R) {
    put_matrix(Rotation(angle_of<double>(phi), vector(axis_of<double>(phi).data())), &R[0]);
  }
  static void log3_quaternion(In<double, 4> Q, Out<double, 3> phi) {
    put_angle_axis(quaternion(&Q[0]).convertQuaternionToAngleAxis(), &phi[0]);
  }
  static void log3_matrix(In<double, 9> R, Out<double, 3> phi) {
    put_angle_axis(rotation(&R[0]).convertRotationToAngleAxis(), &phi[0]);
  }
  static void rotate_point(In<double, 7> x, Out<double, 3> y) {
    put(Rotation(quaternion(&x[0])) * vector(&x[4]), &y[0]);
  }
  static void normalize(In<double, 4> Q, Out<double, 4> y) { put(quaternion(&Q[0]).asVec4(), &y[0]); }
  static void matrix_from_quaternion_any_norm(In<double, 4> Q, Out<double, 9> R) {
    put_matrix(Rotation(quaternion(&Q[0])), &R[0]);
  }
  static void rotate_point_any_norm(In<double, 7> x, Out<double, 3> y) { rotate_point(x, y); }
  static void log3_any_norm(In<double, 4> Q, Out<double, 3> phi) { log3_quaternion(Q, phi); }

  static void compose(In<double, 24> x, Out<double, 12> y) { put(pose(&x[0]) * pose(&x[12]), &y[0]); }
  static void inverse(In<double, 12> x, Out<double, 12> y) { put(Transform(~pose(&x[0])), &y[0]); }
  static void act_point(In<double, 15> x, Out<double, 3> y) { put(pose(&x[0]) * vector(&x[12]), &y[0]); }

  // The axes of A, and then the point: B's origin moves by -p to that of A.
  static void act_motion(In<double, 18> x, Out<double, 6> y) {
    put(SimTK::shiftVelocityBy(rotation(&x[0]) * spatial(&x[12]), -vector(&x[9])), &y[0]);
  }
  static void act_force(In<double, 18> x, Out<double, 6> y) {
    put(SimTK::shiftForceBy(rotation(&x[0]) * spatial(&x[12]), -vector(&x[9])), &y[0]);
  }
  static void act_inverse_motion(In<double, 18> x, Out<double, 6> y) {
    put(~rotation(&x[0]) * SimTK::shiftVelocityBy(spatial(&x[12]), vector(&x[9])), &y[0]);
  }
  static void act_inverse_force(In<double, 18> x, Out<double, 6> y) {
    put(~rotation(&x[0]) * SimTK::shiftForceBy(spatial(&x[12]), vector(&x[9])), &y[0]);
  }
  static void momentum(In<double, 19> x, Out<double, 6> y) {
    const MassProperties I = body(&x[0]);
    put(SimTK::SpatialInertia(I.getMass(), I.getMassCenter(), I.getUnitInertia()) * spatial(&x[13]), &y[0]);
  }
  static void inertia_matrix(In<double, 13> x, Out<double, 36> y) {
    const SimTK::SpatialMat M = body(&x[0]).toSpatialMat();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) y[6 * i + j] = M(1 - i / 3, 1 - j / 3)(i % 3, j % 3);
  }
  // Euler angles in all orders: about axes of the body (rotating) or of space (static).
  struct Order {
    SimTK::BodyOrSpaceType fixed;
    SimTK::CoordinateAxis i, j, k;
    explicit Order(double number)
        : fixed(static_cast<int>(number) % 2 ? SimTK::BodyRotationSequence : SimTK::SpaceRotationSequence),
          i(axis(number, 0)),
          j(axis(number, 1)),
          k(axis(number, 2)) {}
    static SimTK::CoordinateAxis axis(double number, std::size_t n) {
      static constexpr std::string_view all = "XYZXZYYXZYZXZXYZYXXYXXZXYXYYZYZXZZYZ";
      return SimTK::CoordinateAxis(all[static_cast<std::size_t>(number) / 2 * 3 + n] - 'X');
    }
  };
  static void euler_to_matrix(In<double, 4> x, Out<double, 9> y) {
    const Order o(x[0]);
    put_matrix(Rotation(o.fixed, x[1], o.i, x[2], o.j, x[3], o.k), &y[0]);
  }
  static void euler_from_matrix(In<double, 10> x, Out<double, 3> y) {
    const Order o(x[0]);
    put(rotation(&x[1]).convertThreeAxesRotationToThreeAngles(o.fixed, o.i, o.j, o.k), &y[0]);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"exp3_quaternion",
         PROGRAM("SimTKcommon/internal/MassProperties.h",
                 "SimTK::Vec3 v({phi}), n = v == SimTK::Vec3(0) ? SimTK::Vec3(1, 0, 0) : v;\n"
                 "SimTK::Quaternion q; q.setQuaternionFromAngleAxis(v.norm(), SimTK::UnitVec3(n));",
                 "q[1], q[2], q[3], q[0]")},
        {"exp3_matrix",
         PROGRAM("SimTKcommon/internal/MassProperties.h",
                 "SimTK::Vec3 v({phi}), n = v == SimTK::Vec3(0) ? SimTK::Vec3(1, 0, 0) : v;\n"
                 "SimTK::Rotation R(v.norm(), n);",
                 "R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2]")},
        {"log3_quaternion",
         PROGRAM("SimTKcommon/internal/MassProperties.h",
                 "double Q[] = {{Q}};\n"
                 "auto a = SimTK::Quaternion(Q[3], Q[0], Q[1], Q[2]).convertQuaternionToAngleAxis();",
                 "a[0] * a[1], a[0] * a[2], a[0] * a[3]")},
        {"log3_any_norm",
         PROGRAM("SimTKcommon/internal/MassProperties.h",
                 "double Q[] = {{Q}};\n"
                 "auto a = SimTK::Quaternion(Q[3], Q[0], Q[1], Q[2]).convertQuaternionToAngleAxis();",
                 "a[0] * a[1], a[0] * a[2], a[0] * a[3]")},
        {"log3_matrix", PROGRAM("SimTKcommon/internal/MassProperties.h",
                                "SimTK::Rotation R(SimTK::Mat33({R}), true);\n"
                                "auto a = R.convertRotationToAngleAxis();",
                                "a[0] * a[1], a[0] * a[2], a[0] * a[3]")},
        {"normalize", PROGRAM("SimTKcommon/internal/MassProperties.h",
                              "double Q[] = {{Q}};\n"
                              "SimTK::Quaternion q(Q[3], Q[0], Q[1], Q[2]);",
                              "q[1], q[2], q[3], q[0]")},
        {"matrix_from_quaternion_any_norm",
         PROGRAM("SimTKcommon/internal/MassProperties.h",
                 "double Q[] = {{Q}};\n"
                 "SimTK::Rotation R(SimTK::Quaternion(Q[3], Q[0], Q[1], Q[2]));",
                 "R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2]")},
        {"euler_from_matrix",
         PROGRAM("SimTKcommon/internal/MassProperties.h",
                 "SimTK::Rotation R(SimTK::Mat33({R}), true); int order = {order};\n"
                 "auto axis = [&](int n) { return SimTK::CoordinateAxis("
                 "\"XYZXZYYXZYZXZXYZYXXYXXZXYXYYZYZXZZYZ\"[order / 2 * 3 + n] - 'X'); };\n"
                 "auto v = R.convertThreeAxesRotationToThreeAngles(order % 2 ? SimTK::BodyRotationSequence "
                 ": SimTK::SpaceRotationSequence, axis(0), axis(1), axis(2));",
                 "v[0], v[1], v[2]")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Simbody, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, rotate_point, normalize,
                 matrix_from_quaternion_any_norm, rotate_point_any_norm, log3_any_norm, compose, inverse, act_point,
                 act_motion, act_force, act_inverse_motion, act_inverse_force, momentum, inertia_matrix,
                 euler_to_matrix, euler_from_matrix)
