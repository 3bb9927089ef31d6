// Eigen: Quaternion, AngleAxis and Isometry, in float and double. liecheck has a subject of the same
// functions, "eigen"; this adapter is the example of a library with templates and types of its own.

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
using Matrix = Eigen::Matrix<S, 3, 3>;
template <class S>
using Rows = Eigen::Matrix<S, 3, 3, Eigen::RowMajor>;
template <class S>
using Quaternion = Eigen::Quaternion<S>;
template <class S>
using AngleAxis = Eigen::AngleAxis<S>;
template <class S>
using Isometry = Eigen::Transform<S, 3, Eigen::Isometry>;

template <class S>
Vector<S> vector(const S* x) {
  return Vector<S>(x);
}
template <class S>
Matrix<S> rotation(const S* R) {
  return Eigen::Map<const Rows<S>>(R);
}
template <class S>
Quaternion<S> quaternion(const S* Q) {
  return Quaternion<S>(Q);
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

struct EigenGeometry {
  static constexpr const char *name = "eigen_adapter",
                              *version =
                                  VERSION(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);

  template <class S>
  static auto exp3_quaternion(In<S, 3> phi) {
    return [a = angle_axis(phi)] { return Quaternion<S>(a); };
  }
  template <class S>
  static auto exp3_matrix(In<S, 3> phi) {
    return [a = angle_axis(phi)] { return a.toRotationMatrix(); };
  }
  template <class S>
  static auto log3_quaternion(In<S, 4> Q) {
    return [q = quaternion(&Q[0])] { return AngleAxis<S>(q); };
  }
  template <class S>
  static auto log3_matrix(In<S, 9> R) {
    return [m = rotation(&R[0])] { return AngleAxis<S>(m); };
  }
  template <class S>
  static auto compose(In<S, 24> x) {
    return [X = pose(&x[0]), Y = pose(&x[12])] { return X * Y; };
  }
  template <class S>
  static auto inverse(In<S, 12> x) {
    return [X = pose(&x[0])] { return X.inverse(); };
  }
  template <class S>
  static auto act_point(In<S, 15> x) {
    return [X = pose(&x[0]), p = vector(&x[12])] { return Vector<S>(X * p); };
  }
  template <class S>
  static auto rotate_point(In<S, 7> x) {
    return [q = quaternion(&x[0]), p = vector(&x[4])] { return Vector<S>(q * p); };
  }
  template <class S>
  static auto normalize(In<S, 4> Q) {
    return [q = quaternion(&Q[0])] { return q.normalized(); };
  }
  template <class S>
  static auto relative_angle(In<S, 8> x) {
    return [q0 = quaternion(&x[0]), q1 = quaternion(&x[4])] { return q0.angularDistance(q1); };
  }
  template <class S>
  static auto slerp(In<S, 9> x) {
    return [q0 = quaternion(&x[0]), q1 = quaternion(&x[4]), t = x[8]] { return q0.slerp(t, q1); };
  }
  template <class S>
  static auto rotation_between(In<S, 6> x) {
    return [a = vector(&x[0]), b = vector(&x[3])] { return Quaternion<S>::FromTwoVectors(a, b); };
  }
  template <class S>
  static auto quaternion_from_matrix(In<S, 9> R) {
    return [m = rotation(&R[0])] { return Quaternion<S>(m); };
  }
  template <class S>
  static auto matrix_from_quaternion(In<S, 4> Q) {
    return [q = quaternion(&Q[0])] { return q.toRotationMatrix(); };
  }
  template <class S>
  static auto quaternion_product(In<S, 8> x) {
    return [q0 = quaternion(&x[0]), q1 = quaternion(&x[4])] { return q0 * q1; };
  }
  template <class S>
  static auto quaternion_inverse(In<S, 4> Q) {
    return [q = quaternion(&Q[0])] { return q.inverse(); };
  }
  template <class S>
  static auto axis_angle_from_quaternion(In<S, 4> Q) {
    return log3_quaternion<S>(Q);
  }
  template <class S>
  static auto axis_angle_from_matrix(In<S, 9> R) {
    return log3_matrix<S>(R);
  }
  template <class S>
  static auto quaternion_from_axis_angle(In<S, 4> x) {
    return [a = AngleAxis<S>(x[3], vector(&x[0]))] { return Quaternion<S>(a); };
  }
  template <class S>
  static auto matrix_from_axis_angle(In<S, 4> x) {
    return [a = AngleAxis<S>(x[3], vector(&x[0]))] { return a.toRotationMatrix(); };
  }

  template <class S>
  static void write(const Vector<S>& x, Out<S, 3> to) {
    Vector<S>::Map(&to[0]) = x;
  }
  template <class S>
  static void write(const Matrix<S>& R, Out<S, 9> to) {
    Rows<S>::Map(&to[0]) = R;
  }
  template <class S>
  static void write(const Quaternion<S>& Q, Out<S, 4> to) {
    Eigen::Matrix<S, 4, 1>::Map(&to[0]) = Q.coeffs();
  }
  template <class S>
  static void write(const Isometry<S>& T, Out<S, 12> to) {
    Rows<S>::Map(&to[0]) = T.linear(), Vector<S>::Map(&to[9]) = T.translation();
  }
  template <class S>
  static void write(const AngleAxis<S>& a, Out<S, 3> to) {
    Vector<S>::Map(&to[0]) = a.angle() * a.axis();
  }
  template <class S>
  static void write(const AngleAxis<S>& a, Out<S, 4> to) {
    Vector<S>::Map(&to[0]) = a.axis(), to[3] = a.angle();
  }
  template <class S>
  static void write(S x, Out<S, 1> to) {
    to[0] = x;
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
