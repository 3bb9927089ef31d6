// algorithms/rnea, crba, aba, centroidal, derivatives: what the laws on trees do not measure.

#include <gtest/gtest.h>

#include <functional>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <limits>
#include <vector>

#include "random_tree.hpp"
#include "../refusal.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using Mat = MatrixX<double>;

TEST(Dynamics, RneaOfAbaIsTau) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random& random) {
    Data<double> d(m, Dense::Mass);
    const auto fext = random.forces(m.njoints);
    const Vec a = aba(m, d, s.q, s.v, s.tau, fext);
    const Vec tau = rnea(m, d, s.q, s.v, a, fext);
    const double size =
        (crba(m, d, s.q).cwiseAbs() * a.cwiseAbs()).norm() + nonLinearEffects(m, d, s.q, s.v).norm();
    EXPECT_LE((tau - s.tau).norm(), budget(m) * (size + s.tau.norm()));
  });
}

TEST(Dynamics, CrbaWritesEveryEntryAndMAndItsInverseAreSymmetricToTheLastBit) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random&) {
    // crba must set the entries between branches to zero. glibc's allocator gives this memory, full of NaN,
    // to Data, so that an entry that is not set stays NaN. (A sanitizer's allocator does not.)
    std::vector<Mat>(8, Mat::Constant(m.nv, m.nv, std::numeric_limits<double>::quiet_NaN()));
    Data<double> d(m, Dense::Mass), shared(m, Dense::Derivatives);
    const Mat M = crba(m, d, s.q);
    computeRNEADerivatives(m, shared, s.q, s.v, s.a);  // writes M too
    EXPECT_LE(relative(shared.M(), M), budget(m));
    EXPECT_EQ(crba(m, shared, s.q), M);
    EXPECT_EQ(M, M.transpose());
    const Mat Minv = computeMinverse(m, d, s.q);
    EXPECT_EQ(Minv, Minv.transpose());
  });
}

/// The laws push one joint at a time.
TEST(Dynamics, ExternalForcesActThroughTheJacobians) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random& random) {
    Data<double> d(m, Dense::Derivatives);
    const auto fext = random.forces(m.njoints);
    const auto derivative = [&](External<double> f) {
      computeRNEADerivatives(m, d, s.q, s.v, s.a, f);
      return Mat(d.dtau_dq());
    };
    Mat by_each = derivative({});
    const Vec g = computeGeneralizedGravity(m, d, s.q);
    const Vec free = rnea(m, d, s.q, s.v, s.a), felt = free - rnea(m, d, s.q, s.v, s.a, fext);
    computeJointJacobians(m, d, s.q);
    Vec expected = Vec::Zero(m.nv);
    for (std::size_t i = 1; i < fext.size(); ++i)
      expected += getJointJacobian(m, d, int(i), ReferenceFrame::LOCAL).transpose() * fext[i].to_vector();
    EXPECT_LE((felt - expected).norm(), budget(m) * (expected.norm() + d.tau().norm()));
    EXPECT_LE((g - computeStaticTorque(m, d, s.q, fext) - expected).norm(),
              budget(m) * (expected.norm() + g.norm()));
    const Mat alone = by_each;
    for (std::size_t i = 1; i < fext.size(); ++i) {
      std::vector<Force<double>> one(fext.size(), Force<double>::Zero());
      one[i] = fext[i];
      by_each += derivative(one) - alone;
    }
    EXPECT_LE(relative(derivative(fext), by_each), m.njoints * budget(m));
  });
}

/// The rate of the momentum is the force at the root and gravity; both move the centre of mass.
TEST(Dynamics, TheRateOfTheMomentumIsTheForceOnTheRobot) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m);
    forwardKinematics(m, d, s.q), rnea(m, d, s.q, s.v, s.a);
    Force<double> root = Force<double>::Zero();
    double size = 0;
    for (std::size_t i = 1; i < m.joints.size(); ++i) {
      size += d.oMi[i].act(d.f[i]).to_vector().norm();
      if (m.parents[i] == 0) root = root + d.oMi[i].act(d.f[i]);
    }
    const double mass = computeTotalMass(m), energy = computePotentialEnergy(m, d, s.q);
    const V3 com = centerOfMass(m, d, s.q, s.v, s.a);
    EXPECT_NEAR(-mass * m.gravity.dot(com), energy, budget(m) * mass * m.gravity.norm() * (1 + com.norm()));
    const Vec map = computeCentroidalMap(m, d, s.q) * s.v;
    const auto h = computeCentroidalMomentum(m, d, s.q, s.v);
    EXPECT_LE((h.to_vector() - map).norm(), budget(m) * d.Ag().norm() * s.v.norm());
    EXPECT_LE((mass * d.vcom() - h.linear()).norm(), budget(m) * d.Ag().norm() * s.v.norm());
    jacobianCenterOfMass(m, d, s.q);
    EXPECT_LE((d.Jcom() * s.v - d.vcom()).norm(), budget(m) * d.Jcom().norm() * s.v.norm());
    const auto rate = computeCentroidalMomentumTimeVariation(m, d, s.q, s.v, s.a);
    const V3 force = root.linear() + mass * m.gravity, moment = root.angular() - com.cross(root.linear());
    EXPECT_LE((rate.linear() - force).norm(), budget(m) * size);
    EXPECT_LE((rate.angular() - moment).norm(), budget(m) * size * (1 + com.norm()));
    EXPECT_LE((mass * d.acom() - rate.linear()).norm(), budget(m) * size);
  });
}

// crba stores quotients of masses in Data. Its results must not depend on what the same Data computed before.
TEST(Dynamics, CrbaUsesAnInertiaThatHasChanged) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random& random) {
    Model<double> changing = m;
    Data<double> d(changing, Dense::Mass);
    for (int change = 0; change < 4; ++change) {
      const Mat M = crba(changing, d, s.q);
      Data<double> fresh(changing, Dense::Mass);
      EXPECT_EQ(M, crba(changing, fresh, s.q)) << change;
      const std::size_t i = std::size_t(1 + random.below(m.njoints - 1));
      const Inertia<double> I = changing.inertias[i];
      const double factor = change == 1 ? 0 : random.uniform(0.1, 10);
      changing.inertias[i] =
          Inertia<double>(factor * I.mass(), I.lever(), Matrix3<double>(factor * I.inertia()));
    }
  });
}

// A point mass of 2 kg on a rod of 1 m.
TEST(Dynamics, APendulumAcceleratesAsComputedByHand) {
  Model<double> m;
  m.addJoint(0, Revolute<double>(Axis<double>::Y()), SE3<double>::Identity(), "hinge");
  m.appendBodyToJoint(1, Inertia<double>(2, V3(1, 0, 0), Matrix3<double>::Zero()));
  Data<double> d(m, Dense::Mass);
  const Vec zero = Vec::Zero(1);
  EXPECT_DOUBLE_EQ(crba(m, d, zero)(0, 0), 2);
  EXPECT_DOUBLE_EQ(computeGeneralizedGravity(m, d, zero)[0],
                   -19.62);  // a rotation about +y lowers a mass on +x
  EXPECT_DOUBLE_EQ(aba(m, d, zero, zero, zero)[0], 9.81);
}

TEST(Dynamics, MasslessLinksAreNamedIfTheyMakeTheDynamicsSingular) {
  Model<double> m;
  const SE3<double> X = at(0.1, 0.2, 0.3);
  m.addJoint(0, Revolute<double>(Axis<double>::Y()), X, "shoulder");
  m.appendBodyToJoint(1,
                      Inertia<double>(1, V3(0.3, 0, 0), Matrix3<double>(0.01 * Matrix3<double>::Identity())));
  m.addJoint(1, Revolute<double>(V3(1, 2, 3)), X, "wrist");
  m.addJoint(2, Spherical<double>(), X, "ball");
  Data<double> d(m, Dense::Mass);
  const Vec q = neutral(m), v = Vec::Ones(m.nv);
  EXPECT_TRUE(rnea(m, d, q, v, v).allFinite());
  EXPECT_TRUE(crba(m, d, q).allFinite());
  const auto named = [](auto call, const std::string& name) {
    EXPECT_TRUE(has(refusal<SingularInertia>(call), "'" + name + "'"));
  };
  named([&] { aba(m, d, q, v, v); }, "ball");
  named([&] { computeMinverse(m, d, q); }, "ball");
  m.armature.tail<3>().setConstant(1e-3);  // inertia of the motors
  named([&] { aba(m, d, q, v, v); }, "wrist");
  named([&] { computeMinverse(m, d, q); }, "wrist");
  m.armature[1] = 1e-3;
  EXPECT_TRUE(aba(m, d, q, v, v).allFinite());
}

TEST(Dynamics, ARobotWithoutMassHasNoCentreOfMass) {
  Model<double> m;
  m.name = "ghost";
  m.addJoint(0, Revolute<double>(Axis<double>::Y()), SE3<double>::Identity(), "hinge");
  m.appendBodyToJoint(0, Inertia<double>(1, V3(1, 2, 3), Matrix3<double>::Zero()));  // fixed to the world
  const Vec q = Vec::Ones(1), v = q, a = q;
  const auto refused = [&](const std::string& why) {
    Data<double> d(m);
    const std::function<void()> calls[] = {[&] { centerOfMass(m, d, q); },
                                           [&] { centerOfMass(m, d, q, v); },
                                           [&] { centerOfMass(m, d, q, v, a); },
                                           [&] { jacobianCenterOfMass(m, d, q); },
                                           [&] { computeCentroidalMap(m, d, q); },
                                           [&] { computeCentroidalMomentum(m, d, q, v); },
                                           [&] { computeCentroidalMomentumTimeVariation(m, d, q, v, a); }};
    for (const auto& call : calls)
      EXPECT_EQ(refusal<std::domain_error>(call),
                "model 'ghost' has no centre of mass: the total mass of its moving bodies is " + why);
    EXPECT_FALSE(d.oMi.isFresh() || d.com.isFresh() || d.vcom.isFresh() || d.acom.isFresh() ||
                 d.Jcom.isFresh() || d.Ag.isFresh() || d.hg.isFresh() || d.dhg.isFresh());
  };
  EXPECT_EQ(computeTotalMass(m), 0);
  refused("0");
  const auto carries = [&](double mass) {
    m.inertias[1] = Inertia<double>(mass, V3(1, 0, 0), Matrix3<double>::Zero());
  };
  carries(std::numeric_limits<double>::infinity());
  refused("not finite");
  carries(std::numeric_limits<double>::quiet_NaN());
  refused("NaN");
  carries(1e-300);
  Data<double> d(m);
  EXPECT_TRUE(centerOfMass(m, d, q, v, a).allFinite() && jacobianCenterOfMass(m, d, q).allFinite());
}

TEST(Dynamics, AnInertiaThatOverflowsIsReportedAsNotFinite) {
  Model<double> m;
  m.addJoint(0, Revolute<double>(Axis<double>::Z()), SE3<double>::Identity(), "turntable");
  m.addJoint(1, Prismatic<double>(Axis<double>::X()), SE3<double>::Identity(), "slide");
  m.appendBodyToJoint(2, Inertia<double>(1, V3::Zero(), Matrix3<double>::Identity().eval()));
  Data<double> d(m, Dense::Mass);
  const Vec q = Eigen::Vector2d(0, 1e200), v = Vec::Ones(m.nv);
  for (const bool inverse : {false, true})
    EXPECT_TRUE(has(refusal<SingularInertia>(
                        [&] { inverse ? void(computeMinverse(m, d, q)) : void(aba(m, d, q, v, v)); }),
                    "'turntable' (joint 1) moves an inertia that is not finite"));
}

}  // namespace
