// Eigen: Quaternion, AngleAxis and Isometry, in float and double. liecheck has a subject of the same
// functions, "eigen"; this adapter is the example of a library with templates.

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

#define TEXT_OF(x) #x
#define VERSION(world, major, minor) TEXT_OF(world) "." TEXT_OF(major) "." TEXT_OF(minor)

// FromTwoVectors decomposes a matrix of two vectors. With that in this file, the compiler needs 1.3 GB.
#ifdef SVD_IN_EIGEN_SVD_CPP
extern template class Eigen::JacobiSVD<Eigen::Matrix<float, 2, 3>>;
extern template class Eigen::JacobiSVD<Eigen::Matrix<double, 2, 3>>;
#endif

namespace {

template <class S>
using Vector = Eigen::Matrix<S, 3, 1>;
template <class S>
using Matrix = Eigen::Matrix<S, 3, 3, Eigen::RowMajor>;
template <class S>
using Quaternion = Eigen::Quaternion<S>;
template <class S>
using AngleAxis = Eigen::AngleAxis<S>;
template <class S>
using Isometry = Eigen::Transform<S, 3, Eigen::Isometry>;

template <class S>
Eigen::Map<const Vector<S>> vector(const S* x) {
  return Eigen::Map<const Vector<S>>(x);
}
template <class S>
Eigen::Map<const Matrix<S>> rotation(const S* R) {
  return Eigen::Map<const Matrix<S>>(R);
}
template <class S>
Eigen::Map<const Quaternion<S>> quaternion(const S* Q) {
  return Eigen::Map<const Quaternion<S>>(Q);
}
template <class S>
Isometry<S> pose(const S* X) {
  Isometry<S> T;
  T.linear() = rotation(X), T.translation() = vector(X + 9), T.makeAffine();
  return T;
}
template <class S>
AngleAxis<S> angle_axis(In<S, 3> phi) {
  return {angle_of<S>(phi), vector(axis_of<S>(phi).data())};
}

template <class S, int rows, int columns, int options>
void put(const Eigen::Matrix<S, rows, columns, options>& x, S* to) {
  Eigen::Map<Eigen::Matrix<S, rows, columns, columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>> all(to);
  all = x;
}
template <class S>
void put(const Quaternion<S>& Q, S* to) {
  put(Q.coeffs(), to);
}
template <class S>
void put(const Isometry<S>& T, S* to) {
  put(Matrix<S>(T.linear()), to), put(Vector<S>(T.translation()), to + 9);
}
template <class S>
void put(const AngleAxis<S>& a, S* to) {
  put(Vector<S>(a.angle() * a.axis()), to);
}

struct EigenGeometry {
  static constexpr const char *name = "eigen_adapter",
                              *version =
                                  VERSION(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);

  template <class S>
  static void exp3_quaternion(In<S, 3> phi, Out<S, 4> Q) {
    put(Quaternion<S>(angle_axis(phi)), &Q[0]);
  }
  template <class S>
  static void exp3_matrix(In<S, 3> phi, Out<S, 9> R) {
    put(angle_axis(phi).toRotationMatrix(), &R[0]);
  }
  template <class S>
  static void log3_quaternion(In<S, 4> Q, Out<S, 3> phi) {
    put(AngleAxis<S>(quaternion(&Q[0])), &phi[0]);
  }
  template <class S>
  static void log3_matrix(In<S, 9> R, Out<S, 3> phi) {
    put(AngleAxis<S>(rotation(&R[0])), &phi[0]);
  }
  template <class S>
  static void compose(In<S, 24> x, Out<S, 12> y) {
    put(pose(&x[0]) * pose(&x[12]), &y[0]);
  }
  template <class S>
  static void inverse(In<S, 12> x, Out<S, 12> y) {
    put(pose(&x[0]).inverse(), &y[0]);
  }
  template <class S>
  static void act_point(In<S, 15> x, Out<S, 3> y) {
    put(Vector<S>(pose(&x[0]) * vector(&x[12])), &y[0]);
  }
  template <class S>
  static void rotate_point(In<S, 7> x, Out<S, 3> y) {
    put(Vector<S>(quaternion(&x[0]) * vector(&x[4])), &y[0]);
  }
  template <class S>
  static void normalize(In<S, 4> Q, Out<S, 4> y) {
    put(quaternion(&Q[0]).normalized(), &y[0]);
  }
  template <class S>
  static void relative_angle(In<S, 8> x, Out<S, 1> y) {
    y[0] = quaternion(&x[0]).angularDistance(quaternion(&x[4]));
  }
  template <class S>
  static void slerp(In<S, 9> x, Out<S, 4> y) {
    put(Quaternion<S>(quaternion(&x[0]).slerp(x[8], quaternion(&x[4]))), &y[0]);
  }
  template <class S>
  static void rotation_between(In<S, 6> x, Out<S, 4> y) {
    put(Quaternion<S>::FromTwoVectors(vector(&x[0]), vector(&x[3])), &y[0]);
  }
  template <class S>
  static void quaternion_from_matrix(In<S, 9> R, Out<S, 4> Q) {
    put(Quaternion<S>(rotation(&R[0])), &Q[0]);
  }
  template <class S>
  static void matrix_from_quaternion(In<S, 4> Q, Out<S, 9> R) {
    put(Matrix<S>(quaternion(&Q[0]).toRotationMatrix()), &R[0]);
  }
  template <class S>
  static void quaternion_product(In<S, 8> x, Out<S, 4> y) {
    put(Quaternion<S>(quaternion(&x[0]) * quaternion(&x[4])), &y[0]);
  }
  template <class S>
  static void quaternion_inverse(In<S, 4> Q, Out<S, 4> y) {
    put(quaternion(&Q[0]).inverse(), &y[0]);
  }
  template <class S>
  static void axis_angle_from_quaternion(In<S, 4> Q, Out<S, 4> y) {
    const Eigen::AngleAxis<S> a(quaternion(&Q[0]));
    put(Vector<S>(a.axis()), &y[0]);
    y[3] = a.angle();
  }
  template <class S>
  static void axis_angle_from_matrix(In<S, 9> R, Out<S, 4> y) {
    const Eigen::AngleAxis<S> a(rotation(&R[0]));
    put(Vector<S>(a.axis()), &y[0]);
    y[3] = a.angle();
  }
  template <class S>
  static void quaternion_from_axis_angle(In<S, 4> x, Out<S, 4> y) {
    put(Quaternion<S>(Eigen::AngleAxis<S>(x[3], vector(&x[0]))), &y[0]);
  }
  template <class S>
  static void matrix_from_axis_angle(In<S, 4> x, Out<S, 9> R) {
    put(Matrix<S>(Eigen::AngleAxis<S>(x[3], vector(&x[0])).toRotationMatrix()), &R[0]);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"log3_quaternion",
         PROGRAM("Eigen/Geometry",
                 "using S = {scalar}; S Q[] = {{Q}};\n"
                 "Eigen::AngleAxis<S> a(Eigen::Quaternion<S>(Q[3], Q[0], Q[1], Q[2]));",
                 "a.angle() * a.axis()[0], a.angle() * a.axis()[1], a.angle() * a.axis()[2]")},
        {"log3_matrix", PROGRAM("Eigen/Geometry",
                                "using S = {scalar}; Eigen::Matrix<S, 3, 3> R;\n"
                                "R << {R}; Eigen::AngleAxis<S> a(R);",
                                "a.angle() * a.axis()[0], a.angle() * a.axis()[1], a.angle() * a.axis()[2]")},
        {"exp3_quaternion",
         PROGRAM("Eigen/Geometry",
                 "using S = {scalar}; Eigen::Matrix<S, 3, 1> phi({phi}), n = phi.isZero(0) ? "
                 "Eigen::Matrix<S, 3, 1>(1, 0, 0) : phi;\n"
                 "Eigen::Quaternion<S> q(Eigen::AngleAxis<S>(phi.norm(), n.normalized()));",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"exp3_matrix",
         PROGRAM("Eigen/Geometry",
                 "using S = {scalar}; Eigen::Matrix<S, 3, 1> phi({phi}), n = phi.isZero(0) ? "
                 "Eigen::Matrix<S, 3, 1>(1, 0, 0) : phi;\n"
                 "auto R = Eigen::AngleAxis<S>(phi.norm(), n.normalized()).toRotationMatrix();",
                 "R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)")},
        {"normalize", PROGRAM("Eigen/Geometry",
                              "using S = {scalar}; S Q[] = {{Q}};\n"
                              "auto q = Eigen::Quaternion<S>(Q[3], Q[0], Q[1], Q[2]).normalized();",
                              "q.x(), q.y(), q.z(), q.w()")},
        {"relative_angle",
         PROGRAM("Eigen/Geometry",
                 "using S = {scalar}; using Q = Eigen::Quaternion<S>; S a[] = {{Q0}}, b[] = {{Q1}};\n"
                 "Q q0(a[3], a[0], a[1], a[2]), q1(b[3], b[0], b[1], b[2]);",
                 "q0.angularDistance(q1)")},
        {"slerp",
         PROGRAM("Eigen/Geometry",
                 "using S = {scalar}; using Q = Eigen::Quaternion<S>; S a[] = {{Q0}}, b[] = {{Q1}};\n"
                 "Q q0(a[3], a[0], a[1], a[2]), q1(b[3], b[0], b[1], b[2]), q = q0.slerp({t}, q1);",
                 "q.x(), q.y(), q.z(), q.w()")},
        {"rotation_between", PROGRAM("Eigen/Geometry",
                                     "using S = {scalar}; Eigen::Matrix<S, 3, 1> a({a}), b({b});\n"
                                     "auto q = Eigen::Quaternion<S>::FromTwoVectors(a, b);",
                                     "q.x(), q.y(), q.z(), q.w()")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(EigenGeometry, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, compose, inverse,
                 act_point, rotate_point, normalize, relative_angle, slerp, rotation_between,
                 quaternion_from_matrix, matrix_from_quaternion, quaternion_product, quaternion_inverse,
                 axis_angle_from_quaternion, axis_angle_from_matrix, quaternion_from_axis_angle,
                 matrix_from_axis_angle)
