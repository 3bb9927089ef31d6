// lib/liecheck/spatial: worked examples, and identities that do not use the function under test.

#include <gtest/gtest.h>

#include <cmath>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/inertia.hpp>
#include <liecheck/spatial/jacobians.hpp>
#include <numbers>

#include "random_tree.hpp"

namespace liecheck {
namespace {

using V3 = Vector3<double>;
constexpr double pi_d = std::numbers::pi;
constexpr double e = std::numeric_limits<double>::epsilon();

TEST(Exponential, OfAUnitTranslationAndARotationOfHalfPiEndsAtTwoOverPi) {
  const auto T = exp6<double>(Motion<double>(V3(1, 0, 0), V3(0, 0, pi_d / 2)));
  EXPECT_LE((T.translation() - V3(2 / pi_d, 2 / pi_d, 0)).norm(), 4 * e);  // budget of exp6, translation
}

TEST(Exponential, OfZeroIsTheIdentityExactly) {
  const auto T = exp6<double>(Motion<double>::Zero());
  EXPECT_EQ(T.rotation(), Matrix3<double>::Identity());
  EXPECT_EQ(T.translation(), V3::Zero());
}

TEST(ActionMatrices, OfForcesIsTheInverseTransposeOfThatOfMotions) {
  const auto T = exp6<double>(Motion<double>(V3(1, 2, 3), V3(0.3, -0.2, 0.9)));
  const Matrix6<double> product = T.toActionMatrix().transpose() * T.toDualActionMatrix();
  EXPECT_LE((product - Matrix6<double>::Identity()).norm(), 64 * e);  // 6 x 6 matrices of entries up to 4
}

TEST(CrossProducts, AreProductsWithTheMatricesOfTheAdjointAndOfItsDual) {
  const Motion<double> V(V3(1, -2, 3), V3(4, 5, -6)), W(V3(7, 8, 9), V3(-1, 2, 5));
  const Force<double> F(V3(2, 3, 4), V3(5, -7, 1));
  const Matrix6<double> ad = V.toActionMatrix(), dual = V.toDualActionMatrix();
  EXPECT_EQ(ad * W.to_vector(), V.cross(W).to_vector());  // small whole numbers: exact
  EXPECT_EQ(dual * F.to_vector(), V.cross(F).to_vector());
  EXPECT_EQ(dual, -ad.transpose());
  EXPECT_EQ(ad * V.to_vector(), Vector6<double>::Zero());
  // d/dt Ad(exp(t V)) = ad_V at t = 0: the difference has an error of |t ad_V|^3 / 6t, and rounding errors of
  // eps/t times the largest entry of Ad, which is 1.
  const double t = 0x1p-20, size = ad.norm();
  const Matrix6<double> rate =
      (exp6<double>(V * t).toActionMatrix() - exp6<double>(V * -t).toActionMatrix()) / (2 * t);
  EXPECT_LE((rate - ad).norm(), size * size * size * t * t / 6 + 36 * e / t);
}

TEST(FirstOrderNormalisation, HasTheDocumentedErrorAndKeepsTheRotation) {
  using Long = Eigen::Matrix<long double, 4, 1>;
  const Vector4<double> unit = Vector4<double>(0.1, -0.7, 0.3, 0.4).normalized();
  for (double excess = 0.5; excess > 1e-17; excess /= 2)
    for (const double d : {excess, -excess}) {
      const Vector4<double> Q = unit * std::sqrt(1 + d);
      const Long stored = Q.cast<long double>(),
                 result = SO3<double>(Q).firstOrderNormalized().to_vector().cast<long double>();
      const double size = std::abs(double(stored.squaredNorm() - 1)), short_of_1 = double(1 - result.norm());
      EXPECT_GE(short_of_1, -3 * e) << d;
      EXPECT_LE(short_of_1, 0.375 * size * size * (1 + size) + 3 * e) << d;
      // twice the distance of the unit quaternions is the angle between the rotations
      EXPECT_LE(double((result.normalized() - stored.normalized()).norm()) * 2, e) << d;
    }
}

TEST(InertiaOfABody, MayBeInvalidAlthoughItsEntriesArePositive) {
  const auto with = [](double a, double b, double c) {
    return Inertia<double>(1, V3::Zero(), V3(a, b, c).asDiagonal().toDenseMatrix());
  };
  EXPECT_TRUE(with(1, 1, 1).isValid());
  EXPECT_TRUE(with(0, 1, 1).isValid());     // a needle
  EXPECT_FALSE(with(1, 1, 2.1).isValid());  // violates the triangle inequality
  EXPECT_FALSE(with(-1, 1, 1).isValid());
  EXPECT_FALSE(Inertia<double>(0, V3::Zero(), Matrix3<double>::Identity()).isValid());
  EXPECT_FALSE(Inertia<double>(NAN, V3::Zero(), Matrix3<double>::Identity()).isValid());
}

TEST(Inertia, WhyUnphysicalNamesTheReason) {
  const auto of = [](double m, const V3& moments) {
    const Matrix3<double> R = exp3<double>(V3(0.3, -0.4, 0.5)), I = R * moments.asDiagonal() * R.transpose();
    return Inertia<double>(m, V3(0.1, 0, 0), Matrix3<double>((I + I.transpose()) / 2));
  };
  EXPECT_EQ(whyUnphysical(of(2, {0.02, 0.05, 0.06})), "");
  EXPECT_EQ(whyUnphysical(of(2, {0.02, 0.05, 0.07})), "");  // a flat plate
  EXPECT_EQ(whyUnphysical(of(0, {0, 0, 0})), "");
  EXPECT_TRUE(
      whyUnphysical(of(2, {0.02, 0.03, 0.06})).starts_with("a principal moment of inertia is larger"));
  EXPECT_TRUE(
      whyUnphysical(of(2, {-0.02, 0.05, 0.05})).starts_with("a principal moment of inertia is negative"));
  EXPECT_TRUE(whyUnphysical(of(-2, {0.02, 0.05, 0.06})).starts_with("the mass is negative: -2"));
  EXPECT_TRUE(
      whyUnphysical(of(2, {0.02, 0.05, INFINITY})).starts_with("a number of the inertia is not finite: "));
  Matrix3<double> crooked = of(2, {0.02, 0.05, 0.06}).inertia();
  crooked(0, 1) += 1e-3;
  EXPECT_TRUE(whyUnphysical(Inertia<double>(2, V3::Zero(), crooked))
                  .starts_with("the inertia is not symmetric: two products of inertia are "));
}
TEST(Inertia, ThePseudoInertiaIsPositiveIfAndOnlyIfTheInertiaIsPhysical) {
  test::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const V3 moments = random.vector(1).cwiseAbs();
    const Matrix3<double> R = exp3<double>(random.vector(3)), I = R * moments.asDiagonal() * R.transpose();
    const Inertia<double> body(random.uniform(0.1, 3), random.vector(0.3),
                               Matrix3<double>((I + I.transpose()) / 2));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(pseudoInertia(body));
    if (std::abs(solver.eigenvalues()[0]) < 1e-12) continue;
    EXPECT_EQ(solver.eigenvalues()[0] > 0, whyUnphysical(body).empty());
  }
  // A uniform rod of 1 kg along x from 0 to 2 m has the second moment 4/3 and the first moment 1.
  const Inertia<double> rod(1, V3(1, 0, 0), Matrix3<double>(V3(0, 1 / 3.0, 1 / 3.0).asDiagonal()));
  EXPECT_NEAR(pseudoInertia(rod)(0, 0), 4 / 3.0, 4 * eps<double>());
  EXPECT_EQ(pseudoInertia(rod)(0, 3), 1);
}

}  // namespace
}  // namespace liecheck
