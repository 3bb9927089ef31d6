// multibody/data.hpp: Model and Data are separate, algorithms allocate nothing, stale fields are detected.

#include <gtest/gtest.h>

#include <cstdlib>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <thread>

#include "count_allocations.hpp"
#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

template <class F>
std::string refusal(F f) {
  try {
    f();
  } catch (const std::logic_error& e) {
    return e.what();
  }
  return "nothing";
}

TEST(Data, AnAlgorithmChangesOnlyItsOwnResults) {
  const Model<double> m = randomModel(3, 6);
  Random random(3);
  State s = randomState(m, random);
  Data<double> d(m);
  forwardKinematics(m, d, s.q, s.v);
  const auto pose = d.oMi[6].rotation();
  const auto velocity = d.v[6].to_vector();
  s.q = integrate(m, s.q, s.v);
  EXPECT_EQ(d.oMi[6].rotation(), pose);
  forwardKinematics(m, d, s.q);  // positions only
  EXPECT_NE(d.oMi[6].rotation(), pose);
  EXPECT_FALSE(d.v.isFresh());
  EXPECT_EQ(d.v.scratch()[6].to_vector(), velocity);
}

TEST(Data, OfAnotherModelOrOfAnEarlierRevisionIsRefused) {
  Model<double> m = randomModel(3, 6);
  const Model<double> copy = m, other = randomModel(3, 6);
  Data<double> d(m);
  const Vec q = neutral(m);
  EXPECT_NO_THROW(forwardKinematics(m, d, q));
  EXPECT_NO_THROW(forwardKinematics(copy, d, q));
  EXPECT_NE(refusal([&] { forwardKinematics(other, d, q); }).find("another model"), std::string::npos);
  m.addFrame({"late", 1, 0, SE3<double>::Identity(), FrameType::OP_FRAME});
  EXPECT_NE(refusal([&] { forwardKinematics(m, d, q); }).find("before a joint or a frame was added"),
            std::string::npos);
  EXPECT_NE(refusal([&] { updateFramePlacements(m, d); }).find("another model"), std::string::npos);
  EXPECT_NE(refusal([&] { getJointJacobian(m, d, 1, ReferenceFrame::WORLD); }).find("another model"),
            std::string::npos);
}

TEST(Data, AVectorOfTheWrongSizeIsNamedWithBothSizes) {
  const Model<double> m = randomModel(3, 6);
  Data<double> d(m);
  const Vec q = neutral(m), v = Vec::Zero(m.nv);
  const std::string nv = std::to_string(m.nv), nq = std::to_string(m.nq);
  EXPECT_EQ(refusal([&] { rnea(m, d, v, v, v); }), "q has " + nv + " numbers, the model's nq is " + nq);
  EXPECT_EQ(refusal([&] { rnea(m, d, q, q, v); }), "v has " + nq + " numbers, the model's nv is " + nv);
  EXPECT_EQ(refusal([&] { rnea(m, d, q, v, q); }), "a has " + nq + " numbers, the model's nv is " + nv);
  EXPECT_EQ(refusal([&] { aba(m, d, q, v, q); }), "tau has " + nq + " numbers, the model's nv is " + nv);
  const std::vector<Force<double>> two(2, Force<double>::Zero());
  EXPECT_EQ(refusal([&] { rnea(m, d, q, v, v, two); }), "fext has 2 numbers, the model's njoints is 7");
}

TEST(Data, HasMatricesOfSizeNvByNvOnlyIfRequested) {
  const Model<double> m = randomModel(3, 6);
  const Vec q = neutral(m), v = Vec::Zero(m.nv);
  Data<double> none(m), mass(m, Dense::Mass);
  EXPECT_EQ(refusal([&] { crba(m, none, q); }), "crba needs nv x nv matrices: make Data(model, Dense::Mass)");
  EXPECT_EQ(refusal([&] { computeRNEADerivatives(m, mass, q, v, v); }),
            "computeRNEADerivatives needs nv x nv matrices: make Data(model, Dense::Derivatives)");
  EXPECT_EQ(none.M.scratch().size(), 0);
}

TEST(Data, AStaleFieldNamesTheMissingCall) {
  const Model<double> m = randomModel(3, 6);
  Random random(3);
  const State s = randomState(m, random), other = randomState(m, random);
  Data<double> d(m, Dense::Mass);
  EXPECT_EQ(refusal([&] { d.tau.checked(); }),
            "Data::tau was never computed: call rnea(model, data, q, v, a) first");
  crba(m, d, s.q);
  nonLinearEffects(m, d, s.q, s.v);
  EXPECT_NO_THROW(d.M.checked());  // the same q
  nonLinearEffects(m, d, s.q, other.v);
  EXPECT_NO_THROW(d.M.checked());  // it does not depend on v
  forwardKinematics(m, d, s.q, s.v);
  EXPECT_EQ(refusal([&] { d.nle.checked(); }),
            "Data::nle belongs to an earlier state: call nonLinearEffects(model, data, q, v) first");
  forwardKinematics(m, d, other.q);
  EXPECT_FALSE(d.M.isFresh());
  EXPECT_FALSE(d.v.isFresh());
  EXPECT_TRUE(d.oMi.isFresh());
  EXPECT_FALSE(d.oMf.isFresh());
}

TEST(Data, AConstantModelServesManyThreads) {
  const Model<double> m = randomModel(5, 12);
  Random random(5);
  const State s = randomState(m, random);
  const auto everything = [&](Data<double>& d) {
    Vec all(5 * m.nv);
    computeABADerivatives(m, d, s.q, s.v, s.tau);
    all << d.ddq_dq() * s.v,  // before rnea's acceleration makes it stale
        rnea(m, d, s.q, s.v, s.a), aba(m, d, s.q, s.v, s.tau), computeMinverse(m, d, s.q) * s.tau,
        computeJointJacobians(m, d, s.q).transpose() * Vector6<double>::Ones();
    centerOfMass(m, d, s.q, s.v, s.a), computeCentroidalMap(m, d, s.q);
    return all;
  };
  Data<double> d(m, Dense::Derivatives);
  const Vec expected = everything(d);
  std::vector<std::thread> threads;
  std::vector<int> same(4, 0);
  for (int& result : same)
    threads.emplace_back([&] {
      Data<double> own(m, Dense::Derivatives);
      for (int i = 0; i < 50; ++i) result += everything(own) == expected;
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(same, std::vector<int>(4, 50));
}

TEST(Data, NoAlgorithmAllocates) {
#ifndef LIECHECK_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations are not counted in this build";
#else
  const auto count = [](auto f) {
    const long before = allocations;
    f();
    return allocations - before;
  };
  EXPECT_EQ(count([] { Vec(3).setZero(); }), 1);  // count() works
  for (unsigned seed : {5U, 6U}) {
    Random random(seed);
    Model<double> m = randomModel(seed, 22);
    if (seed == 6) {
      m.addJoint(1, Revolute<double>(V3(1, 2, 3)), random.pose(), "primary");
      m.appendBodyToJoint(m.njoints - 1, random.body(1));
      m.addJoint(1, Mimic<double>(Revolute<double>(V3(3, 2, 1)), m.njoints - 1, 2, 0), random.pose(),
                 "mimic");
      m.appendBodyToJoint(m.njoints - 1, random.body(1));
    }
    const State s = randomState(m, random);
    const auto fext = random.forces(m.njoints);
    Data<double> d(m, Dense::Derivatives);
    const int frame = m.nframes - 1;
    const auto W = ReferenceFrame::WORLD;
    EXPECT_EQ(count([&] { forwardKinematics(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { forwardKinematics(m, d, s.q, s.v); }), 0);
    EXPECT_EQ(count([&] { forwardKinematics(m, d, s.q, s.v, s.a); }), 0);
    EXPECT_EQ(count([&] { updateFramePlacements(m, d); }), 0);
    EXPECT_EQ(count([&] { getFrameVelocity(m, d, frame, W), imu(m, d, frame); }), 0);
    EXPECT_EQ(count([&] { computeJointJacobiansTimeVariation(m, d, s.q, s.v); }), 0);
    EXPECT_EQ(count([&] { getFrameJacobian(m, d, frame, W), getFrameJacobianTimeVariation(m, d, frame, W); }),
              0);
    EXPECT_EQ(count([&] { rnea(m, d, s.q, s.v, s.a, fext); }), 0);
    EXPECT_EQ(count([&] { nonLinearEffects(m, d, s.q, s.v), computeGeneralizedGravity(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { crba(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { computeMinverse(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { aba(m, d, s.q, s.v, s.tau, fext); }), 0);
    EXPECT_EQ(count([&] { computeMechanicalEnergy(m, d, s.q, s.v); }), 0);
    EXPECT_EQ(count([&] { centerOfMass(m, d, s.q, s.v, s.a), jacobianCenterOfMass(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { computeCentroidalMomentumTimeVariation(m, d, s.q, s.v, s.a); }), 0);
    EXPECT_EQ(count([&] { computeRNEADerivatives(m, d, s.q, s.v, s.a, fext); }), 0);
    EXPECT_EQ(count([&] { computeABADerivatives(m, d, s.q, s.v, s.tau, fext); }), 0);
  }
#endif
}

TEST(Data, AChainOfTenThousandJointsRuns) {
  Model<double> m;
  for (int i = 0; i < 10000; ++i) {
    m.addJoint(i, Revolute<double>(Axis<double>::Y()), {Matrix3<double>::Identity().eval(), V3(0.1, 0, 0)},
               std::to_string(i));
    m.appendBodyToJoint(
        i + 1, Inertia<double>(1, V3(0.05, 0, 0), Matrix3<double>(1e-3 * Matrix3<double>::Identity())));
  }
  Data<double> d(m);
  const Vec q = Vec::Zero(m.nv);
  forwardKinematics(m, d, q);
  EXPECT_NEAR(d.oMi[10000].translation().x(), 1000, 1e-9);
  // A horizontal chain: the first joint carries 10000 bodies, at 500 m on average.
  EXPECT_NEAR(rnea(m, d, q, q, q)[0], -9.81 * 10000 * 500, 1e-4);
  EXPECT_LE(aba(m, d, q, q, d.tau()).norm(), 1e-3);
}

}  // namespace
