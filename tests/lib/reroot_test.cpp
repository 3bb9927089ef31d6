// Compares two models of one free-floating robot. In the second model the joint between the base and a child
// is reversed, q' = q^-1, and the child is the base. Without forces on the base the joint forces are equal.

#include <gtest/gtest.h>

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/crba.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/kinematics.hpp>
#include <liecheck/algorithms/rnea.hpp>

#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using Mat = MatrixX<double>;

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
