// The quaternion product on Quad, which is a vector register or an array, for translations of any size.

#include <gtest/gtest.h>

#include <liecheck/multibody/se3_configuration.hpp>
#include <liecheck/scalar/double_word.hpp>
#include <random>

#include "scalar_test.hpp"

namespace liecheck {
namespace {

SCALAR_SUITE(QuaternionProductOf, float, double, DoubleWord<double>);

SCALAR_TEST(QuaternionProductOf, PermuteReordersTheNumbersOfAQuad) {
  const auto q = permute<2, 0, 3, 3>(Quad<S>(S(1), S(2), S(3), S(4)));
  EXPECT_EQ(double(q.v[0]), 3);
  EXPECT_EQ(double(q.v[1]), 1);
  EXPECT_EQ(double(q.v[2]), 4);
  EXPECT_EQ(double(q.v[3]), 4);
  EXPECT_EQ(double(sum(q)), 12);
}

/// The products of the units 1, i, j, k. unit(0) = 1 is the unit of w.
SCALAR_TEST(QuaternionProductOf, ProductOfUnitsIsHamiltons) {
  const auto unit = [](int i) { return Vector4<S>(S(i == 1), S(i == 2), S(i == 3), S(i == 0)); };
  constexpr int table[4][4] = {
      {1, 2, 3, 4}, {2, -1, 4, -3}, {3, -4, -1, 2}, {4, 3, -2, -1}};  // sign times (index + 1)
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const auto sum = se3_configuration_detail::Product<S, Precision::standard>(SO3<S>(unit(a)).numbers(),
                                                                                 SO3<S>(unit(b)).numbers())
                           .sum.value();
      const int expected = table[a][b], sign = expected < 0 ? -1 : 1;
      const Vector4<S> c = unit(sign * expected - 1);
      for (int i = 0; i < 4; ++i)
        EXPECT_EQ(double(sum.v[i]), sign * double(c[i])) << a << ' ' << b << ' ' << i;
    }
}

/// Compares rounded products with double words. The error of high + low is of size eps sqrt(eps).
TEST(QuaternionProduct, HasTwiceTheDigits) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double worst = 0;
  for (int n = 0; n < 2000; ++n) {
    Vector4<double> a, b;
    for (int i = 0; i < 4; ++i) a[i] = uniform(random), b[i] = uniform(random);
    a.normalize(), b.normalize();
    const auto sum = se3_configuration_detail::Product<double, Precision::standard>(SO3<double>(a).numbers(),
                                                                                    SO3<double>(b).numbers())
                         .sum;
    const auto low = sum.low();
    using D = DoubleWord<double>;
    const D x(a[0]), y(a[1]), z(a[2]), w(a[3]);
    const D exact[4] = {w * D(b[0]) + x * D(b[3]) + y * D(b[2]) - z * D(b[1]),
                        w * D(b[1]) + y * D(b[3]) + z * D(b[0]) - x * D(b[2]),
                        w * D(b[2]) + z * D(b[3]) + x * D(b[1]) - y * D(b[0]),
                        w * D(b[3]) - x * D(b[0]) - y * D(b[1]) - z * D(b[2])};
    for (int i = 0; i < 4; ++i) {
      const double error = double((D(sum.high.v[i]) + D(low.v[i])) - exact[i]);
      worst = std::max(worst, std::abs(error));
    }
  }
  // The bound is 8 rounding errors of the low parts, which are of size 2^-26.
  EXPECT_LE(worst, 8 * std::ldexp(eps<double>(), -26));
}

/// Translations are scaled down if splitting them would overflow. The results stay as accurate.
SCALAR_TEST(QuaternionProductOf, TranslationsNearTheEndOfTheRangeKeepTheirDigits) {
  if constexpr (std::is_floating_point_v<S>) {
    const S huge = std::numeric_limits<S>::max() / S(16), far = S(1) / std::numeric_limits<S>::max_exponent;
    const S less = std::ldexp(S(1), std::numeric_limits<S>::digits / 2 + 8);  // huge / less can be split
    Vector7<S> q0, near0;
    q0 << huge, -huge / S(3), S(0), S(0.5), S(0.5), S(-0.5), S(0.5);
    Vector6<S> delta;
    delta << huge / S(2), huge / S(5), -huge, S(1), far, S(-2);
    near0 = q0;
    near0.template head<3>() /= less;
    Vector6<S> small = delta;
    small.template head<3>() /= less;
    Vector7<S> far1 = integrateSE3<S>(q0, delta), near1 = integrateSE3<S>(near0, small);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(double(far1[i] / less), double(near1[i]), double(eps<S>()) * double(huge / less));
    const Vector6<S> back = differenceSE3<S>(q0, far1), near_back = differenceSE3<S>(near0, near1);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(double(back[i] / less), double(near_back[i]), 4 * double(eps<S>()) * double(huge / less));
    const SO3<S> Q(Vector4<S>(q0.template tail<4>()));
    const Vector3<S> p(huge, huge, -huge), near_p = p / less, far_p = Q.act(p), small_p = Q.act(near_p);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(far_p[i] / less, small_p[i]);
  }
}

}  // namespace
}  // namespace liecheck
