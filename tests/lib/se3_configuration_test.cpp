// multibody/se3_configuration.hpp: the functions of a free-flyer. Campaigns measure them at all angles.

#include <gtest/gtest.h>

#include "generic_pose.hpp"
#include "scalar_test.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

SCALAR_SUITE(Se3Configuration, float, double);

SCALAR_TEST(Se3Configuration, AnIncrementOfZeroChangesNothing) {
  const Vector7<S> q = generic<S>();
  EXPECT_EQ(integrateSE3<S>(q, Vector6<S>::Zero()).template head<3>(), q.template head<3>());
  EXPECT_LE(error(integrateSE3<S>(q, Vector6<S>::Zero()), q), 2 * eps<S>());
  EXPECT_EQ(differenceSE3<S>(q, q), (Vector6<S>::Zero()));
}

TEST(Difference, NearThetaEqualToPiTheSignOfTheAxisNeedsAScalarPartOfTwiceTheDigits) {
  // Q0 . Q1 = -1.2e-37 is a sum of products of size 0.5. The axis is therefore that of Q0* (-Q1).
  Vector7<double> q0 = Vector7<double>::Zero(), q1 = q0;
  q0.tail<4>() << 0x1.3ac88f7ecf59fp-34, -0x1.84b28381d982dp-1, -0x1.1c1b307817c84p-49, 0x1.4d41166cb9cc6p-1;
  q1.tail<4>() << -0x1.1c1b307818c9dp-49, -0x1.4d41166cb9cc6p-1, -0x1.3ac88f7ecf59fp-34,
      -0x1.84b28381d982dp-1;
  const Vector6<double> d = differenceSE3<double>(q0, q1);
  const Eigen::Quaterniond Q0(q0[6], q0[3], q0[4], q0[5]), Q1(q1[6], q1[3], q1[4], q1[5]);
  EXPECT_LT(d.tail<3>().dot((Q0.conjugate() * Q1).vec()), 0);
  EXPECT_LT(d.tail<3>().norm(), pi<double>() + 1e-15);
  const double w = exact_dot<double, 4>(q0.tail<4>(), q1.tail<4>());
  EXPECT_NEAR(w, -1.2e-37, 0.1e-37);
}
SCALAR_TEST(Se3Configuration, NearThetaEqualToPiTheSignOfTheAxisIsRightIfTheScalarPartUnderflows) {
  // Q0 . Q1 is -tiny^2 or +tiny^2, which underflows to zero in S.
  const S tiny = std::numeric_limits<S>::denorm_min() > S(0) ? std::numeric_limits<S>::denorm_min()
                                                             : std::numeric_limits<S>::min();
  for (const S sign : {S(-1), S(1)}) {
    Vector7<S> q0 = Vector7<S>::Zero(), q1 = q0;
    q0[3] = sign * tiny, q0[6] = S(1), q1[3] = tiny, q1[5] = S(1);
    const Vector6<S> d = differenceSE3<S>(q0, q1);
    EXPECT_LE(error(d.template tail<3>(), Vector3<S>(S(0), S(0), sign * pi<S>())), 4 * eps<S>());
  }
}
TEST(ExactDot, KeepsTheSignThroughChainsOfCancellations) {
  using Vector = Eigen::Matrix<float, 4, 1>;
  const float u = 0x1p-23f;
  // (1 + u)^2 - (1 + 2 u) - u^2 + 2^-100 t = 2^-100 t for every t.
  for (const float t : {0x1p-100f, 0x1p-149f, -0x1p-60f, -0x1p-130f}) {
    const Vector a(1 + u, -(1 + 2 * u), -u, t), b(1 + u, 1, u, 0x1p-100f);
    const float d = exact_dot<float, 4>(a, b), exact = t * 0x1p-100f;
    EXPECT_EQ(d, std::abs(exact) < 0x1p-126f ? std::copysign(0x1p-126f, t) : exact) << t;
    EXPECT_EQ((exact_dot<float, 4>(a.reverse(), b.reverse())), d);
  }
}

TEST(ExactDot, KeepsAProductThatIsSmallComparedWithACancelledSum) {
  // (1 + e)(1 - e) - 1 = -e^2. The third product is 2^-15 of this, too small for the first pass.
  const Vector4<double> a(1 + 0x1p-52, -1, 0x1p-59, 0), b(1 - 0x1p-52, 1, 0x1p-60, 0);
  EXPECT_EQ((exact_dot<double, 4>(a, b)), -0x1p-104 + 0x1p-119);
  const Vector4<float> c(1 + 0x1p-23f, -1, 0x1p-30f, 0), d(1 - 0x1p-23f, 1, 0x1p-31f, 0);
  EXPECT_EQ((exact_dot<float, 4>(c, d)), -0x1p-46f + 0x1p-61f);
}
/// The rotation vector in long double. The vector part of Q0* Q1 is computed from Q1 - Q0. For quaternions in
/// double its error is at most 2^-11 eps |Q1 - Q0|. Precondition: 0 < |phi| < pi.
template <class S>
Eigen::Matrix<long double, 3, 1> nearRotation(const Vector7<S>& q0, const Vector7<S>& q1) {
  using L4 = Eigen::Matrix<long double, 4, 1>;
  using L3 = Eigen::Matrix<long double, 3, 1>;
  const L4 a = q0.template tail<4>().template cast<long double>(),
           b = q1.template tail<4>().template cast<long double>();
  const L4 d = b - a;
  const L3 av = a.template head<3>(), dv = d.template head<3>();
  const L3 v = a[3] * dv - d[3] * av - av.cross(dv);
  return 2 * std::atan2(v.norm(), a.dot(b)) / v.norm() * v;
}

// The coefficients of Q0 are nearly equal, and those of Q1 are three ulp larger. Q1 - Q0 is thus almost
// parallel to Q0, and the vector part of Q0* (Q1 - Q0) cancels to a thousandth (a millionth in double).
SCALAR_TEST(Se3Configuration, QuaternionsThatDifferMainlyInNormKeepTheirSmallRotation) {
  const S a = std::cbrt(eps<S>()) / 8;
  Vector7<S> q0 = Vector7<S>::Zero(), q1 = Vector7<S>::Zero();
  q0.template tail<4>() << S(0.5) + a / 7, S(0.5) + a / 3, S(0.5) + a * 5 / 7, S(0.5) + a;
  q1.template tail<4>() = q0.template tail<4>() + Vector4<S>::Constant(3 * eps<S>() / 2);
  const auto expected = nearRotation<S>(q0, q1);
  const Vector3<S> phi = differenceSE3<S>(q0, q1).template tail<3>();
  EXPECT_GT(phi.norm(), S(0));
  EXPECT_LT(phi.norm(), 2 * eps<S>());
  EXPECT_LE(error(phi.template cast<long double>(), expected),
            4 * eps<S>() * expected.norm() + eps<S>() * eps<S>() / 256);
}

}  // namespace
