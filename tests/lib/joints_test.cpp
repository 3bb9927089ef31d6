// multibody/joints: compares the configuration spaces of every joint with long double and with the
// free-flyer. Also tests multibody/random_configuration.hpp.

#include <gtest/gtest.h>

#include <functional>
#include <liecheck/multibody/random_configuration.hpp>

#include "random_tree.hpp"
#include "../refusal.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using Mat = MatrixX<double>;
using Real = long double;
using VecL = VectorX<Real>;

/// The derivative of f at 0 by central differences of order 8 with step 1/1024. For a function that rotates at
/// w rad/s the relative truncation error is (w/1024)^8/630. The rounding error is 1024 eps of f, 1e-16 in long double.
MatrixX<Real> derivative(const std::function<MatrixX<Real>(Real)>& f) {
  const Real h = Real(1) / Real(1024);
  const auto pair = [&](int k) { return MatrixX<Real>(f(Real(k) * h) - f(Real(-k) * h)); };
  return (pair(1) * (Real(4) / Real(5)) - pair(2) * (Real(1) / Real(5)) + pair(3) * (Real(4) / Real(105)) -
          pair(4) * (Real(1) / Real(280))) /
         h;
}

Model<double> oneOfEach(unsigned seed) {
  return randomModel(seed, joint_kinds);
}

TEST(Joints, DifferenceInvertsIntegrateForEveryJoint) {
  for (unsigned seed = 201; seed < 221; ++seed) {
    const Model<double> m = oneOfEach(seed);
    Random random(seed);
    const double size = seed % 2 ? 1.7 : 1e-7;  // 1.7 sqrt(3) < pi
    const Vec q = randomState(m, random).q, delta = random.tangent(m.nv, size);
    EXPECT_TRUE(isNormalized(m, q));
    const Vec next = integrate(m, q, delta);
    EXPECT_LE((difference(m, q, next) - delta).norm(), 64 * eps<double>() * (1 + q.norm()));
    EXPECT_TRUE(isSameConfiguration(m, integrate(m, next, Vec(-delta)), q));
    EXPECT_TRUE(isSameConfiguration(m, normalized(m, Vec(q)), q));
  }
}
TEST(Joints, IntegrateAndDifferenceAgreeWithLongDoubleToAFewUlp) {
  for (unsigned seed = 221; seed < 261; ++seed) {
    const Model<double> m = oneOfEach(seed);
    const Model<Real> ml = m.cast<Real>();
    Random random(seed);
    const double size = std::pow(10, -0.4 * (seed % 20));
    const Vec q = normalized(m, randomState(m, random).q), delta = random.tangent(m.nv, size);
    const Vec next = integrate(m, q, delta);
    EXPECT_LE(
        relative(next, integrate(ml, VecL(q.cast<Real>()), VecL(delta.cast<Real>())).cast<double>().eval()),
        4 * eps<double>());
    const VecL exact = difference(ml, VecL(q.cast<Real>()), VecL(next.cast<Real>()));
    EXPECT_LE(relative(difference(m, q, next), exact.cast<double>().eval()), 8 * eps<double>()) << size;
  }
}

TEST(Joints, DIntegrateAndDDifferenceAreTheDerivativesForWholeConfigurations) {
  for (unsigned seed = 261; seed < 269; ++seed) {
    const Model<double> m = oneOfEach(seed);
    const Model<Real> ml = m.cast<Real>();
    Random random(seed);
    const Vec q = randomState(m, random).q, delta = random.tangent(m.nv, 1),
              q1 = integrate(m, q, random.tangent(m.nv, 1));
    const VecL ql = q.cast<Real>(), dl = delta.cast<Real>(), q1l = q1.cast<Real>(),
               next = integrate(ml, ql, dl);
    MatrixX<Real> by_q(m.nv, m.nv), by_delta = by_q, by_q0 = by_q, by_q1 = by_q;
    for (int k = 0; k < m.nv; ++k) {
      const VecL e = VecL::Unit(m.nv, k);
      by_q.col(k) = derivative(
          [&](Real t) { return difference(ml, next, integrate(ml, integrate(ml, ql, VecL(t * e)), dl)); });
      by_delta.col(k) =
          derivative([&](Real t) { return difference(ml, next, integrate(ml, ql, VecL(dl + t * e))); });
      by_q0.col(k) = derivative([&](Real t) { return difference(ml, integrate(ml, ql, VecL(t * e)), q1l); });
      by_q1.col(k) = derivative([&](Real t) { return difference(ml, ql, integrate(ml, q1l, VecL(t * e))); });
    }
    const auto same = [](const Mat& J, const MatrixX<Real>& expected) {
      EXPECT_LE(relative(J, expected.cast<double>().eval()), 1e-14);
    };
    same(dIntegrate(m, q, delta, ArgumentPosition::ARG0), by_q);
    same(dIntegrate(m, q, delta, ArgumentPosition::ARG1), by_delta);
    same(dDifference(m, q, q1, ArgumentPosition::ARG0), by_q0);
    same(dDifference(m, q, q1, ArgumentPosition::ARG1), by_q1);
    MatrixX<Real> coefficients(m.nq, m.nv);
    for (int k = 0; k < m.nv; ++k)
      coefficients.col(k) =
          derivative([&](Real t) { return integrate(ml, ql, VecL(t * VecL::Unit(m.nv, k))); });
    same(integrateCoeffWiseJacobian(m, q), coefficients);
  }
}

TEST(Joints, APlanarJointIsAFreeFlyerThatStaysInThePlane) {
  Model<double> planar, flyer;
  planar.addJoint(0, Planar<double>(), SE3<double>::Identity(), "joint");
  flyer.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "joint");
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const double angle = random.uniform(-3, 3), turn = random.uniform(-3, 3);
    const V3 p = random.vector(2), u = random.vector(2);
    const Vec q = (Vec(4) << p.x(), p.y(), std::cos(angle), std::sin(angle)).finished();
    const Vec Q = (Vec(7) << p.x(), p.y(), 0, 0, 0, std::sin(angle / 2), std::cos(angle / 2)).finished();
    const Vec next = integrate(planar, q, Vec(V3(u.x(), u.y(), turn)));
    const Vec next7 = integrate(flyer, Q, Vec((Vec(6) << u.x(), u.y(), 0, 0, 0, turn).finished()));
    EXPECT_LE((next.head<2>() - next7.head<2>()).norm(), 16 * eps<double>());
    EXPECT_LE((next.tail<2>() - exp3<double>(V3(0, 0, angle + turn)).block<2, 1>(0, 0)).norm(),
              16 * eps<double>());
  }
}

// The largest products of these numbers overflow, but the results do not.
TEST(Joints, APlanarJointMovesNearTheEndOfTheRange) {
  const double far = 0x1p1022, less = 0x1p30;
  const Vector4<double> q(far / 2, -far / 4, 0.6, 0.8), near(far / 2 / less, -far / 4 / less, 0.6, 0.8);
  const V3 delta(far / 2, far / 3, 3), small(far / 2 / less, far / 3 / less, 3);
  const Vector4<double> next = Planar<double>::integrate(q, delta),
                        expected = Planar<double>::integrate(near, small);
  const V3 back = Planar<double>::difference(q, next), near_back = Planar<double>::difference(near, expected);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(next[i] / less, expected[i], 4 * eps<double>() * far / less);
    EXPECT_NEAR(back[i] / less, near_back[i], 4 * eps<double>() * far / less);
  }
}

/// In float, pi rounded up is more than pi: the translation must be that of the same side of pi as the angle.
TEST(Joints, APlanarDifferenceByHalfATurnLeadsBackInFloat) {
  for (const float sine : {6e-10f, -6e-10f, 0.f, -0.f}) {
    const Vector4<float> q0(0.5f, -1.f, 1.f, 0.f), q1(-1.6f, -1.4f, -1.f, sine);
    const Vector4<float> back = Planar<float>::integrate(q0, Planar<float>::difference(q0, q1));
    EXPECT_LT((back - q1).norm(), 1e-6f) << sine;
  }
}

TEST(Joints, PositionsNearTheEndOfTheRangeAreTheSameOnlyIfTheyAreNear) {
  const double far = std::numeric_limits<double>::max();
  Vector7<double> q0 = FreeFlyer<double>::neutral(), q1 = q0;
  q0.head<3>().setConstant(far), q1.head<3>().setConstant(far * (1 - 4 * eps<double>()));
  EXPECT_TRUE(FreeFlyer<double>::isSame(q0, q1, samenessBudget<double>()));
  EXPECT_FALSE(FreeFlyer<double>::isSame(q0, FreeFlyer<double>::neutral(), samenessBudget<double>()));
  const Vector4<double> p0(far, -far, 1, 0), p1(-far, far, 1, 0);
  EXPECT_TRUE(Planar<double>::isSame(p0, p0, samenessBudget<double>()));
  EXPECT_FALSE(Planar<double>::isSame(p0, p1, samenessBudget<double>()));
}

TEST(Joints, NamesOfJointTypesAreThoseOfPinocchio) {
  EXPECT_EQ(Helical<double>(Axis<double>::Y(), 0.1).shortname(), "JointModelHY");
  EXPECT_EQ(Helical<double>(V3(1, 1, 0), 0.1).shortname(), "JointModelHelicalUnaligned");
  EXPECT_EQ(Spherical<double>().shortname(), "JointModelSpherical");
  EXPECT_EQ(Planar<double>().shortname(), "JointModelPlanar");
  EXPECT_EQ(Translation<double>().shortname(), "JointModelTranslation");
}

TEST(Joints, AZeroUnitVectorIsRefusedWithTheNameOfItsJoint) {
  Model<double> m;
  m.addJoint(0, Spherical<double>(), SE3<double>::Identity(), "ball");
  m.addJoint(1, Planar<double>(), SE3<double>::Identity(), "cart");
  Vec q = neutral(m);
  EXPECT_NO_THROW(checkedConfiguration(m, q));
  EXPECT_TRUE(has(refusal([&] { normalized(m, Vec(Vec::Zero(8))); }),
                  "joint 'ball' (joint 1), q[0]: a zero quaternion"));
  q[6] = 0;
  EXPECT_TRUE(
      has(refusal([&] { checkedConfiguration(m, q); }), "joint 'cart' (joint 2), q[6]: (cos, sin) = (0, 0)"));
  q[7] = 1.1;
  EXPECT_TRUE(has(refusal([&] { checkedConfiguration(m, q); }), "squared norm is not 1"));
}

TEST(Joints, ConstantsThatAreNotFiniteAndInvalidMimicsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Revolute<double> hinge(Axis<double>::X());
  EXPECT_EQ(refusal([&] { Helical<double>(Axis<double>::X(), nan); }),
            "the pitch of a helical joint = nan: not finite");
  EXPECT_EQ(refusal([&] { Mimic<double>(hinge, 1, nan); }),
            "the multiplier of a mimic joint = nan: not finite");
  EXPECT_EQ(refusal([&] { Mimic<double>(hinge, 1, 2, -INFINITY); }),
            "the offset of a mimic joint = -inf: not finite");
  EXPECT_EQ(refusal([&] { Revolute<double>(V3(0, nan, 1)); }), "the axis of a joint = nan: not finite");
  EXPECT_EQ(refusal([&] { Revolute<double>(V3(0, 0, 0)); }), "the axis of a joint is zero");
  Model<double> m;
  m.addJoint(0, Spherical<double>(), SE3<double>::Identity(), "ball");
  const auto follow = [&](int primary) {
    m.addJoint(1, Mimic<double>(Revolute<double>(Axis<double>::X()), primary, 1), SE3<double>::Identity(),
               "follower");
  };
  EXPECT_EQ(refusal([&] { follow(2); }),
            "the primary of joint 'follower' is joint 2, and the number of joints is 2");
  EXPECT_EQ(refusal([&] { follow(1); }),
            "joint 'follower' mimics joint 'ball', which does not have exactly one degree of freedom");
}

TEST(RandomConfiguration, KeepsTheLimitsAndIsTheSameForTheSameSeed) {
  Model<double> m = oneOfEach(3);
  std::mt19937_64 bits(1);
  EXPECT_TRUE(has(refusal([&] { randomConfiguration(m, bits); }), "lowerPositionLimit["));
  m.lowerPositionLimit.setConstant(-0.25);
  EXPECT_TRUE(
      has(refusal([&] { randomConfiguration(m, bits); }), "needs finite limits, lower <= upper (inf)"));
  m.lowerPositionLimit.setConstant(-0.25), m.upperPositionLimit.setConstant(0.5);
  std::mt19937_64 again(1);
  bits.seed(1);
  Vec sum = Vec::Zero(m.nq);
  for (int i = 0; i < 1000; ++i) {
    const Vec q = randomConfiguration(m, bits);
    EXPECT_EQ(q, randomConfiguration(m, again));
    EXPECT_NO_THROW(checkedConfiguration(m, q));
    for (int j = 1; j < m.njoints; ++j)
      if (m.nqs[std::size_t(j)] == 1) {
        const double x = q[m.idx_qs[std::size_t(j)]];
        EXPECT_TRUE(x >= -0.25 && x < 0.5);
      }
    sum += q;
  }
  EXPECT_LE((sum / 1000).cwiseAbs().maxCoeff(), 0.125 + 0.1);
}

}  // namespace
