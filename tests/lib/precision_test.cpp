// The precisions of spatial and multibody, and scalar/double_word.hpp: what campaigns of liecheck:tight and
// liecheck:fast do not measure.

#include <gtest/gtest.h>

#include <liecheck/multibody/se3_configuration.hpp>

#include "scalar_test.hpp"

namespace liecheck {
namespace {

/// Compares the coupling block with that of double, whose error is below 1e-8 eps of float. If the logarithm were
/// rounded in between, the block would err by 0.83 eps.
TEST(Precision, TightJlog6IsRoundedOnce) {
  Vector6<float> x;
  x << 0x1.02bd28p+0f, -0x1.9bdc4cp-1f, -0x1.4a5bdep-3f, 0x1.b8a02ap+0f, 0x1.274236p+1f, -0x1.700ff4p-1f;
  const SE3<float> T = exp6<float>(Motion<float>(x));
  const Matrix3<double> exact = Jlog6<double>(T.cast<double>()).topRightCorner<3, 3>();
  const Matrix3<float> block = Jlog6<float, Precision::tight>(T).topRightCorner<3, 3>();
  EXPECT_LE((block.cast<double>() - exact).norm() / exact.norm(), 0.5 * double(eps<float>()));
}

SCALAR_SUITE(PrecisionOf, float, double);

SCALAR_TEST(PrecisionOf, TightIsFiniteIfItsProductsOverflow) {
  const S most = std::ldexp(S(1), std::numeric_limits<S>::max_exponent - 2);
  const auto translation = [](S rho) {
    return exp6<S, Precision::tight>(Motion<S>(Vector3<S>(rho, S(0), S(0)), Vector3<S>(S(0), S(0), S(1))))
        .translation();
  };
  const Vector3<S> p = translation(S(1));
  EXPECT_LE((translation(most) / most - p).norm(), 4 * eps<S>() * p.norm());
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
