#pragma once
// A library whose poses are (p, Q), as an adapter. Its faults at w < 0 are those of code that forgets that Q and -Q are the
// same rotation.

#include <liecheck_adapter.hpp>

#include <array>
#include <liecheck/multibody/se3_configuration.hpp>

namespace liecheck::test {

/// `fault` names the operation that is wrong where w < 0, or is "".
struct QuaternionPoses {
  static constexpr const char *version = "1", *conventions = "quaternion: wxyz, pose form: quaternion";
  const char *name = "quaternion_poses", *fault = "";
  std::array<int, 2> seen{};  ///< poses with w >= 0 and with w < 0

  using Quaternion = Eigen::Quaterniond;
  using Vector = Eigen::Vector3d;
  struct Pose {
    Vector p;
    Quaternion Q;
    Vector times(const Vector& x) const { return Q.toRotationMatrix() * x + p; }
  };
  Pose pose(std::span<const double> x) {
    ++seen[x[3] < 0];
    return {Vector(x[0], x[1], x[2]), Quaternion(x[3], x[4], x[5], x[6])};
  }
  static void put(const Pose& X, std::span<double, 7> y) {
    const double numbers[] = {X.p.x(), X.p.y(), X.p.z(), X.Q.w(), X.Q.x(), X.Q.y(), X.Q.z()};
    std::copy_n(numbers, 7, y.begin());
  }
  static Eigen::Matrix<double, 7, 1> configuration(const Pose& X) {
    Eigen::Matrix<double, 7, 1> q;
    q << X.p, X.Q.coeffs();
    return q;
  }
  bool wrong(std::string_view operation, const Pose& X) const { return fault == operation && X.Q.w() < 0; }

  void log6(std::span<const double, 7> x, std::span<double, 6> xi) {
    const Pose X = pose(x), one{Vector::Zero(), Quaternion::Identity()};
    Eigen::Map<Eigen::Matrix<double, 6, 1>> y(xi.data());
    y = liecheck::differenceSE3<double>(configuration(one), configuration(X));
    if (wrong("log6", X)) y.tail<3>() *= 2;
  }
  void exp6(std::span<const double, 6> xi, std::span<double, 7> y) {
    const Pose one{Vector::Zero(), Quaternion::Identity()};
    const Eigen::Matrix<double, 7, 1> q = liecheck::integrateSE3<double>(
        configuration(one), Eigen::Map<const Eigen::Matrix<double, 6, 1>>(xi.data()));
    put({q.head<3>(), Quaternion(q[6], q[3], q[4], q[5])}, y);
  }
  void compose(std::span<const double, 14> x, std::span<double, 7> y) {
    const Pose X = pose(x.first(7)), Y = pose(x.last(7));
    Pose XY{X.times(Y.p), X.Q * Y.Q};
    if (wrong("compose", Y)) XY.Q = XY.Q * Quaternion(0.6, 0.8, 0, 0);
    put(XY, y);
  }
  void inverse(std::span<const double, 7> x, std::span<double, 7> y) {
    const Pose X = pose(x);
    Pose inverse{-(X.Q.conjugate().toRotationMatrix() * X.p), X.Q.conjugate()};
    if (wrong("inverse", X)) inverse.p = -inverse.p;
    put(inverse, y);
  }
  void act_point(std::span<const double, 10> x, std::span<double, 3> y) {
    const Pose X = pose(x.first(7));
    const Vector x_A = X.times(Vector(x[7], x[8], x[9])) * (wrong("act_point", X) ? 2 : 1);
    std::copy_n(x_A.data(), 3, y.begin());
  }
};
}  // namespace liecheck::test
