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

TEST(Dynamics, MomentumIsTheCentroidalMapTimesVAndItsRateIsItsDerivative) {
  forEachRobot(1, 24, 22, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m);
    const auto hg = computeCentroidalMomentum(m, d, s.q, s.v).to_vector();
    const Vec through_map = computeCentroidalMap(m, d, s.q) * s.v;
    const double size = d.Ag().norm() * s.v.norm();
    EXPECT_LE((hg - through_map).norm(), budget(m) * size);
    jacobianCenterOfMass(m, d, s.q), centerOfMass(m, d, s.q, s.v);
    EXPECT_LE((d.Jcom() * s.v - d.vcom()).norm(), budget(m) * d.Jcom().norm() * s.v.norm());
    const Model<Real> ml = m.cast<Real>();
    Data<Real> dl(ml);
    const VecL v = s.v.cast<Real>(), a = s.a.cast<Real>();
    const Vector6<Real> rate = derivative([&](Real t) {
      return computeCentroidalMomentum(ml, dl, along(ml, s, t), VecL(v + t * a)).to_vector();
    });
    const auto dhg = computeCentroidalMomentumTimeVariation(m, d, s.q, s.v, s.a).to_vector();
    EXPECT_LE(relative(dhg, Vec(rate.cast<double>()), size), 1e-12);
    const Vector3<Real> vcom = derivative([&](Real t) { return centerOfMass(ml, dl, along(ml, s, t)); });
    const Vector3<Real> acom =
        secondDerivative([&](Real t) { return centerOfMass(ml, dl, along(ml, s, t)); });
    centerOfMass(m, d, s.q, s.v, s.a);
    EXPECT_LE(relative(d.vcom(), vcom.cast<double>().eval(), 1), 1e-12);
    EXPECT_LE(relative(d.acom(), acom.cast<double>().eval(), 1), 1e-11);
  });
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

TEST(Dynamics, MovingTheWorldReorderingJointsAndSplittingABodyChangeNothing) {
  for (unsigned seed = 61; seed <= 64; ++seed) {
    Random random(seed);
    const SE3<double> X = random.pose(), far(X.rotation(), V3(1e6, -2e6, 3e6)), behind = random.pose();
    const Inertia<double> trunk = random.body(3), left = random.body(1), right = random.body(2);
    const SE3<double> X_left = random.pose(), X_right = random.pose(), cut = random.pose();
    const auto build = [&](const SE3<double>& world, bool swapped, bool split) {
      Model<double> m;
      m.gravity = world.rotation() * m.gravity;
      m.addJoint(0, Revolute<double>(Axis<double>::Y()), world * behind, "trunk");
      if (split) {  // two halves, one of them in another frame
        const Inertia<double> half(trunk.mass() / 2, trunk.lever(), trunk.inertia() / 2);
        m.appendBodyToJoint(1, half);
        m.appendBodyToJoint(1, cut.actInv(half), cut);
      } else {
        m.appendBodyToJoint(1, trunk);
      }
      for (int k : {swapped ? 1 : 0, swapped ? 0 : 1}) {
        const int j =
            m.addJoint(1, Revolute<double>(V3(1, k, 2)), k ? X_right : X_left, k ? "right" : "left");
        m.appendBodyToJoint(j, k ? right : left);
      }
      return m;
    };
    const Vec q = random.tangent(3, 1), v = random.tangent(3, 2), a = random.tangent(3, 3);
    const auto swap = [](const Vec& x) { return Vec(V3(x[0], x[2], x[1])); };
    const auto tau_of = [&](const Model<double>& m, bool swapped) {
      Data<double> d(m, Dense::Mass);
      const Vec tau = swapped ? swap(rnea(m, d, swap(q), swap(v), swap(a))) : Vec(rnea(m, d, q, v, a));
      const Vec back = swapped ? swap(aba(m, d, swap(q), swap(v), swap(tau))) : Vec(aba(m, d, q, v, tau));
      EXPECT_LE(relative(back, a), 1e3 * eps<double>());
      return tau;
    };
    const Vec tau = tau_of(build(SE3<double>::Identity(), false, false), false);
    EXPECT_LE(relative(tau_of(build(X, false, false), false), tau), 64 * eps<double>());
    EXPECT_LE(relative(tau_of(build(far, false, false), false), tau), 64 * eps<double>());
    EXPECT_LE(relative(tau_of(build(X, true, false), true), tau), 64 * eps<double>());
    EXPECT_LE(relative(tau_of(build(X, false, true), false), tau), 64 * eps<double>());
  }
}

// A mimic joint constrains the free robot to q = G y + offset. Then tau = G^T tau_free and M = G^T M_free G.
TEST(Dynamics, ARobotWithAMimicEqualsTheConstrainedFreeRobot) {
  for (unsigned seed = 71; seed <= 76; ++seed) {
    Random random(seed);
    const bool chained = seed % 2;
    Model<double> tied, free;
    std::vector<Joint<double>> joints = {
        Revolute<double>(random.vector(1)), Prismatic<double>(random.vector(1)),
        Helical<double>(random.vector(1), 0.2), Revolute<double>(Axis<double>::X())};
    const double factor = random.uniform(-2, 2), offset = random.uniform(-1, 1);
    for (int i = 0; i < 4; ++i) {
      const SE3<double> X = random.pose();
      const Inertia<double> I = random.body(2);
      const std::string name = "j" + std::to_string(i);
      const int parent = chained ? i : i == 0 ? 0 : 1;
      free.addJoint(parent, joints[std::size_t(i)], X, name);
      if (i == 2)
        tied.addJoint(parent, Mimic<double>(std::get<Helical<double>>(joints[2]), 2, factor, offset), X,
                      name);
      else
        tied.addJoint(parent, joints[std::size_t(i)], X, name);
      free.appendBodyToJoint(i + 1, I), tied.appendBodyToJoint(i + 1, I);
    }
    ASSERT_EQ(tied.nv, 3);
    EXPECT_EQ(tied.idx_vs, (std::vector<int>{0, 0, 1, 1, 2}));
    Mat G = Mat::Zero(4, 3);
    G(0, 0) = G(1, 1) = G(3, 2) = 1, G(2, 1) = factor;
    const Vec y = random.tangent(3, 1), v = random.tangent(3, 2), a = random.tangent(3, 3),
              tau = random.tangent(3, 4);
    const Vec q = G * y + offset * Vec::Unit(4, 2);
    Data<double> dt(tied, Dense::Derivatives), df(free, Dense::Derivatives);
    const auto same = [](const Mat& x, const Mat& expected) {
      EXPECT_LE(relative(x, expected), 256 * eps<double>());
    };
    same(rnea(tied, dt, y, v, a), (G.transpose() * rnea(free, df, q, Vec(G * v), Vec(G * a))).eval());
    same(crba(tied, dt, y), (G.transpose() * crba(free, df, q) * G).eval());
    same(computeJointJacobians(tied, dt, y), (computeJointJacobians(free, df, q) * G).eval());
    same(computeCentroidalMap(tied, dt, y), (computeCentroidalMap(free, df, q) * G).eval());
    computeRNEADerivatives(tied, dt, y, v, a), computeRNEADerivatives(free, df, q, Vec(G * v), Vec(G * a));
    same(dt.dtau_dq(), (G.transpose() * df.dtau_dq() * G).eval());
    same(dt.dtau_dv(), (G.transpose() * df.dtau_dv() * G).eval());
    const Vec ddq = aba(tied, dt, y, v, tau);
    EXPECT_LE(relative(rnea(tied, dt, y, v, ddq), tau), 1e4 * eps<double>());
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
