// se3_configuration.hpp: the difference of poses that store rotation matrices, against the oracles.

#include <gtest/gtest.h>

#include <cmath>
#include <liecheck/multibody/se3_configuration.hpp>
#include <oracles/log.hpp>
#include <random>

namespace liecheck {
namespace {

template <class S>
class PoseDifference : public testing::Test {
 protected:
  using Real100 = oracles::Real100;
  std::mt19937_64 random{11};
  std::normal_distribution<double> normal;

  Vector3<S> vector() { return Vector3<S>(S(normal(random)), S(normal(random)), S(normal(random))); }
  /// A pose and another one at the given angle, stored as matrices.
  std::pair<SE3<S>, SE3<S>> poses(double angle, double distance) {
    Vector7<S> q0;
    q0 << vector(), S(normal(random)), vector();
    q0.template tail<4>().normalize();
    Vector6<S> delta;
    delta << S(distance) * vector(), S(angle) * vector().normalized();
    const Vector7<S> q1 = integrateSE3<S>(q0, delta);
    return {stored(q0), stored(q1)};
  }
  static SE3<S> stored(const Vector7<S>& q) {
    return SE3<S>(SO3<S>(Vector4<S>(q.template tail<4>())), q.template head<3>());
  }
  static oracles::Quaternion<Real100> nearest(const Matrix3<S>& R) {
    oracles::Mat3<Real100> exact;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) exact(i, j) = Real100(R(i, j));
    const auto result = oracles::nearest_quaternion(exact);
    EXPECT_TRUE(result.resolved);
    return result.Q;
  }
  struct Errors {
    double angular, linear;  ///< [eps] of |phi|, and of max(|rho|, |p1 - p0|)
  };
  static Errors errors(const Motion<S>& computed, const SE3<S>& T0, const SE3<S>& T1) {
    const auto Q0 = nearest(T0.rotation()), Q1 = nearest(T1.rotation());
    oracles::Vec3<Real100> p;
    for (int i = 0; i < 3; ++i) p[i] = Real100(T1.translation()[i]) - Real100(T0.translation()[i]);
    const auto exact = oracles::log_of(oracles::conjugate_product(Q0, Q1), oracles::rotate(Q0, p, true));
    EXPECT_TRUE(exact.resolved);
    const auto distance = [](const Vector3<S>& a, const oracles::Vec3<>& b) {
      double square = 0;
      for (int i = 0; i < 3; ++i) {
        const double d = double(oracles::Real(a[i]) - b[i]);
        square += d * d;
      }
      return std::sqrt(square) / double(eps<S>());
    };
    const double scale = std::max(double(oracles::norm(exact.rho)), double(oracles::norm(p)));
    return {distance(computed.angular(), exact.phi) / double(oracles::norm(exact.phi)),
            distance(computed.linear(), exact.rho) / scale};
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PoseDifference, Scalars);

TYPED_TEST(PoseDifference, ErrsByOneEpsAtEveryAngleAndDistance) {
  using S = TypeParam;
  const double small = double(eps<S>());
  for (const double angle : {16 * small, std::sqrt(small), 1e-2, 1.0, 3.0, 3.14, 3.1415926535 - 1e3 * small})
    for (const double distance : {1e-5, 1e-3, 1.0, 1e3})
      for (int n = 0; n < 20; ++n) {
        const auto [T0, T1] = this->poses(angle, distance);
        const auto e = this->errors(difference(T0, T1), T0, T1);
        EXPECT_LE(e.angular, 1) << angle << ' ' << distance;
        EXPECT_LE(e.linear, 1) << angle << ' ' << distance;
      }
}

TYPED_TEST(PoseDifference, OfAPoseAndItselfIsZero) {
  using S = TypeParam;
  const auto T = this->poses(1, 1).first;
  EXPECT_EQ(difference(T, T).to_vector(), Vector6<S>::Zero());
}

// Why difference exists: the chain loses the digits of a small angle.
TYPED_TEST(PoseDifference, TheChainOfProductAndLogarithmErrsFarMore) {
  using S = TypeParam;
  const double small = double(eps<S>());
  double most = 0;
  for (int n = 0; n < 20; ++n) {
    const auto [T0, T1] = this->poses(std::sqrt(small), 1);
    most = std::max(most, this->errors(log6(T0.actInv(T1)), T0, T1).angular);
  }
  EXPECT_GT(most, 100);
}

}  // namespace
}  // namespace liecheck
