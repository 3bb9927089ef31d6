// The rounding errors of algorithms/aba.hpp. dynamics_test.cpp checks that its results are right.

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

}  // namespace
