// multibody/configuration.hpp, and the functions of the free-flyer that it calls.
//
// Expected values are computed by hand or by central differences. Campaigns measure accuracy at all angles.

#include <gtest/gtest.h>

#include <liecheck/multibody/configuration.hpp>
#include <numbers>

#include "refusal.hpp"
#include "scalar_test.hpp"

namespace {

using namespace liecheck;
using test::has, test::refusal;

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
/// A pose and increments without zeros or symmetry.
template <class S>
Vector7<S> generic() {
  Vector7<S> q;
  q << S(0.3), S(-1.2), S(2.5), SO3<S>(Vector4<S>(S(0.4), S(-0.2), S(0.5), S(-0.7))).normalized().to_vector();
  return q;
}
template <class S>
Vector6<S> increment() {
  Vector6<S> d;
  d << S(0.7), S(-0.4), S(1.1), S(0.9), S(-1.3), S(0.6);
  return d;
}
template <class A, class B>
auto error(const A& a, const B& b) {
  return (a - b).norm();
}

/// A robot whose offsets in q and v differ: a prismatic joint that carries a free-flyer, a continuous joint
/// and a revolute joint.
template <class S>
Model<S> someRobot() {
  Model<S> m;
  const SE3<S> I = SE3<S>::Identity();
  int j = m.addJoint(0, Prismatic<S>(Axis<S>::X()), I, "slide");
  j = m.addJoint(j, FreeFlyer<S>(), I, "floating");
  j = m.addJoint(j, Continuous<S>(Axis<S>::Y()), I, "wheel");
  m.addJoint(j, Revolute<S>(Axis<S>::Z()), I, "flap");
  return m;
}
/// A configuration and an increment of someRobot.
template <class S>
VectorX<S> someConfiguration() {
  VectorX<S> q(11);
  q << S(0.25), generic<S>(), std::cos(S(0.8)), std::sin(S(0.8)), S(-0.5);
  return q;
}
template <class S>
VectorX<S> someIncrement() {
  VectorX<S> d(9);
  d << S(0.1), increment<S>(), S(2), S(0.3);
  return d;
}

SCALAR_SUITE(Configuration, float, double);

// The path is an arc, not a translation followed by a rotation.
SCALAR_TEST(Configuration, IntegrateFromTheIdentityEndsOnTheArc) {
  Vector6<S> d;
  d << S(1), S(0), S(0), S(0), S(0), half_pi<S>;
  const Vector7<S> q = integrateSE3<S>(identity<S>(), d);
  const S reach = 1 / half_pi<S>;
  EXPECT_LE(error(q.template head<3>(), Vector3<S>(reach, reach, S(0))), 4 * eps<S>());
  EXPECT_LE(error(q.template tail<4>(), yawed(half_pi<S>).template tail<4>()), 4 * eps<S>());
}

SCALAR_TEST(Configuration, AtAYawOf90DegreesBodyXMovesAlongWorldY) {
  const Vector3<S> p(S(1), S(2), S(3));
  const Vector7<S> q = integrateSE3<S>(yawed(half_pi<S>, p), Vector6<S>::Unit(0));
  EXPECT_LE(error(q.template head<3>(), Vector3<S>(S(1), S(3), S(3))), 8 * eps<S>());
}

SCALAR_TEST(Configuration, AnIncrementOfZeroChangesNothing) {
  const Vector7<S> q = generic<S>();
  EXPECT_EQ(integrateSE3<S>(q, Vector6<S>::Zero()).template head<3>(), q.template head<3>());
  EXPECT_LE(error(integrateSE3<S>(q, Vector6<S>::Zero()), q), 2 * eps<S>());
  EXPECT_EQ(differenceSE3<S>(q, q), (Vector6<S>::Zero()));
}

SCALAR_TEST(Configuration, DifferenceInvertsIntegrateForThetaBelowPi) {
  const Vector6<S> d = increment<S>();
  const Vector6<S> back = differenceSE3<S>(generic<S>(), integrateSE3<S>(generic<S>(), d));
  // The positions, up to 4 m, are rounded too.
  EXPECT_LE(error(back, d), 32 * eps<S>());
}
SCALAR_TEST(Configuration, ForThetaBeyondPiThePoseIsEqualAndTheVectorIsNot) {
  const Vector6<S> d = S(2) * increment<S>();
  const Vector7<S> q1 = integrateSE3<S>(generic<S>(), d);
  const Vector6<S> back = differenceSE3<S>(generic<S>(), q1);
  EXPECT_LE(back.template tail<3>().norm(), pi<S>());
  EXPECT_GT(error(back, d), S(1));
  EXPECT_LE(error(differenceSE3<S>(q1, integrateSE3<S>(generic<S>(), back)), Vector6<S>(Vector6<S>::Zero())),
            64 * eps<S>());
}
SCALAR_TEST(Configuration, TheLinearPartOfDifferenceIsNotTheDifferenceOfPositions) {
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
SCALAR_TEST(Configuration, NearThetaEqualToPiTheSignOfTheAxisIsRightIfTheScalarPartUnderflows) {
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
SCALAR_TEST(Configuration, AtThetaEqualToPiDifferenceHasEitherSignOfTheAxis) {
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

SCALAR_TEST(Configuration, DifferenceOfNearPosesIsAccurateRelativeToItself) {
  for (const S angle : {S(0.1), std::cbrt(eps<S>()), std::sqrt(eps<S>()), 16 * eps<S>()}) {
    const Vector7<S> q0 = generic<S>(), q1 = integrateSE3<S>(q0, Vector6<S>(angle * increment<S>()));
    const auto expected = nearRotation<S>(q0, q1);
    const Vector3<S> phi = differenceSE3<S>(q0, q1).template tail<3>();
    EXPECT_LE(error(phi.template cast<long double>(), expected), 4 * eps<S>() * expected.norm()) << angle;
  }
}
// The coefficients of Q0 are nearly equal, and those of Q1 are three ulp larger. Q1 - Q0 is thus almost
// parallel to Q0, and the vector part of Q0* (Q1 - Q0) cancels to a thousandth (a millionth in double).
SCALAR_TEST(Configuration, QuaternionsThatDifferMainlyInNormKeepTheirSmallRotation) {
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

SCALAR_TEST(Configuration, DifferenceIsTheSameForQAndMinusQ) {
  const Vector7<S> q0 = generic<S>(), q1 = integrateSE3<S>(q0, increment<S>());
  Vector7<S> opposite = q1;
  opposite.template tail<4>() *= S(-1);
  EXPECT_EQ(differenceSE3<S>(q0, q1), differenceSE3<S>(q0, opposite));
}

SCALAR_TEST(Configuration, IntegrateReturnsTheQuaternionNearerToTheFirstOne) {
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
SCALAR_TEST(Configuration, ResultsDoNotJumpAtUsualCutoffsOfSmallAngles) {
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

SCALAR_TEST(Configuration, FirstOrderNormalizationErrsByThreeEighthsOfTheSquaredDefect) {
  const S defect = std::sqrt(eps<S>()) * 8;
  const Vector4<S> Q = generic<S>().template tail<4>() * std::sqrt(1 + defect);
  const S norm = firstOrderNormalized<S, 4>(Q).norm();
  EXPECT_LE(std::abs((1 - norm) - S(3) / S(8) * defect * defect), 6 * eps<S>());
}
SCALAR_TEST(Configuration, AThousandIncrementsStayOnTheUnitSphere) {
  Vector7<S> q = generic<S>();
  for (int i = 0; i < 1000; ++i) q = integrateSE3<S>(q, increment<S>());
  EXPECT_LE(std::abs(q.template tail<4>().squaredNorm() - 1), 4 * eps<S>());
}

SCALAR_TEST(Configuration, TheCoefficientJacobianIsRAndHalfTheQuaternionProduct) {
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
SCALAR_TEST(Configuration, DIntegrateByTheConfigurationIsTheAdjointOfTheInverseIncrement) {
  const Vector6<S> d = increment<S>();
  const Matrix6<S> J = dIntegrateSE3<S>(generic<S>(), d, ArgumentPosition::ARG0);
  const Matrix6<S> expected = exp6<S>(Motion<S>(d)).inverse().toActionMatrix();
  EXPECT_LE(error(J, expected), 32 * eps<S>());
}

SCALAR_TEST(Configuration, TheLastNumberOfTheNeutralFreeFlyerIsOne) {
  Model<S> m;
  m.addJoint(0, FreeFlyer<S>(), SE3<S>::Identity(), "root");
  EXPECT_EQ(neutral(m), (identity<S>()));
  EXPECT_EQ(m.nq, 7);
  EXPECT_EQ(m.nv, 6);
}
SCALAR_TEST(Configuration, NeutralOfAContinuousJointIsCosineAndSineOfZero) {
  VectorX<S> expected(11);
  expected << S(0), identity<S>(), S(1), S(0), S(0);
  EXPECT_EQ(neutral(someRobot<S>()), expected);
}
SCALAR_TEST(Configuration, EachJointMovesItsOwnSegmentOnly) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q = neutral(m);
  for (int joint = 1; joint < m.njoints; ++joint) {
    VectorX<S> d = VectorX<S>::Zero(m.nv);
    d.segment(m.idx_vs[joint], m.nvs[joint]).setConstant(S(0.5));
    const VectorX<S> next = integrate(m, q, d);
    for (int i = 0; i < m.nq; ++i) {
      const bool own = i >= m.idx_qs[joint] && i < m.idx_qs[joint] + m.nqs[joint];
      EXPECT_EQ(next[i] != q[i], own) << m.names[joint] << ' ' << i;
    }
  }
}

SCALAR_TEST(Configuration, AContinuousJointWrapsAround) {
  using J = Continuous<S>;
  const auto turn = [](S a) { return typename J::Tangent(a); };
  const auto at = [](S a) { return typename J::Configuration(std::cos(a), std::sin(a)); };
  EXPECT_LE(error(J::integrate(at(S(3)), turn(S(1))), at(S(4))), 4 * eps<S>());
  EXPECT_LE(std::abs(J::difference(at(S(3)), at(S(-3)))[0] - (2 * pi<S>() - 6)), 8 * eps<S>());
  EXPECT_LE(std::abs(J::difference(at(S(-3)), at(S(3)))[0] + (2 * pi<S>() - 6)), 8 * eps<S>());
  EXPECT_LE(std::abs(std::abs(J::difference(at(S(0)), typename J::Configuration(S(-1), S(0)))[0]) - pi<S>()),
            4 * eps<S>());
}
// (c, s) = (3, 4)/5 is rounded. The expected value is thus the exact cross product of the stored numbers.
SCALAR_TEST(Configuration, TheDifferenceOfNearContinuousAnglesIsAccurateRelativeToItself) {
  using C = typename Continuous<S>::Configuration;
  const C u0(S(0.6), S(0.8));
  for (const C& u1 :
       {C(S(0.6) + 3 * eps<S>(), S(0.8) - 2 * eps<S>()), C(S(0.6) + 3 * eps<S>(), S(0.8) + 4 * eps<S>())}) {
    using L = long double;
    const L dc = L(u1[0]) - L(u0[0]), ds = L(u1[1]) - L(u0[1]), sine = L(u0[0]) * ds - L(u0[1]) * dc;
    EXPECT_NE(sine, 0);
    EXPECT_LE(std::abs(Continuous<S>::difference(u0, u1)[0] - sine),
              L(4 * eps<S>()) * std::abs(sine) + L(eps<S>()) * L(eps<S>()) / 256);
  }
}

SCALAR_TEST(Configuration, IntegrateAndDifferenceAgreeOnTheWholeVector) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q = someConfiguration<S>(), d = someIncrement<S>();
  EXPECT_LE(error(difference(m, q, integrate(m, q, d)), d), 32 * eps<S>());
  EXPECT_LE(error(difference(m, integrate(m, q, d), q), -d), 32 * eps<S>());
}
SCALAR_TEST(Configuration, InterpolateFollowsTheGeodesicOfEveryJoint) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q0 = someConfiguration<S>(), d = someIncrement<S>(), q1 = integrate(m, q0, d);
  EXPECT_TRUE(isSameConfiguration(m, interpolate(m, q0, q1, S(0)), q0));
  EXPECT_TRUE(isSameConfiguration(m, interpolate(m, q0, q1, S(1)), q1));
  EXPECT_LE(error(interpolate(m, q0, q1, S(0.25)), integrate(m, q0, d / 4)), 32 * eps<S>());
}

SCALAR_TEST(Configuration, MinusQIsTheSameConfigurationAlthoughItsNumbersDiffer) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q = someConfiguration<S>();
  VectorX<S> opposite = q;
  opposite.template segment<4>(4) *= S(-1);
  EXPECT_NE(q, opposite);
  EXPECT_TRUE(isSameConfiguration(m, q, opposite));
  EXPECT_LE(distance(m, q, opposite), 4 * eps<S>());
}
SCALAR_TEST(Configuration, MovingAnyJointGivesAnotherConfiguration) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q = someConfiguration<S>();
  for (int i = 0; i < m.nv; ++i) {
    const S step = 512 * eps<S>();
    const VectorX<S> next = integrate(m, q, VectorX<S>(step * VectorX<S>::Unit(m.nv, i)));
    EXPECT_FALSE(isSameConfiguration(m, q, next)) << i;
    EXPECT_TRUE(isSameConfiguration(m, q, next, 2 * step)) << i;
  }
  VectorX<S> turned = q;
  turned[10] += 2 * pi<S>();
  EXPECT_FALSE(isSameConfiguration(m, q, turned));
  turned[10] = std::numeric_limits<S>::quiet_NaN();
  EXPECT_FALSE(isSameConfiguration(m, turned, turned));
  turned = q;
  turned[1] = std::numeric_limits<S>::quiet_NaN();
  EXPECT_FALSE(isSameConfiguration(m, turned, turned));
}
SCALAR_TEST(Configuration, DistanceIsTheRootOfTheSumOfSquaredJointDistances) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q0 = neutral(m);
  VectorX<S> d(9);
  d << S(3), S(0), S(0), S(0), S(0), S(0), S(0.5), S(0.25), S(4);
  const VectorX<S> squares = squaredDistance(m, q0, integrate(m, q0, d));
  EXPECT_LE(error(squares, Vector4<S>(S(9), S(0.25), S(0.0625), S(16))), 64 * eps<S>());
  EXPECT_LE(std::abs(distance(m, q0, integrate(m, q0, d)) - std::sqrt(S(25.3125))), 16 * eps<S>());
}
SCALAR_TEST(Configuration, WeightsMakeMetresAndRadiansComparable) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q0 = neutral(m);
  VectorX<S> d = VectorX<S>::Zero(9), weights = VectorX<S>::Zero(9);
  d[0] = S(3), d[8] = S(4);
  weights[0] = S(2), weights[8] = S(0.5);
  EXPECT_LE(std::abs(distance(m, q0, integrate(m, q0, d), weights) - std::sqrt(S(40))), 8 * eps<S>());
}
SCALAR_TEST(Configuration, DistanceOfVeryFarConfigurationsIsFinite) {
  Model<S> m;
  m.addJoint(0, Prismatic<S>(Axis<S>::X()), SE3<S>::Identity(), "slide");
  const S far = std::numeric_limits<S>::max() / 4;
  EXPECT_EQ(distance(m, neutral(m), VectorX<S>::Constant(1, far)), far);
  const Model<S> nothing;
  EXPECT_EQ(distance(nothing, neutral(nothing), neutral(nothing)), S(0));
}

SCALAR_TEST(Configuration, NormalizeWorksInPlaceAndByValue) {
  const Model<S> m = someRobot<S>();
  const VectorX<S> q = someConfiguration<S>();
  VectorX<S> scaled = q;
  scaled.template segment<4>(4) *= S(3);
  scaled.template segment<2>(8) *= std::numeric_limits<S>::min();  // its square underflows
  EXPECT_FALSE(isNormalized(m, scaled));
  EXPECT_LE(error(normalized(m, scaled), q), 8 * eps<S>());
  EXPECT_TRUE(isNormalized(m, normalized(m, scaled)));
  normalize(m, scaled);
  EXPECT_LE(error(scaled, q), 8 * eps<S>());
}
SCALAR_TEST(Configuration, IsNormalizedChecksEveryUnitVectorAndRefusesNaN) {
  const Model<S> m = someRobot<S>();
  EXPECT_TRUE(isNormalized(m, someConfiguration<S>()));
  for (const int i : {4, 5, 6, 7, 8, 9}) {
    for (const S factor : {1 + 1024 * eps<S>(), std::numeric_limits<S>::quiet_NaN()}) {
      VectorX<S> q = someConfiguration<S>();
      q[i] *= factor;
      EXPECT_FALSE(isNormalized(m, q)) << i;
    }
  }
  VectorX<S> q = someConfiguration<S>();
  q[4] *= 1 + 64 * eps<S>();
  EXPECT_TRUE(isNormalized(m, q, S(1000) * eps<S>()));
}

TEST(Sizes, EveryFunctionRefusesAWrongSizeAndNamesBothSizes) {
  using Q = VectorX<double>;
  const Model<double> m = someRobot<double>();
  const Q q = neutral(m), v = Q::Zero(9), short_q = Q::Zero(9), long_v = Q::Zero(11);
  const auto arg = ArgumentPosition::ARG0;
  const auto expectBoth = [](const std::string& text, const char* dimension, const char* given,
                             const char* due) {
    EXPECT_TRUE(has(text, dimension));
    EXPECT_TRUE(has(text, std::string(given) + " numbers"));
    EXPECT_TRUE(text.ends_with(due)) << text;
  };
  const auto expectQ = [&](auto f) { expectBoth(refusal(f), "nq", "9", "11"); };
  const auto expectV = [&](auto f) { expectBoth(refusal(f), "nv", "11", "9"); };
  expectQ([&] { normalized(m, short_q); });
  expectQ([&] {
    Q copy = short_q;
    normalize(m, copy);
  });
  expectQ([&] { isNormalized(m, short_q); });
  expectQ([&] { integrate(m, short_q, v); });
  expectV([&] { integrate(m, q, long_v); });
  expectQ([&] { difference(m, short_q, q); });
  expectQ([&] { difference(m, q, short_q); });
  expectQ([&] { interpolate(m, short_q, q, 0.5); });
  expectQ([&] { interpolate(m, q, short_q, 0.5); });
  expectQ([&] { squaredDistance(m, short_q, q); });
  expectQ([&] { squaredDistance(m, q, short_q); });
  expectQ([&] { distance(m, short_q, q); });
  expectQ([&] { distance(m, q, short_q); });
  expectV([&] { distance(m, q, q, long_v); });
  expectQ([&] { isSameConfiguration(m, short_q, q); });
  expectQ([&] { isSameConfiguration(m, q, short_q); });
  expectQ([&] { dIntegrate(m, short_q, v, arg); });
  expectV([&] { dIntegrate(m, q, long_v, arg); });
  expectQ([&] { dDifference(m, short_q, q, arg); });
  expectQ([&] { dDifference(m, q, short_q, arg); });
  expectQ([&] { integrateCoeffWiseJacobian(m, short_q); });
  expectQ([&] { checkedConfiguration(m, short_q); });
  expectV([&] { checkedTangent(m, long_v); });
}

/// The exception that a function of q or v throws.
template <class F>
InvalidConfiguration invalid(F f) {
  try {
    f();
  } catch (const InvalidConfiguration& e) {
    return e;
  }
  ADD_FAILURE() << "nothing was refused";
  return InvalidConfiguration("", "", -1, -1, 0);
}

TEST(CheckedInput, AValidConfigurationAndTangentPassUnchanged) {
  const Model<double> m = someRobot<double>();
  EXPECT_EQ(checkedConfiguration(m, someConfiguration<double>()), someConfiguration<double>());
  EXPECT_EQ(checkedTangent(m, someIncrement<double>()), someIncrement<double>());
}
TEST(CheckedInput, NonFiniteNumbersAreRefusedWithJointIndexAndValue) {
  const Model<double> m = someRobot<double>();
  for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    for (int i = 0; i < m.nq; ++i) {
      VectorX<double> q = someConfiguration<double>();
      q[i] = bad;
      const InvalidConfiguration e = invalid([&] { checkedConfiguration(m, q); });
      EXPECT_EQ(e.index, i);
      EXPECT_EQ(e.joint_index, i < 1 ? 1 : i < 8 ? 2 : i < 10 ? 3 : 4);
      EXPECT_EQ(e.joint_name, m.names[std::size_t(e.joint_index)]);
      EXPECT_TRUE(std::isnan(bad) ? std::isnan(e.value) : e.value == bad);
      EXPECT_EQ(invalid([&] { normalized(m, q); }).index, i);
    }
    for (int i = 0; i < m.nv; ++i) {
      VectorX<double> v = someIncrement<double>();
      v[i] = bad;
      EXPECT_EQ(invalid([&] { checkedTangent(m, v); }).index, i);
    }
  }
}
TEST(CheckedInput, EveryFunctionRefusesNumbersThatAreNotFiniteAndNamesTheArgument) {
  const Model<double> m = someRobot<double>();
  const VectorX<double> good = someConfiguration<double>(), still = someIncrement<double>();
  const auto refused = [&](auto call, const std::string& argument, int i) {
    const InvalidConfiguration e = invalid(call);
    EXPECT_EQ(e.index, i);
    EXPECT_FALSE(std::isfinite(e.value));
    EXPECT_TRUE(has(e.what(), "'" + m.names[std::size_t(e.joint_index)] + "'"));
    EXPECT_TRUE(has(e.what(), ", " + argument + "[" + std::to_string(i) + "]: not finite"));
  };
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    for (const int i : {0, 2, 5, 9, 10}) {
      VectorX<double> q = good;
      q[i] = bad;
      refused([&] { integrate(m, q, still); }, "q", i);
      refused([&] { difference(m, q, good); }, "q0", i);
      refused([&] { difference(m, good, q); }, "q1", i);
      refused([&] { interpolate(m, q, good, 0.5); }, "q0", i);
      refused([&] { interpolate(m, good, q, 0.5); }, "q1", i);
      refused([&] { squaredDistance(m, q, good); }, "q0", i);
      refused([&] { distance(m, good, q); }, "q1", i);
      refused([&] { dIntegrate(m, q, still, ArgumentPosition::ARG1); }, "q", i);
      refused([&] { dDifference(m, good, q, ArgumentPosition::ARG1); }, "q1", i);
      refused([&] { integrateCoeffWiseJacobian(m, q); }, "q", i);
      EXPECT_FALSE(isSameConfiguration(m, q, good));
      EXPECT_FALSE(isSameConfiguration(m, good, q));
    }
    for (const int i : {0, 3, 7, 8}) {
      VectorX<double> v = still;
      v[i] = bad;
      refused([&] { integrate(m, good, v); }, "delta", i);
      refused([&] { dIntegrate(m, good, v, ArgumentPosition::ARG0); }, "delta", i);
      refused([&] { distance(m, good, good, v); }, "weights", i);
    }
    EXPECT_EQ(refusal([&] { interpolate(m, good, good, bad); }),
              std::string("u = ") + (std::isnan(bad) ? "nan" : "inf") + ": not finite");
  }
  // The difference of two numbers that are finite may be too large.
  VectorX<double> far = good, farther = good;
  far[0] = -1e308, farther[0] = 1e308;
  refused([&] { interpolate(m, far, farther, 0.5); }, "delta", 0);
}
TEST(CheckedInput, AZeroUnitVectorCannotBeNormalised) {
  const Model<double> m = someRobot<double>();
  VectorX<double> q = someConfiguration<double>();
  q.segment<4>(4).setZero();
  EXPECT_EQ(invalid([&] { checkedConfiguration(m, q); }).joint_name, "floating");
  EXPECT_EQ(invalid([&] { normalized(m, q); }).index, 4);
  const VectorX<double> before = q;
  EXPECT_THROW(normalize(m, q), InvalidConfiguration);
  EXPECT_EQ(q, before);
  q = someConfiguration<double>();
  q.segment<2>(8).setZero();
  EXPECT_EQ(invalid([&] { checkedConfiguration(m, q); }).joint_name, "wheel");
  EXPECT_EQ(invalid([&] { normalized(m, q); }).index, 8);
}
TEST(CheckedInput, AUnitVectorOffByMoreThanEightEpsIsRefusedWithItsSquaredNorm) {
  const Model<double> m = someRobot<double>();
  VectorX<double> q = neutral(m);
  q[7] = 1 + 3 * eps<double>();
  EXPECT_NO_THROW(checkedConfiguration(m, q));
  q[7] = 1 + 5 * eps<double>();
  const InvalidConfiguration e = invalid([&] { checkedConfiguration(m, q); });
  EXPECT_EQ(e.joint_index, 2);
  EXPECT_EQ(e.index, 4);
  EXPECT_NEAR(e.value, 1 + 10 * eps<double>(), 2 * eps<double>());
  EXPECT_TRUE(has(e.what(), "joint 'floating' (joint 2), q[4]"));
}

}  // namespace
