// algorithms/rnea, crba, aba, energy, centroidal, derivatives. Checks identities on random trees of every
// joint type, and compares rnea with equations of motion that are computed from poses alone.

#include <gtest/gtest.h>

#include <functional>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <limits>
#include <vector>

#include "long_double.hpp"
#include "random_tree.hpp"
#include "refusal.hpp"

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

TEST(Dynamics, CrbaIsSymmetricPositiveDefiniteAndItsColumnsAreThoseOfRnea) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random&) {
    // crba must set the entries between branches to zero. glibc's allocator gives this memory, full of NaN,
    // to Data, so that an entry that is not set stays NaN. (A sanitizer's allocator does not.)
    std::vector<Mat>(8, Mat::Constant(m.nv, m.nv, std::numeric_limits<double>::quiet_NaN()));
    Data<double> d(m, Dense::Mass), shared(m, Dense::Derivatives);
    const Mat M = crba(m, d, s.q);
    computeRNEADerivatives(m, shared, s.q, s.v, s.a);  // writes M too
    EXPECT_EQ(crba(m, shared, s.q), M);
    EXPECT_EQ(M, M.transpose());
    EXPECT_EQ(M.llt().info(), Eigen::Success);
    const Vec h = nonLinearEffects(m, d, s.q, Vec::Zero(m.nv));
    for (int k = 0; k < m.nv; ++k) {
      const Vec column = rnea(m, d, s.q, Vec::Zero(m.nv), Vec::Unit(m.nv, k)) - h;
      EXPECT_LE((column - M.col(k)).norm(), budget(m) * (M.col(k).norm() + h.norm())) << k;
    }
  });
}

TEST(Dynamics, AbaIsTheInverseOfMTimesTauMinusH) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m, Dense::Mass);
    const Mat Minv = computeMinverse(m, d, s.q), M = d.M();
    EXPECT_EQ(Minv, Minv.transpose());
    const double kappa = M.norm() * Minv.norm();
    EXPECT_LE((M * Minv - Mat::Identity(m.nv, m.nv)).norm(), budget(m) * kappa);
    const Vec rest = s.tau - nonLinearEffects(m, d, s.q, s.v);
    EXPECT_LE((aba(m, d, s.q, s.v, s.tau) - Minv * rest).norm(), budget(m) * kappa * (Minv * rest).norm());
  });
}

TEST(Dynamics, NonLinearEffectsAtRestAreGravityAndExternalForcesActThroughTheJacobians) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random& random) {
    Data<double> d(m);
    const Vec none = Vec::Zero(m.nv), g = computeGeneralizedGravity(m, d, s.q);
    EXPECT_LE((nonLinearEffects(m, d, s.q, none) - g).norm(), budget(m) * g.norm());
    const auto fext = random.forces(m.njoints);
    const Vec free = rnea(m, d, s.q, s.v, s.a), felt = free - rnea(m, d, s.q, s.v, s.a, fext);
    computeJointJacobians(m, d, s.q);
    Vec expected = none;
    for (int i = 1; i < m.njoints; ++i)
      expected +=
          getJointJacobian(m, d, i, ReferenceFrame::LOCAL).transpose() * fext[std::size_t(i)].to_vector();
    EXPECT_LE((felt - expected).norm(), budget(m) * (expected.norm() + d.tau().norm()));
    EXPECT_LE((g - computeStaticTorque(m, d, s.q, fext) - expected).norm(),
              budget(m) * (expected.norm() + g.norm()));
  });
}

TEST(Dynamics, KineticEnergyIsHalfVMV) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m, Dense::Mass);
    const double e = computeKineticEnergy(m, d, s.q, s.v);
    const Mat M = crba(m, d, s.q);
    EXPECT_NEAR(e, s.v.dot(M * s.v) / 2, budget(m) * s.v.cwiseAbs().dot(M.cwiseAbs() * s.v.cwiseAbs()));
  });
}

TEST(Dynamics, PowerOfTheForcesIsTheRateOfTheEnergy) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random&) {
    const Model<Real> ml = m.cast<Real>();
    Data<Real> d(ml);
    const VecL v = s.v.cast<Real>(), a = s.a.cast<Real>();
    const Real rate = derivative([&](Real t) {
      return Eigen::Matrix<Real, 1, 1>(computeMechanicalEnergy(ml, d, along(ml, s, t), VecL(v + t * a)));
    })(0, 0);
    const Real power = rnea(ml, d, VecL(s.q.cast<Real>()), v, a).dot(v);
    // v(t) of the path is v + t a + O(t^2); O(t^2) does not change the rate at 0.
    EXPECT_NEAR(double(rate), double(power), 1e-13 * (double(d.tau().norm() * v.norm())));
  });
}

// The equations of motion without spatial algebra. The force m (c_ddot - g) and the moment I alpha + omega x
// I omega of each body are projected on the derivatives of c and R by each coordinate. All derivatives are
// differences of poses.
TEST(Dynamics, RneaIsTheProjectedNewtonEulerEquation) {
  for (unsigned seed = 31; seed <= 36; ++seed) {
    Model<double> m = randomModel(seed, 11, seed % 2 ? Shape::Tree : Shape::Chain);
    m.armature.setZero();
    Random random(seed);
    const State s = randomState(m, random);
    const Model<Real> ml = m.cast<Real>();
    Data<Real> d(ml);
    const auto pose = [&](const VecL& q, std::size_t i) {
      forwardKinematics(ml, d, q);
      Eigen::Matrix<Real, 3, 4> X;
      X << d.oMi[i].rotation(), d.oMi[i].act(ml.inertias[i].lever());
      return X;
    };
    const auto unskew = [](const Matrix3<Real>& W) { return Vector3<Real>(W(2, 1), W(0, 2), W(1, 0)); };
    const VecL q = s.q.cast<Real>();
    VecL tau = VecL::Zero(m.nv);
    for (std::size_t i = 1; i < ml.joints.size(); ++i) {
      const auto path = [&](Real t) { return pose(along(ml, s, t), i); };
      const Eigen::Matrix<Real, 3, 4> X = path(0), rate = derivative(path), second = secondDerivative(path);
      const Matrix3<Real> R = X.leftCols<3>(), R_dot = rate.leftCols<3>(), R_ddot = second.leftCols<3>();
      const Vector3<Real> omega = unskew(R_dot * R.transpose());
      const Vector3<Real> alpha = unskew(R_ddot * R.transpose() + R_dot * R_dot.transpose());
      const Matrix3<Real> I = R * ml.inertias[i].inertia() * R.transpose();
      const Vector3<Real> f = ml.inertias[i].mass() * (second.col(3) - ml.gravity);
      const Vector3<Real> n = I * alpha + omega.cross(Vector3<Real>(I * omega));
      for (int k = 0; k < m.nv; ++k) {
        const Eigen::Matrix<Real, 3, 4> X_k =
            derivative([&](Real t) { return pose(integrate(ml, q, VecL(t * VecL::Unit(m.nv, k))), i); });
        tau[k] += f.dot(X_k.col(3)) + n.dot(unskew(X_k.leftCols<3>() * R.transpose()));
      }
    }
    EXPECT_LE(relativeNorm(rnea(ml, d, q, VecL(s.v.cast<Real>()), VecL(s.a.cast<Real>())), tau, 0), 1e-11);
    Data<double> dd(m);
    EXPECT_LE(relative(rnea(m, dd, s.q, s.v, s.a), d.tau().cast<double>().eval()), budget(m));
  }
}

TEST(Dynamics, WithoutGravityAndForcesAFloatingRobotKeepsItsMomentum) {
  for (unsigned seed = 41; seed <= 46; ++seed) {
    Random random(seed);
    Model<double> m;
    m.gravity.setZero();
    m.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "base");
    m.appendBodyToJoint(1, random.body(5));
    for (int i = 0; i < 10; ++i) {
      m.addJoint(1 + random.below(i + 1), jointOfKind(i, random), random.pose(), "j" + std::to_string(i));
      m.appendBodyToJoint(i + 2, random.body(1));
    }
    const State s = randomState(m, random);
    Data<double> d(m);
    const Vec a = aba(m, d, s.q, s.v, Vec::Zero(m.nv));
    const auto rate = computeCentroidalMomentumTimeVariation(m, d, s.q, s.v, a).to_vector();
    EXPECT_LE(rate.norm(), budget(m) * computeCentroidalMap(m, d, s.q).norm() * a.norm());
  }
}

TEST(Dynamics, DerivativesEqualFiniteDifferencesInLongDouble) {
  for (unsigned seed = 51; seed <= 58; ++seed) {
    const Model<double> m = randomModel(seed, 11, seed % 2 ? Shape::Tree : Shape::Chain);
    Random random(seed);
    const State s = randomState(m, random);
    const auto fext = random.forces(m.njoints);
    std::vector<Force<Real>> fl;
    for (const auto& f : fext) fl.emplace_back(Vector6<Real>(f.to_vector().cast<Real>()));
    const Model<Real> ml = m.cast<Real>();
    Data<Real> dl(ml);
    const VecL q = s.q.cast<Real>(), v = s.v.cast<Real>(), a = s.a.cast<Real>(), tau = s.tau.cast<Real>();
    MatrixX<Real> tau_q(m.nv, m.nv), tau_v = tau_q, a_q = tau_q, a_v = tau_q;
    for (int k = 0; k < m.nv; ++k) {
      const VecL e = VecL::Unit(m.nv, k);
      tau_q.col(k) =
          derivative([&](Real t) { return rnea(ml, dl, integrate(ml, q, VecL(t * e)), v, a, fl); });
      tau_v.col(k) = derivative([&](Real t) { return rnea(ml, dl, q, VecL(v + t * e), a, fl); });
      a_q.col(k) = derivative([&](Real t) { return aba(ml, dl, integrate(ml, q, VecL(t * e)), v, tau, fl); });
      a_v.col(k) = derivative([&](Real t) { return aba(ml, dl, q, VecL(v + t * e), tau, fl); });
    }
    Data<double> d(m, Dense::Derivatives);
    computeRNEADerivatives(m, d, s.q, s.v, s.a, fext);
    EXPECT_LE(relative(d.dtau_dq(), tau_q.cast<double>().eval()), 1e-12);
    EXPECT_LE(relative(d.dtau_dv(), tau_v.cast<double>().eval()), 1e-12);
    const Mat M = d.M();
    EXPECT_LE(relative(crba(m, d, s.q), M), budget(m));
    computeABADerivatives(m, d, s.q, s.v, s.tau, fext);
    const double kappa = M.norm() * d.Minv().norm();
    EXPECT_LE(relative(d.ddq_dq(), a_q.cast<double>().eval()), 1e-12 + 64 * kappa * eps<double>());
    EXPECT_LE(relative(d.ddq_dv(), a_v.cast<double>().eval()), 1e-12 + 64 * kappa * eps<double>());
  }
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
