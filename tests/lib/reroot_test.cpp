// Compares several models of one robot.

#include <gtest/gtest.h>

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/crba.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <liecheck/algorithms/kinematics.hpp>
#include <liecheck/algorithms/rnea.hpp>

#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using Mat = MatrixX<double>;

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

// In the second model of a free-floating robot the joint between the base and a child is reversed, q' = q^-1, and the
// child is the base. Without forces on the base the joint forces are equal.

Model<double> floatingModel(unsigned seed, int n) {
  Random random(seed);
  Model<double> m;
  m.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "base");
  m.appendBodyToJoint(1, random.body(1), random.pose());
  for (int i = 0; i < n; ++i) {
    const int parent = i == 0 ? 1 : 1 + random.below(i + 1);
    const int joint = m.addJoint(parent, jointOfKind((int(seed) + i) % joint_kinds, random), random.pose(),
                                 "j" + std::to_string(i));
    m.appendBodyToJoint(joint, random.body(1), random.pose());
  }
  return m;
}

/// The robot with joint 2, a child of the base, reversed. S v' = -Ad(T(q)) S v gives v' = reversal v. Since S
/// is constant, a' = reversal a. In both models the base is joint 1 and the reversed joint is joint 2.
struct Rerooted {
  Model<double> model;
  Vec q, v, a;
  Mat reversal;

  Rerooted(const Model<double>& m, const State& s) {
    Data<double> d(m);
    forwardKinematics(m, d, s.q, s.v, s.a);
    const SE3<double> X = m.jointPlacements[2].inverse();
    Motion<double> V = d.v[2], A = d.a[2];
    model.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "base");
    model.appendBodyToJoint(1, m.inertias[2]);
    model.addJoint(1, m.joints[2], SE3<double>::Identity(), m.names[2]);
    model.appendBodyToJoint(2, m.inertias[1], X);
    for (int i = 3; i < m.njoints; ++i) {
      const std::size_t k = std::size_t(i);
      const int parent = m.parents[k];
      model.addJoint(parent == 1   ? 2
                     : parent == 2 ? 1
                                   : parent,
                     m.joints[k], parent == 1 ? X * m.jointPlacements[k] : m.jointPlacements[k], m.names[k]);
      model.appendBodyToJoint(i, m.inertias[k]);
    }
    const int nq = m.nqs[2], nv = m.nvs[2];
    const Vec inverse = integrate(m, neutral(m), difference(m, s.q, neutral(m)));
    Mat S;
    SE3<double> T;
    multibody_detail::visitJoint(m, 2, [&](const auto& place) {
      S = place.joint.subspace();
      T = X * place.transform(s.q);
    });
    reversal = -(S.transpose() * S).ldlt().solve(S.transpose() * T.toActionMatrix() * S);
    q = s.q, v = s.v, a = s.a;
    const auto Q = SO3<double>::fromMatrix(d.oMi[2].rotation()).normalized();
    q.head<7>() << d.oMi[2].translation(), Q.to_vector();
    v.head<6>() = V.to_vector(), a.head<6>() = A.to_vector();
    q.segment(7, nq) = inverse.segment(7, nq);
    v.segment(6, nv) = reversal * s.v.segment(6, nv), a.segment(6, nv) = reversal * s.a.segment(6, nv);
  }
};

TEST(Reroot, JointForcesAreEqualAndTheNewBaseNeedsNoForce) {
  for (unsigned seed = 0; seed < 4 * joint_kinds; ++seed) {
    SCOPED_TRACE(seed);
    const Model<double> m = floatingModel(seed, 1 + int(seed % 7) * 2);
    Random random(100 + seed);
    State s = randomState(m, random);
    s.tau.head<6>().setZero();
    Data<double> d(m, Dense::Mass);
    s.a = aba(m, d, s.q, s.v, s.tau);
    const Rerooted other(m, s);
    Data<double> e(other.model, Dense::Mass);
    Vec tau = rnea(other.model, e, other.q, other.v, other.a);
    const int nv = m.nvs[2];
    tau.segment(6, nv) = (other.reversal.transpose() * tau.segment(6, nv)).eval();
    const double size = (crba(m, d, s.q).cwiseAbs() * s.a.cwiseAbs()).norm() +
                        nonLinearEffects(m, d, s.q, s.v).norm() +
                        (crba(other.model, e, other.q).cwiseAbs() * other.a.cwiseAbs()).norm() +
                        nonLinearEffects(other.model, e, other.q, other.v).norm();
    // Allows rounding errors in each of nv terms and in the pose, velocity and acceleration of the new base.
    // All bounds below are relative to the sizes of the terms of a sum.
    const double budget = 16 * m.nv * eps<double>();
    EXPECT_LE((tau - s.tau).norm(), budget * size);

    const double energy = computeKineticEnergy(m, d, s.q, s.v);  // a sum of positive terms
    EXPECT_NEAR(computeKineticEnergy(other.model, e, other.q, other.v), energy, budget * energy);
    forwardKinematics(m, d, s.q);
    double heights = 0;
    for (std::size_t i = 1; i < m.joints.size(); ++i)
      heights += m.inertias[i].mass() * m.gravity.norm() * d.oMi[i].act(m.inertias[i].lever()).norm();
    EXPECT_NEAR(computePotentialEnergy(other.model, e, other.q), computePotentialEnergy(m, d, s.q),
                budget * heights);
    const Vector6<double> h = computeCentroidalMomentum(m, d, s.q, s.v).to_vector();
    const Vector6<double> g = computeCentroidalMomentum(other.model, e, other.q, other.v).to_vector();
    const auto terms = [](const Mat& A, const Vec& v) { return (A.cwiseAbs() * v.cwiseAbs()).norm(); };
    EXPECT_LE((g - h).norm(), budget * (terms(computeCentroidalMap(m, d, s.q), s.v) +
                                        terms(computeCentroidalMap(other.model, e, other.q), other.v)));
  }
}

}  // namespace
