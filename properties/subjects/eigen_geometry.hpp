#pragma once
// Subject "eigen": Eigen's Geometry module, and the matrix exponential and logarithm of MatrixFunctions.
// eigen_float.cpp and eigen_double.cpp compile it.

#include <subjects/typed.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

namespace liecheck::properties {

// eigen_functions_float.cpp and eigen_functions_double.cpp compile them.
template <class S>
Eigen::Matrix<S, 4, 4> matrix_exp(const Eigen::Matrix<S, 4, 4>& m);
template <class S>
Eigen::Matrix<S, 4, 4> matrix_log(const Eigen::Matrix<S, 4, 4>& m);

template <class S>
struct EigenGeometry : Types<S> {
  using typename Types<S>::V3, typename Types<S>::V4, typename Types<S>::V6, typename Types<S>::M3;
  using M4 = Mat<S, 4>;

  static Eigen::AngleAxis<S> angle_axis(const V3& phi) {
    const S theta = phi.norm();
    return {theta, theta > S(0) ? V3(phi / theta) : V3(V3::UnitX())};
  }
  static V4 exp3_quaternion(const V3& phi) { return Eigen::Quaternion<S>(angle_axis(phi)).coeffs(); }
  static M3 exp3_matrix(const V3& phi) { return angle_axis(phi).toRotationMatrix(); }
  static V3 log3_quaternion(const V4& Q) {
    const Eigen::AngleAxis<S> a{Eigen::Quaternion<S>(Q)};
    return a.angle() * a.axis();
  }
  static V3 log3_matrix(const M3& R) {
    const Eigen::AngleAxis<S> a{R};
    return a.angle() * a.axis();
  }
  static Pose<S> exp6(const V6& xi) {
    M4 m = M4::Zero();
    m.template topLeftCorner<3, 3>() = hat<S>(xi.template tail<3>());
    m.template topRightCorner<3, 1>() = xi.template head<3>();
    const M4 T = matrix_exp(m);
    return {T.template topLeftCorner<3, 3>(), T.template topRightCorner<3, 1>()};
  }
  static V6 log6(const Pose<S>& X) {
    M4 T = M4::Identity();
    T.template topLeftCorner<3, 3>() = X.R;
    T.template topRightCorner<3, 1>() = X.p;
    const M4 m = matrix_log(T);
    V6 xi;
    xi << m.template topRightCorner<3, 1>(), (m(2, 1) - m(1, 2)) / S(2), (m(0, 2) - m(2, 0)) / S(2),
        (m(1, 0) - m(0, 1)) / S(2);
    return xi;
  }
  using Isometry = Eigen::Transform<S, 3, Eigen::Isometry>;
  static Isometry isometry(const Pose<S>& X) {
    Isometry T;
    T.linear() = X.R, T.translation() = X.p;
    T.makeAffine();
    return T;
  }
  static Pose<S> stored(const Isometry& T) { return {T.linear(), T.translation()}; }
  static Pose<S> compose(const Pose<S>& X, const Pose<S>& Y) { return stored(isometry(X) * isometry(Y)); }
  static Pose<S> inverse(const Pose<S>& X) { return stored(isometry(X).inverse()); }
  static V3 act_point(const Pose<S>& X, const V3& x) { return isometry(X) * x; }
  static V3 rotate_point(const V4& Q, const V3& x) { return Eigen::Quaternion<S>(Q) * x; }

  static S relative_angle(const V4& a, const V4& b) {
    return Eigen::Quaternion<S>(a).angularDistance(Eigen::Quaternion<S>(b));
  }
  static V4 slerp(const V4& a, const V4& b, const S& t) {
    return Eigen::Quaternion<S>(a).slerp(t, Eigen::Quaternion<S>(b)).coeffs();
  }
  static V4 rotation_between(const V3& a, const V3& b) {
    return Eigen::Quaternion<S>::FromTwoVectors(a, b).coeffs();
  }
  /// The product of three AngleAxis, as Eigen's manual forms Euler angles.
  static Eigen::Quaternion<S> euler(const S& order, const V3& x) {
    static constexpr int axes[12][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0},
                                        {0, 1, 0}, {0, 2, 0}, {1, 0, 1}, {1, 2, 1}, {2, 0, 2}, {2, 1, 2}};
    const int n = static_cast<int>(order);
    const auto turn = [&](int i) { return Eigen::AngleAxis<S>(x[i], V3::Unit(axes[n / 2][i])); };
    return n % 2 ? turn(0) * turn(1) * turn(2) : turn(2) * turn(1) * turn(0);
  }
  static V4 euler_to_quaternion(const S& order, const V3& x) { return euler(order, x).coeffs(); }
  static M3 euler_to_matrix(const S& order, const V3& x) { return euler(order, x).toRotationMatrix(); }

  static TypedSubject<S> make() {
    TypedSubject<S> s;
    s.name = "eigen";
    s.version = fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
    s.operations[op::exp3_quaternion] = exp3_quaternion;
    s.operations[op::exp3_matrix] = exp3_matrix;
    s.operations[op::log3_quaternion] = log3_quaternion;
    s.operations[op::log3_matrix] = log3_matrix;
    s.operations[op::exp6] = exp6;
    s.operations[op::log6] = log6;
    s.operations[op::compose] = compose;
    s.operations[op::inverse] = inverse;
    s.operations[op::act_point] = act_point;
    s.operations[op::rotate_point] = rotate_point;
    s.operations[op::relative_angle] = relative_angle;
    s.operations[op::slerp] = slerp;
    s.operations[op::rotation_between] = rotation_between;
    s.operations[op::euler_to_quaternion] = euler_to_quaternion;
    s.operations[op::euler_to_matrix] = euler_to_matrix;
    return s;
  }
};

}  // namespace liecheck::properties
