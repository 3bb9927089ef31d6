// algorithms/aba.hpp: its rounding errors and singular inertias.

#include <gtest/gtest.h>

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/urdf/urdf.hpp>

#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

TEST(Aba, ErrsLessThanTheFactorsOfM) {
  const Model<double> m =
      buildModelFromUrdf(LIECHECK_FIXTURES "/robots/quadruped.urdf", RootJoint::FreeFlyer);
  const Model<float> rounded = m.cast<float>();
  Data<double> d(m);
  Data<float> f(rounded, Dense::Mass);
  Random random(1);
  double by_aba = 0, by_factors = 0;
  for (int i = 0; i < 160; ++i) {
    const State s = randomState(m, random);
    const VectorX<float> q = s.q.cast<float>(), v = s.v.cast<float>(), tau = s.tau.cast<float>();
    const Vec exact = aba(m, d, Vec(q.cast<double>()), Vec(v.cast<double>()), Vec(tau.cast<double>()));
    const auto error = [&](const VectorX<float>& a) {
      return (a.cast<double>() - exact).norm() / exact.norm();
    };
    by_aba += error(aba(rounded, f, q, v, tau));
    const VectorX<float> rest = tau - nonLinearEffects(rounded, f, q, v);
    by_factors += error(crba(rounded, f, q).llt().solve(rest));
  }
  EXPECT_GT(by_aba, 0);
  EXPECT_LT(by_aba, by_factors);
}

/// Joints that rotate about one line, with massless links between them, and a body that the last one carries.
Model<double> jointsOnOneLine(Random& random, int joints) {
  Model<double> m;
  const V3 axis = random.vector(1).normalized();
  for (int i = 0; i < joints; ++i) {
    const SE3<double> along(Matrix3<double>::Identity().eval(), V3(random.uniform(-1, 1) * axis));
    m.addJoint(i, Revolute<double>(axis), i == 0 ? random.pose() : along, "joint" + std::to_string(i));
  }
  m.appendBodyToJoint(joints, random.body(5));
  return m;
}

/// Whether the joint is named by both solvers.
template <class Scalar>
bool refused(const Model<Scalar>& m, const State& s, int joint) {
  Data<Scalar> d(m, Dense::Mass);
  const auto names = [&](auto solve) {
    try {
      solve();
    } catch (const SingularInertia& e) {
      return e.joint_index == joint;
    }
    return false;
  };
  const VectorX<Scalar> q = s.q.cast<Scalar>(), v = s.v.cast<Scalar>(), tau = s.tau.cast<Scalar>();
  const bool by_aba = names([&] { aba(m, d, q, v, tau); }),
             by_factors = names([&] { computeMinverse(m, d, q); });
  return by_aba && by_factors;
}

TEST(Aba, RefusesJointsThatRotateAboutOneLine) {
  int answered = 0;
  Random random(1);
  for (int i = 0; i < 12000; ++i) {
    Model<double> m = jointsOnOneLine(random, 2);
    const State s = randomState(m, random);
    answered += !refused(m, s, 1) + !refused(m.cast<float>(), s, 1);
    m.armature[0] = 1e-3;  // moves the first joint
    Data<double> d(m);
    EXPECT_TRUE(aba(m, d, s.q, s.v, s.tau).allFinite());

    m = jointsOnOneLine(random, 3);
    m.armature[1] = 1e-3;  // moves the second joint, but not the first one
    const State of_three = randomState(m, random);
    answered += !refused(m, of_three, 1);
  }
  EXPECT_EQ(answered, 0) << "of 36000 singular states";
}

// The spherical joint leaves of the inertia behind it nothing but its rounding errors.
TEST(Aba, RefusesAJointAboutTheCentreOfASphericalOne) {
  int answered = 0;
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    Model<double> m;
    m.addJoint(0, Revolute<double>(random.vector(1).normalized()), random.pose(), "joint");
    m.addJoint(1, Spherical<double>(), SE3<double>::Identity(), "wrist");
    m.appendBodyToJoint(2, random.body(5));
    const State s = randomState(m, random);
    answered += !refused(m, s, 1) + !refused(m.cast<float>(), s, 1);
  }
  EXPECT_EQ(answered, 0) << "of 2000 singular states";
}

}  // namespace
