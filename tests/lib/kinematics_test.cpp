// algorithms/kinematics, frames, jacobians: values computed by hand, and what the laws on trees do not measure.

#include <gtest/gtest.h>

#include <functional>
#include <liecheck/algorithms/jacobians.hpp>

#include "../refusal.hpp"
#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using Mat = MatrixX<double>;
constexpr ReferenceFrame every_reference[] = {ReferenceFrame::WORLD, ReferenceFrame::LOCAL,
                                              ReferenceFrame::LOCAL_WORLD_ALIGNED};
const SE3<double> here = SE3<double>::Identity();

TEST(Kinematics, PosesAreTheProductOfPlacementsAndMotions) {
  Model<double> m;
  m.addJoint(0, Revolute<double>(Axis<double>::Z()), at(1, 0, 0), "turn");
  m.addJoint(1, Prismatic<double>(Axis<double>::X()), at(0, 2, 0), "slide");
  m.addFrame({"tip", 2, 0, at(0, 0, 3), FrameType::OP_FRAME});
  Data<double> d(m);
  framesForwardKinematics(m, d, Vec((Vec(2) << std::atan2(1.0, 0.0), 5).finished()));
  EXPECT_LE((d.liMi[2].translation() - V3(5, 2, 0)).norm(), 4 * eps<double>());
  EXPECT_LE((d.oMi[2].translation() - V3(-1, 5, 0)).norm(), 16 * eps<double>());
  EXPECT_LE((d.oMf[1].translation() - V3(-1, 5, 3)).norm(), 16 * eps<double>());
}

TEST(Jacobians, JVIsTheVelocityAndJAPlusJDotVIsTheAcceleration) {
  forEachRobot(101, 118, 11, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m);
    forwardKinematics(m, d, s.q, s.v, s.a);
    computeJointJacobiansTimeVariation(m, d, s.q, s.v);
    for (ReferenceFrame reference : every_reference) {
      const bool aligned = reference == ReferenceFrame::LOCAL_WORLD_ALIGNED;
      const auto check = [&](const Mat& J, const Mat& dJ, const Motion<double>& v, const Motion<double>& a) {
        EXPECT_LE((J * s.v - v.to_vector()).norm(), budget(m) * J.norm() * s.v.norm());
        EXPECT_LE((J * s.a + dJ * s.v - a.to_vector()).norm(),
                  budget(m) * (J.norm() * s.a.norm() + dJ.norm() * s.v.norm()));
      };
      for (int k = 1; k < m.nframes; ++k)
        check(getFrameJacobian(m, d, k, reference), getFrameJacobianTimeVariation(m, d, k, reference),
              getFrameVelocity(m, d, k, reference),
              aligned ? getFrameClassicalAcceleration(m, d, k, reference)
                      : getFrameAcceleration(m, d, k, reference));
      for (int i = 1; i < m.njoints; ++i)
        check(getJointJacobian(m, d, i, reference), getJointJacobianTimeVariation(m, d, i, reference),
              getVelocity(m, d, i, reference),
              aligned ? getClassicalAcceleration(m, d, i, reference) : getAcceleration(m, d, i, reference));
    }
    Mat J = Mat::Zero(6, m.nv), dJ = J;
    for (std::size_t i = 1; i < m.joints.size(); ++i) {
      const int at = m.idx_vs[i], n = m.nvs[i];
      J.middleCols(at, n) = getJointJacobian(m, d, int(i), ReferenceFrame::WORLD).middleCols(at, n);
      dJ.middleCols(at, n) =
          getJointJacobianTimeVariation(m, d, int(i), ReferenceFrame::WORLD).middleCols(at, n);
    }
    EXPECT_LE(relative(d.J(), J), budget(m));
    EXPECT_LE(relative(d.dJ(), dJ), budget(m));
  });
}

/// A wrong multiple of V x s vanishes in dJ v, since V x V = 0, so that each column is compared, too.
TEST(Jacobians, TheColumnsOfTheTimeVariationsAreDerivatives) {
  forEachRobot(101, 118, 11, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m), moved(m);
    computeJointJacobiansTimeVariation(m, d, s.q, s.v);
    const auto rate = [&](auto J) {  // by differences of the fourth order
      const auto at = [&](double t) {
        computeJointJacobians(m, moved, integrate(m, s.q, t * s.v));
        return Mat(J());
      };
      const double h = 1e-4;
      return Mat((8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h));
    };
    for (ReferenceFrame reference : every_reference) {
      const Mat J_dot = rate([&] { return getFrameJacobian(m, moved, m.nframes - 1, reference); });
      EXPECT_LE(relative(getFrameJacobianTimeVariation(m, d, m.nframes - 1, reference), J_dot, 1), 1e-9);
    }
    EXPECT_LE(relative(d.dJ(), rate([&] { return moved.J(); }), 1), 1e-9);
  });
}

TEST(Jacobians, OneExpressionOrOneScopeMayHoldTheResultsOfSeveralGetters) {
  forEachRobot(101, 118, 11, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m);
    forwardKinematics(m, d, s.q, s.v, s.a);
    computeJointJacobiansTimeVariation(m, d, s.q, s.v);
    const int k = m.nframes - 1, i = m.njoints - 1;
    const auto world = ReferenceFrame::WORLD, local = ReferenceFrame::LOCAL;
    const double size = d.J().norm() * s.a.norm() + d.dJ().norm() * s.v.norm();
    const Vector6<double> sum =
        getFrameJacobian(m, d, k, world) * s.a + getFrameJacobianTimeVariation(m, d, k, world) * s.v;
    EXPECT_LE((sum - getFrameAcceleration(m, d, k, world).to_vector()).norm(), budget(m) * size);
    const Vector6<double> joint_sum =
        getJointJacobian(m, d, i, world) * s.a + getJointJacobianTimeVariation(m, d, i, world) * s.v;
    EXPECT_LE((joint_sum - getAcceleration(m, d, i, world).to_vector()).norm(), budget(m) * size);
    const auto &A = getFrameJacobian(m, d, k, world), &B = getFrameJacobian(m, d, k, local);
    EXPECT_EQ(A, Mat(getFrameJacobian(m, d, k, world)));
    EXPECT_EQ(B, Mat(getFrameJacobian(m, d, k, local)));
    EXPECT_NE(A, B);
  });
}

TEST(Jacobians, AMatrixOfTheCallerReceivesTheSameResult) {
  forEachRobot(101, 118, 11, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m);
    computeJointJacobiansTimeVariation(m, d, s.q, s.v);
    const int k = m.nframes - 1, i = m.njoints - 1;
    for (ReferenceFrame reference : every_reference) {
      // The rows of four tasks; what they held before does not matter.
      Mat rows = Mat::Constant(24, m.nv, std::numeric_limits<double>::quiet_NaN());
      getFrameJacobian(m, d, k, reference, rows.topRows(6));
      getFrameJacobianTimeVariation(m, d, k, reference, rows.middleRows(6, 6));
      getJointJacobian(m, d, i, reference, rows.middleRows(12, 6));
      getJointJacobianTimeVariation(m, d, i, reference, rows.bottomRows(6));
      Mat expected(24, m.nv);
      expected << getFrameJacobian(m, d, k, reference), getFrameJacobianTimeVariation(m, d, k, reference),
          getJointJacobian(m, d, i, reference), getJointJacobianTimeVariation(m, d, i, reference);
      EXPECT_EQ(rows, expected);
    }
  });
}

TEST(Jacobians, AMatrixOfAnotherSizeIsRefused) {
  const Model<double> m = randomModel(3, 6);
  Data<double> d(m);
  computeJointJacobiansTimeVariation(m, d, neutral(m), Vec::Zero(m.nv));
  for (const auto& [rows, columns] : {std::pair(6, m.nv - 1), std::pair(3, m.nv)}) {
    Mat J(rows, columns);
    const std::string expected = "J is " + std::to_string(rows) + " x " + std::to_string(columns) +
                                 ", the Jacobian of this model is 6 x " + std::to_string(m.nv);
    EXPECT_EQ(refusal([&] { getFrameJacobian(m, d, 1, ReferenceFrame::LOCAL, J); }), expected);
    EXPECT_EQ(refusal([&] { getFrameJacobianTimeVariation(m, d, 1, ReferenceFrame::LOCAL, J); }), expected);
  }
}

// The wheel rotates 2 m from the world's origin.
TEST(Frames, TheVelocityOfARotatingWheelInTheThreeReferences) {
  Model<double> m;
  m.addJoint(0, Revolute<double>(Axis<double>::Z()), at(2, 0, 0), "wheel");
  const int rim = m.addFrame({"rim", 1, 0, at(1, 0, 0), FrameType::OP_FRAME});
  Data<double> d(m);
  forwardKinematics(m, d, Vec(Vec::Zero(1)), Vec(Vec::Constant(1, 3)), Vec(Vec::Zero(1)));
  const auto u = [&](ReferenceFrame r) { return getFrameVelocity(m, d, rim, r).linear(); };
  EXPECT_EQ(u(ReferenceFrame::LOCAL), V3(0, 3, 0));
  EXPECT_EQ(u(ReferenceFrame::LOCAL_WORLD_ALIGNED), V3(0, 3, 0));
  EXPECT_EQ(u(ReferenceFrame::WORLD), V3(0, -6, 0));  // of the wheel's point at the world's origin
  // Under a constant twist the spatial acceleration is zero although the path is curved.
  EXPECT_EQ(getFrameAcceleration(m, d, rim, ReferenceFrame::LOCAL_WORLD_ALIGNED).linear(), V3(0, 0, 0));
  EXPECT_EQ(getFrameClassicalAcceleration(m, d, rim, ReferenceFrame::LOCAL_WORLD_ALIGNED).linear(),
            V3(-9, 0, 0));
}

TEST(Imu, AtRestItReadsGravityUpwardAndOnAWheelTheCentripetalForceToo) {
  Model<double> m;
  m.addJoint(0, Revolute<double>(Axis<double>::Z()), here, "wheel");
  const Matrix3<double> tilt = exp3<double>(V3(std::atan2(1.0, 0.0), 0, 0));  // the sensor's y is up
  const int sensor = m.addFrame({"imu", 1, 0, {tilt, V3(0.5, 0, 0)}, FrameType::SENSOR});
  Data<double> d(m);
  const auto read = [&](double v, double a) {
    forwardKinematics(m, d, Vec(Vec::Zero(1)), Vec(Vec::Constant(1, v)), Vec(Vec::Constant(1, a)));
    return imu(m, d, sensor);
  };
  EXPECT_LE((read(0, 0).specific_force - V3(0, 9.81, 0)).norm(), 16 * eps<double>());
  EXPECT_EQ(read(0, 0).angular_velocity.norm(), 0);
  // omega x (omega x r) = -4 * 0.5 inward, omega_dot x r = 3 * 0.5 along the wheel's y, the sensor's -z.
  EXPECT_LE((read(2, 3).specific_force - V3(-2, 9.81, -1.5)).norm(), 16 * eps<double>());
  EXPECT_LE((read(2, 3).angular_velocity - V3(0, 2, 0)).norm(), 4 * eps<double>());
}
TEST(Imu, InFreeFallItReadsZeroSpecificForce) {
  Model<double> m;
  m.addJoint(0, FreeFlyer<double>(), here, "base");
  const int sensor = m.addFrame({"imu", 1, 0, here, FrameType::SENSOR});
  Data<double> d(m);
  forwardKinematics(m, d, neutral(m), Vec(Vec::Zero(6)), Vec(-9.81 * Vec::Unit(6, 2)));
  EXPECT_LE(imu(m, d, sensor).specific_force.norm(), eps<double>());
}

TEST(Frames, ThePlacementOfAFreeFlyerAddsToThePositionInQ) {
  Model<double> m;
  m.addJoint(0, FreeFlyer<double>(), at(0, 0, 1), "base");
  Data<double> d(m);
  forwardKinematics(m, d, neutral(m));
  EXPECT_EQ(d.oMi[1].translation(), V3(0, 0, 1));
}

TEST(Frames, AnIndexOutOfRangeIsRefusedWithTheIndexAndTheCount) {
  const Model<double> m = randomModel(7, 3);
  Data<double> d(m);
  forwardKinematics(m, d, neutral(m), Vec(Vec::Zero(m.nv)));
  EXPECT_EQ(refusal([&] { getFrameVelocity(m, d, m.getFrameId("nobody"), ReferenceFrame::LOCAL); }),
            "there is no frame 4: nframes is 4");
  EXPECT_EQ(refusal([&] { getVelocity(m, d, m.getJointId("nobody"), ReferenceFrame::LOCAL); }),
            "there is no joint 4: njoints is 4");
  EXPECT_EQ(refusal([&] { getJointJacobian(m, d, -1, ReferenceFrame::LOCAL); }),
            "there is no joint -1: njoints is 4");
}

}  // namespace
