// Compares the three precisions with the same code at 50 digits, for |phi| <= pi. Block errors are at most
// 1 eps for tight, 6 for standard, 16 for fast. `liecheck hunt --subject liecheck:tight` covers all angles.

#include <gtest/gtest.h>
#include <random>

#include "fifty_digits.hpp"
#include "scalar_test.hpp"

namespace liecheck {
namespace {

using namespace test;
using Real = Digits50;

/// ||a - b|| / ||b|| of a block, in eps.
template <class S, class A, class B>
double errorInEps(const A& a, const B& b) {
  Real square = 0, size = 0;
  for (int j = 0; j < b.cols(); ++j)
    for (int i = 0; i < b.rows(); ++i) {
      const Real d = Real(a(i, j)) - b(i, j);
      square += d * d, size += b(i, j) * b(i, j);
    }
  return double(sqrt(square / size)) / double(eps<S>());
}
template <class S, Precision P>
double largestError() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double most = 0;
  const auto take = [&most](double e) { most = e <= most ? most : e; };
  for (int n = 0; n < 150; ++n) {
    Vector6<S> x;
    Vector7<S> q;
    for (int i = 0; i < 6; ++i) x[i] = S(uniform(random));
    for (int i = 0; i < 7; ++i) q[i] = S(uniform(random));
    q.template tail<4>() /= q.template tail<4>().norm();
    const double angle = n % 3 == 0 ? 3.14159 : n % 3 == 1 ? std::pow(10, 4 * uniform(random) - 4) : 2;
    x.template tail<3>() *= S(angle) / x.template tail<3>().norm();
    const Vector6<Real> X = x.template cast<Real>();
    const Vector7<Real> Q = q.template cast<Real>();

    const SE3<S> T = exp6<S, P>(Motion<S>(x));
    const SE3<Real> T_exact = exact_exp6(X);
    take(errorInEps<S>(T.rotation(), T_exact.rotation())),
        take(errorInEps<S>(T.translation(), T_exact.translation()));
    const Vector6<S> l = log6<S, P>(T).to_vector();
    const Vector6<Real> l_exact = exact_log6(T.template cast<Real>());
    take(errorInEps<S>(l.template head<3>(), Vector3<Real>(l_exact.template head<3>())));
    take(errorInEps<S>(l.template tail<3>(), Vector3<Real>(l_exact.template tail<3>())));
    const Vector7<S> q1 = integrateSE3<S, P>(q, x);
    const Vector7<Real> q1_exact = exact_integrate(Q, X);
    take(errorInEps<S>(q1.template tail<4>(), Vector4<Real>(q1_exact.template tail<4>())));
    const Vector6<S> d = differenceSE3<S, P>(q, q1);
    const Vector6<Real> d_exact = exact_difference(Q, Vector7<Real>(q1.template cast<Real>()));
    take(errorInEps<S>(d.template tail<3>(), Vector3<Real>(d_exact.template tail<3>())));
    const Matrix6<S> J = leftJacobian<S, P>(Motion<S>(x)), K = leftJacobianInverse<S, P>(Motion<S>(x));
    const Matrix6<Real> J_exact = exact_left_jacobian(X), K_exact = exact_left_jacobian_inverse(X);
    for (const int column : {0, 3}) {
      take(errorInEps<S>(Matrix3<S>(J.template block<3, 3>(0, column)),
                         Matrix3<Real>(J_exact.template block<3, 3>(0, column))));
      take(errorInEps<S>(Matrix3<S>(K.template block<3, 3>(0, column)),
                         Matrix3<Real>(K_exact.template block<3, 3>(0, column))));
    }
  }
  return most;
}
SCALAR_SUITE(PrecisionOf, float, double);

SCALAR_TEST(PrecisionOf, StaysWithinItsErrorBound) {
  EXPECT_LE((largestError<S, Precision::tight>()), 1);
  EXPECT_LE((largestError<S, Precision::standard>()), 6);
  EXPECT_LE((largestError<S, Precision::fast>()), 16);
  EXPECT_GT((largestError<S, Precision::fast>()), (largestError<S, Precision::tight>()));
}

/// If the logarithm were rounded in between, the coupling block would err by 0.83 eps.
TEST(Precision, TightJlog6IsRoundedOnce) {
  using S = float;
  Vector6<S> x;
  x << 0x1.02bd28p+0f, -0x1.9bdc4cp-1f, -0x1.4a5bdep-3f, 0x1.b8a02ap+0f, 0x1.274236p+1f, -0x1.700ff4p-1f;
  const SE3<S> T = exp6<S>(Motion<S>(x));
  const Matrix6<S> J = Jlog6<S, Precision::tight>(T);
  const Matrix6<Real> exact = exact_Jlog6(T.cast<Real>());
  EXPECT_LE(errorInEps<S>(Matrix3<S>(J.topRightCorner<3, 3>()), Matrix3<Real>(exact.topRightCorner<3, 3>())),
            0.5);
}

SCALAR_TEST(PrecisionOf, TightIsFiniteIfItsProductsOverflow) {
  const S most = std::numeric_limits<S>::max() / 4;
  Vector6<S> x;
  x << most, S(0), S(0), S(0), S(0), S(1);
  EXPECT_LE(errorInEps<S>(exp6<S, Precision::tight>(Motion<S>(x)).translation(),
                          exact_exp6(Vector6<Real>(x.template cast<Real>())).translation()),
            4);
}

TEST(DoubleWord, SineAndCosineHaveUnitNorm) {
  using D = DoubleWord<double>;
  for (const double a : {3.5, 100.0, 1e8, 1e300}) {
    const D s = sin(D(a)), c = cos(D(a)), defect = s * s + c * c - D(1);
    EXPECT_LE(std::abs(defect.high), 0x1p-101) << a;
    EXPECT_NEAR(s.high, std::sin(a), 0x1p-52);
    EXPECT_NEAR(c.high, std::cos(a), 0x1p-52);
  }
}

TEST(DoubleWord, HasTwiceTheDigits) {
  using D = DoubleWord<double>;
  const D third = D(1) / D(3), root = sqrt(D(2));
  const auto defect = [](const D& a) { return std::abs(a.high + a.low); };
  EXPECT_LE(defect(third * D(3) - D(1)), 0x1p-103);
  EXPECT_LE(defect(root * root - D(2)), 0x1p-102);
  EXPECT_EQ((D(1) + D(0x1p-80) - D(1)).high, 0x1p-80);
  EXPECT_TRUE(third < root && D(1) > third && D(2) == D(1) + D(1));
  EXPECT_EQ(double(sqrt(D(0))), 0);
}

}  // namespace
}  // namespace liecheck
