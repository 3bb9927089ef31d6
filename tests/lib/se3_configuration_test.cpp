// multibody/se3_configuration.hpp: the functions of a free-flyer.
//
// Expected values are computed by hand or by central differences. Campaigns measure accuracy at all angles.

#include <gtest/gtest.h>

#include <numbers>

#include "generic_pose.hpp"
#include "scalar_test.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

template <class S>
constexpr S half_pi = std::numbers::pi_v<S> / 2;

/// The neutral configuration of a free-flyer.
template <class S>
Vector7<S> identity() {
  return Vector7<S>::Unit(6);
}
/// A free-flyer at p, rotated about z by angle.
template <class S>
Vector7<S> yawed(S angle, const Vector3<S>& p = Vector3<S>::Zero()) {
  Vector7<S> q;
  q << p, S(0), S(0), std::sin(angle / 2), std::cos(angle / 2);
  return q;
}
SCALAR_SUITE(Se3Configuration, float, double);

// The path is an arc, not a translation followed by a rotation.
SCALAR_TEST(Se3Configuration, IntegrateFromTheIdentityEndsOnTheArc) {
  Vector6<S> d;
  d << S(1), S(0), S(0), S(0), S(0), half_pi<S>;
  const Vector7<S> q = integrateSE3<S>(identity<S>(), d);
  const S reach = 1 / half_pi<S>;
  EXPECT_LE(error(q.template head<3>(), Vector3<S>(reach, reach, S(0))), 4 * eps<S>());
  EXPECT_LE(error(q.template tail<4>(), yawed(half_pi<S>).template tail<4>()), 4 * eps<S>());
}

SCALAR_TEST(Se3Configuration, AtAYawOf90DegreesBodyXMovesAlongWorldY) {
  const Vector3<S> p(S(1), S(2), S(3));
  const Vector7<S> q = integrateSE3<S>(yawed(half_pi<S>, p), Vector6<S>::Unit(0));
  EXPECT_LE(error(q.template head<3>(), Vector3<S>(S(1), S(3), S(3))), 8 * eps<S>());
}

SCALAR_TEST(Se3Configuration, AnIncrementOfZeroChangesNothing) {
  const Vector7<S> q = generic<S>();
  EXPECT_EQ(integrateSE3<S>(q, Vector6<S>::Zero()).template head<3>(), q.template head<3>());
  EXPECT_LE(error(integrateSE3<S>(q, Vector6<S>::Zero()), q), 2 * eps<S>());
  EXPECT_EQ(differenceSE3<S>(q, q), (Vector6<S>::Zero()));
}

SCALAR_TEST(Se3Configuration, DifferenceInvertsIntegrateForThetaBelowPi) {
  const Vector6<S> d = increment<S>();
  const Vector6<S> back = differenceSE3<S>(generic<S>(), integrateSE3<S>(generic<S>(), d));
  // The positions, up to 4 m, are rounded too.
  EXPECT_LE(error(back, d), 32 * eps<S>());
}
SCALAR_TEST(Se3Configuration, ForThetaBeyondPiThePoseIsEqualAndTheVectorIsNot) {
  const Vector6<S> d = S(2) * increment<S>();
  const Vector7<S> q1 = integrateSE3<S>(generic<S>(), d);
  const Vector6<S> back = differenceSE3<S>(generic<S>(), q1);
  EXPECT_LE(back.template tail<3>().norm(), pi<S>());
  EXPECT_GT(error(back, d), S(1));
  EXPECT_LE(error(differenceSE3<S>(q1, integrateSE3<S>(generic<S>(), back)), Vector6<S>(Vector6<S>::Zero())),
            64 * eps<S>());
}
SCALAR_TEST(Se3Configuration, TheLinearPartOfDifferenceIsNotTheDifferenceOfPositions) {
  const Vector6<S> d = differenceSE3<S>(identity<S>(), yawed(half_pi<S>, Vector3<S>(S(1), S(0), S(0))));
  // J^-1 (1, 0, 0) at a rotation of pi/2 about z is (pi/4, -pi/4, 0).
  EXPECT_LE(error(d.template head<3>(), Vector3<S>(half_pi<S> / 2, -half_pi<S> / 2, S(0))), 4 * eps<S>());
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
SCALAR_TEST(Se3Configuration, AtThetaEqualToPiDifferenceHasEitherSignOfTheAxis) {
  Vector7<S> q1 = Vector7<S>::Zero();
  q1[5] = S(1);
  const Vector6<S> d = differenceSE3<S>(identity<S>(), q1);
  EXPECT_LE(std::abs(std::abs(d[5]) - pi<S>()), 4 * eps<S>());
  EXPECT_EQ(d.template head<5>().norm(), S(0));
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

SCALAR_TEST(Se3Configuration, DifferenceOfNearPosesIsAccurateRelativeToItself) {
  for (const S angle : {S(0.1), std::cbrt(eps<S>()), std::sqrt(eps<S>()), 16 * eps<S>()}) {
    const Vector7<S> q0 = generic<S>(), q1 = integrateSE3<S>(q0, Vector6<S>(angle * increment<S>()));
    const auto expected = nearRotation<S>(q0, q1);
    const Vector3<S> phi = differenceSE3<S>(q0, q1).template tail<3>();
    EXPECT_LE(error(phi.template cast<long double>(), expected), 4 * eps<S>() * expected.norm()) << angle;
  }
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

SCALAR_TEST(Se3Configuration, DifferenceIsTheSameForQAndMinusQ) {
  const Vector7<S> q0 = generic<S>(), q1 = integrateSE3<S>(q0, increment<S>());
  Vector7<S> opposite = q1;
  opposite.template tail<4>() *= S(-1);
  EXPECT_EQ(differenceSE3<S>(q0, q1), differenceSE3<S>(q0, opposite));
}

SCALAR_TEST(Se3Configuration, IntegrateReturnsTheQuaternionNearerToTheFirstOne) {
  for (const S sign : {S(1), S(-1)}) {
    for (const S angle : {S(0.5), S(3), S(3.3), S(6), S(9), S(20)}) {
      Vector7<S> q = generic<S>();
      q.template tail<4>() *= sign;
      const Vector7<S> next = integrateSE3<S>(q, Vector6<S>(angle * Vector6<S>::Unit(4)));
      EXPECT_GE(next.template tail<4>().dot(q.template tail<4>()), S(0)) << sign << ' ' << angle;
    }
  }
  // w >= 0 is not enforced: a negative w stays negative.
  EXPECT_LT(generic<S>()[6], S(0));
  EXPECT_LT(integrateSE3<S>(generic<S>(), Vector6<S>(S(0.1) * Vector6<S>::Unit(4)))[6], S(0));
}

// c1, c2 and c3 have no cutoff, so the neighbours of every usual cutoff give neighbouring results.
SCALAR_TEST(Se3Configuration, ResultsDoNotJumpAtUsualCutoffsOfSmallAngles) {
  for (const S cutoff : {std::sqrt(eps<S>()), std::sqrt(std::sqrt(eps<S>())), S(1e-8), S(1e-5), S(1e-3)}) {
    Vector6<S> below = increment<S>(), above = increment<S>();
    below.template tail<3>() << S(0), S(0), std::nextafter(cutoff, S(0));
    above.template tail<3>() << S(0), S(0), std::nextafter(cutoff, S(1));
    EXPECT_LE(error(integrateSE3<S>(generic<S>(), below), integrateSE3<S>(generic<S>(), above)),
              16 * eps<S>());
    const Matrix6<S> J0 = dIntegrateSE3<S>(generic<S>(), below, ArgumentPosition::ARG1);
    const Matrix6<S> J1 = dIntegrateSE3<S>(generic<S>(), above, ArgumentPosition::ARG1);
    EXPECT_LE(error(J0, J1), 16 * eps<S>()) << cutoff;
  }
}

SCALAR_TEST(Se3Configuration, FirstOrderNormalizationErrsByThreeEighthsOfTheSquaredDefect) {
  const S defect = std::sqrt(eps<S>()) * 8;
  const Vector4<S> Q = generic<S>().template tail<4>() * std::sqrt(1 + defect);
  const S norm = firstOrderNormalized<S, 4>(Q).norm();
  EXPECT_LE(std::abs((1 - norm) - S(3) / S(8) * defect * defect), 6 * eps<S>());
}
SCALAR_TEST(Se3Configuration, AThousandIncrementsStayOnTheUnitSphere) {
  Vector7<S> q = generic<S>();
  for (int i = 0; i < 1000; ++i) q = integrateSE3<S>(q, increment<S>());
  EXPECT_LE(std::abs(q.template tail<4>().squaredNorm() - 1), 4 * eps<S>());
}

SCALAR_TEST(Se3Configuration, TheCoefficientJacobianIsRAndHalfTheQuaternionProduct) {
  const Vector7<S> q = generic<S>();
  const auto J = integrateCoeffWiseJacobianSE3<S>(q);
  const Vector3<S> v = q.template segment<3>(3), omega(S(0.3), S(-0.5), S(0.7));
  EXPECT_LE(error((J.template topLeftCorner<3, 3>()), SO3<S>(Vector4<S>(q.template tail<4>())).matrix()),
            4 * eps<S>());
  const Vector4<S> rate = J.template bottomRightCorner<4, 3>() * omega;
  Vector4<S> expected;  // Q (omega, 0) / 2
  expected << (q[6] * omega + v.cross(omega)) / 2, -v.dot(omega) / 2;
  EXPECT_LE(error(rate, expected), 4 * eps<S>());
  EXPECT_EQ((J.template topRightCorner<3, 3>().norm() + J.template bottomLeftCorner<4, 3>().norm()), S(0));
}
SCALAR_TEST(Se3Configuration, DIntegrateByTheConfigurationIsTheAdjointOfTheInverseIncrement) {
  const Vector6<S> d = increment<S>();
  const Matrix6<S> J = dIntegrateSE3<S>(generic<S>(), d, ArgumentPosition::ARG0);
  const Matrix6<S> expected = exp6<S>(Motion<S>(d)).inverse().toActionMatrix();
  EXPECT_LE(error(J, expected), 32 * eps<S>());
}

}  // namespace
