// Four exercises for the reader, each a short program.

#include <gtest/gtest.h>

#include <liecheck/multibody/configuration.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <numbers>

namespace {

using namespace liecheck;
using Vec = VectorX<double>;
using V3 = Vector3<double>;
constexpr double half_pi = std::numbers::pi / 2;

Model<double> aLoneFreeFlyer() {
  Model<double> m;
  m.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "base");
  return m;
}

TEST(Exercises, AUrdfGivesSizesTheNeutralConfigurationAndTwoOffsetsForEachJoint) {
  const Model<double> lone = aLoneFreeFlyer();
  EXPECT_EQ(lone.nq, 7);
  EXPECT_EQ(lone.nv, 6);
  EXPECT_EQ(neutral(lone), (Vec(7) << 0, 0, 0, 0, 0, 0, 1).finished());
  const Model<double> robot =
      buildModelFromUrdf(std::string(LIECHECK_FIXTURES) + "/robots/mixed_joints.urdf", RootJoint::FreeFlyer);
  std::string listed;
  for (std::size_t i = 1; i < robot.joints.size(); ++i)
    listed +=
        robot.names[i] + " " + std::to_string(robot.idx_qs[i]) + " " + std::to_string(robot.idx_vs[i]) + "\n";
  EXPECT_EQ(listed,
            "root_joint 0 0\narm_turn 7 6\nelbow 9 7\nwrist 10 8\nmast_slide 11 9\nradar_turn 12 "
            "10\ntail_slide 14 11\n");
}

TEST(Exercises, WithAYawOfNinetyDegreesAnIncrementAlongTheBodysXMovesAlongTheWorldsY) {
  const Model<double> m = aLoneFreeFlyer();
  const Vec turned = integrate(m, neutral(m), Vec(half_pi * Vec::Unit(6, 5)));
  const Vec moved = integrate(m, turned, Vec(Vec::Unit(6, 0)));
  EXPECT_LE((moved.head<3>() - V3(0, 1, 0)).norm(), 4 * eps<double>());
  EXPECT_GT((moved.head<3>() - (turned + Vec::Unit(7, 0)).head<3>()).norm(),
            1);  // adding the increment to q gives another position
}

TEST(Exercises, IntegrateFollowsAnArcAndDifferenceInvertsItUpToPi) {
  const Model<double> m = aLoneFreeFlyer();
  const Vec delta = (Vec(6) << 1, 0, 0, 0, 0, half_pi).finished();
  const Vec q = integrate(m, neutral(m), delta);
  EXPECT_LE((q.head<3>() - V3(1 / half_pi, 1 / half_pi, 0)).norm(), 4 * eps<double>());
  EXPECT_LE((difference(m, neutral(m), q) - delta).norm(), 8 * eps<double>());
  // For |phi| > pi log6 returns another vector of the same pose.
  const Vec long_way = (Vec(6) << 0, 0, 0, 0, 0, 3 * half_pi).finished();
  const Vec there = integrate(m, neutral(m), long_way), back = difference(m, neutral(m), there);
  EXPECT_NEAR(back[5], -half_pi, 8 * eps<double>());
  EXPECT_TRUE(isSameConfiguration(m, integrate(m, neutral(m), back), there));
}

TEST(Exercises, TheOppositeQuaternionIsAnotherVectorAndTheSameConfiguration) {
  const Model<double> m = aLoneFreeFlyer();
  const Vec q = integrate(m, neutral(m), (Vec(6) << 1, 2, 3, 0.1, 0.2, 0.3).finished());
  Vec opposite = q;
  opposite.tail<4>() *= -1;
  EXPECT_GT((q - opposite).norm(), 1.9);
  EXPECT_TRUE(isSameConfiguration(m, q, opposite));
  EXPECT_LE(difference(m, q, opposite).norm(), eps<double>());
}

}  // namespace
