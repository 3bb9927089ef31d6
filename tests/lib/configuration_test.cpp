// multibody/configuration.hpp: whole configurations, and what each function refuses.

#include <gtest/gtest.h>

#include <liecheck/multibody/configuration.hpp>

#include "generic_pose.hpp"
#include "../refusal.hpp"
#include "scalar_test.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

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

SCALAR_TEST(Configuration, NeutralOfAContinuousJointIsCosineAndSineOfZero) {
  VectorX<S> expected(11);
  expected << S(0), Vector7<S>(Vector7<S>::Unit(6)), S(1), S(0), S(0);
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

// A run that diverges passes NaN through these functions, and its integrator reports it.
SCALAR_TEST(Configuration, NumbersThatAreNotFiniteGiveNaNInFunctionsOfOneJoint) {
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    Vector7<S> q = Vector7<S>::Unit(6);
    q[4] = bad;
    EXPECT_TRUE(integrateSE3<S>(q, Vector6<S>::Zero()).template tail<4>().hasNaN());
    EXPECT_TRUE(differenceSE3<S>(q, q).hasNaN());
    const typename Continuous<S>::Configuration u(bad, S(0));
    EXPECT_TRUE(Continuous<S>::integrate(u, Vector1<S>(S(1))).hasNaN());
    EXPECT_TRUE(Continuous<S>::difference(u, u).hasNaN());
    EXPECT_TRUE(FreeFlyer<S>::transform(SE3<S>::Identity(), q).rotation().hasNaN());
  }
}

}  // namespace
