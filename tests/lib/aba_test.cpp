// algorithms/aba.hpp: its rounding errors, the energy of a passive robot, and singular inertias. dynamics_test.cpp
// checks that its results are right.

#include <gtest/gtest.h>

#include "long_double.hpp"
#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// A free-flyer with four legs of three revolute joints about coordinate axes, as most robots have them.
Model<double> quadruped(unsigned seed) {
  Random random(seed);
  Model<double> m;
  m.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "base");
  m.appendBodyToJoint(1, random.body(5));
  for (int leg = 0; leg < 4; ++leg)
    for (int k = 0; k < 3; ++k) {
      const int j = m.addJoint(k == 0 ? 1 : m.njoints - 1,
                               Revolute<double>(k == 0 ? Axis<double>::X() : Axis<double>::Y()),
                               {Matrix3<double>::Identity().eval(), random.vector(0.3)},
                               "leg" + std::to_string(leg) + std::to_string(k));
      m.appendBodyToJoint(j, random.body(0.5));
    }
  return m;
}

TEST(Aba, ErrsLessThanTheFactorsOfM) {
  double by_aba = 0, by_factors = 0;
  for (unsigned seed = 1; seed < 9; ++seed) {
    const Model<double> m = quadruped(seed);
    const Model<Real> ml = m.cast<Real>();
    Random random(seed);
    Data<double> d(m, Dense::Mass);
    Data<Real> dl(ml);
    for (int i = 0; i < 20; ++i) {
      const State s = randomState(m, random);
      const VecL exact =
          aba(ml, dl, VecL(s.q.cast<Real>()), VecL(s.v.cast<Real>()), VecL(s.tau.cast<Real>()));
      const auto error = [&](const Vec& a) { return double((a.cast<Real>() - exact).norm() / exact.norm()); };
      by_aba += error(aba(m, d, s.q, s.v, s.tau));
      const Vec rest = s.tau - nonLinearEffects(m, d, s.q, s.v);
      by_factors += error(crba(m, d, s.q).llt().solve(rest));
    }
  }
  EXPECT_GT(by_aba, 0);
  EXPECT_LT(by_aba, by_factors);
}

// A passive arm whose rotors and links exchange energy, by the classical Runge-Kutta method of order 4.
TEST(Dynamics, APassiveRobotWithArmatureKeepsItsEnergy) {
  Random random(81);
  Model<double> m;
  for (int i = 0; i < 7; ++i) {
    m.addJoint(i, Revolute<double>(random.vector(1)), random.pose(), "j" + std::to_string(i));
    m.appendBodyToJoint(i + 1, random.body(3));
  }
  m.armature = random.tangent(7, 0.2).cwiseAbs();
  const Vec q0 = random.tangent(7, 1), v0 = random.tangent(7, 2);
  Data<double> d(m);
  const auto acceleration = [&](const Vec& q, const Vec& v) { return Vec(aba(m, d, q, v, Vec::Zero(7))); };
  const auto rotors = [&](const Vec& v) { return m.armature.dot(v.cwiseAbs2()) / 2; };
  double exchanged = 0;  // largest change of the energy of the rotors
  const auto drift = [&](int steps) {
    Vec q = q0, v = v0;
    const double h = 0.2 / steps, start = computeMechanicalEnergy(m, d, q, v);
    double largest = 0;
    for (int n = 0; n < steps; ++n) {
      const Vec a1 = acceleration(q, v), v2 = v + h / 2 * a1, a2 = acceleration(q + h / 2 * v, v2),
                v3 = v + h / 2 * a2, a3 = acceleration(q + h / 2 * v2, v3), v4 = v + h * a3,
                a4 = acceleration(q + h * v3, v4);
      q += h / 6 * (v + 2 * v2 + 2 * v3 + v4), v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      largest = std::max(largest, std::abs(computeMechanicalEnergy(m, d, q, v) - start));
      exchanged = std::max(exchanged, std::abs(rotors(v) - rotors(v0)));
    }
    return largest;
  };
  // The drift is the method's error, O(h^4), which halving h divides by 16: energy that is not counted would
  // remain. 8 allows for the terms of higher order.
  const double coarse = drift(100), fine = drift(200);
  EXPECT_LE(fine, coarse / 8);
  EXPECT_LE(coarse, 1e-3 * exchanged);
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
  for (int i = 0; i < 300; ++i) {
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
  EXPECT_EQ(answered, 0) << "of 900 singular states";
}

}  // namespace
