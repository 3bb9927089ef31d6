// algorithms/coriolis, kinematics_derivatives, centroidal_derivatives and operational_space, and derivatives of static
// torques: against the functions whose rates they are, by central differences.

#include <gtest/gtest.h>

#include <functional>
#include <liecheck/algorithms/centroidal_derivatives.hpp>
#include <liecheck/algorithms/coriolis.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/kinematics_derivatives.hpp>
#include <liecheck/algorithms/operational_space.hpp>
#include <stdexcept>

#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using Mat = MatrixX<double>;

constexpr double step = 1e-5, allowed = 1e-7;  // errors of a central difference: step^2 and eps / step

/// The derivative of f(q, v) along integrate in q, or in v, column by column.
Mat slope(const Model<double>& m, const State& s, bool by_q,
          const std::function<Vec(const Vec&, const Vec&)>& f) {
  Mat D;
  for (int k = 0; k < m.nv; ++k) {
    const auto at = [&](double h) {
      const Vec d = h * Vec::Unit(m.nv, k);
      return by_q ? f(integrate(m, s.q, d), s.v) : f(s.q, s.v + d);
    };
    const Vec change = (at(step) - at(-step)) / (2 * step);
    if (k == 0) D.resize(change.size(), m.nv);
    D.col(k) = change;
  }
  return D;
}
void expectSame(const Mat& a, const Mat& b) {
  EXPECT_LE((a - b).norm(), allowed * (1 + b.norm()));
}

/// Adds a frame at a distance from the last joint and rotated.
int addedFrame(Model<double>& m, Random& random) {
  return m.addFrame({"at a distance", m.njoints - 1, 0, random.pose(), FrameType::OP_FRAME});
}

constexpr ReferenceFrame references[] = {ReferenceFrame::LOCAL, ReferenceFrame::WORLD,
                                         ReferenceFrame::LOCAL_WORLD_ALIGNED};

TEST(TreeRates, TheCoriolisMatrixGivesTheTorquesAndTheRateOfM) {
  forEachRobot(1, 24, 12, [](const Model<double>& model, const State& s, Random&) {
    Model<double> m = model;
    m.gravity.setZero();
    Data<double> d(m, Dense::Derivatives);
    const Mat C = computeCoriolisMatrix(m, d, s.q, s.v);
    const Vec h = nonLinearEffects(m, d, s.q, s.v);
    EXPECT_LE((C * s.v - h).norm(), 64 * budget(m) * (1 + (C.cwiseAbs() * s.v.cwiseAbs()).norm()));
    const auto M = [&](double t) { return Mat(crba(m, d, integrate(m, s.q, Vec(t * s.v)))); };
    expectSame(C + C.transpose(), (M(step) - M(-step)) / (2 * step));
  });
}

TEST(TreeRates, FrameDerivativesAreThoseOfDifferencesInEachReference) {
  forEachRobot(1, 24, 12, [](const Model<double>& model, const State& s, Random& random) {
    Model<double> m = model;
    const int frame = addedFrame(m, random);
    Data<double> d(m, Dense::Derivatives);
    for (const ReferenceFrame reference : references) {
      const auto velocity = [&](const Vec& q, const Vec& v) {
        forwardKinematics(m, d, q, v);
        return Vec(getFrameVelocity(m, d, frame, reference).to_vector());
      };
      const auto acceleration = [&](const Vec& q, const Vec& v) {
        forwardKinematics(m, d, q, v, s.a);
        return Vec(getFrameAcceleration(m, d, frame, reference).to_vector());
      };
      Mat V_q(6, m.nv), V_v = V_q, A_q = V_q, A_v = V_q, A_a = V_q;
      computeForwardKinematicsDerivatives(m, d, s.q, s.v, s.a);
      getFrameVelocityDerivatives<double>(m, d, frame, reference, V_q, V_v);
      getFrameAccelerationDerivatives<double>(m, d, frame, reference, A_q, A_v, A_a);
      expectSame(V_q, slope(m, s, true, velocity));
      expectSame(V_v, slope(m, s, false, velocity));
      expectSame(A_q, slope(m, s, true, acceleration));
      expectSame(A_v, slope(m, s, false, acceleration));
      EXPECT_EQ(A_a, V_v);
    }
  });
}

TEST(TreeRates, CentroidalDerivativesAreThoseOfDifferences) {
  forEachRobot(1, 24, 12, [](const Model<double>& m, const State& s, Random&) {
    Data<double> d(m, Dense::Derivatives);
    const auto momentum = [&](const Vec& q, const Vec& v) {
      return Vec(computeCentroidalMomentum(m, d, q, v).to_vector());
    };
    const auto rate = [&](const Vec& q, const Vec& v) {
      return Vec(computeCentroidalMomentumTimeVariation(m, d, q, v, s.a).to_vector());
    };
    Mat h_q(6, m.nv), f_q = h_q, f_v = h_q, f_a = h_q;
    computeCentroidalDynamicsDerivatives<double>(m, d, s.q, s.v, s.a, h_q, f_q, f_v, f_a);
    expectSame(h_q, slope(m, s, true, momentum));
    expectSame(f_q, slope(m, s, true, rate));
    expectSame(f_v, slope(m, s, false, rate));
    expectSame(f_a, Mat(computeCentroidalMap(m, d, s.q)));
  });
}

TEST(TreeRates, StaticTorquesAndTheInertiaOfAFrame) {
  int judged = 0;
  forEachRobot(1, 240, 12, [&](const Model<double>& model, const State& s, Random& random) {
    Model<double> m = model;
    const int frame = addedFrame(m, random);
    Data<double> d(m, Dense::Derivatives);
    const auto fext = random.forces(m.njoints);
    const auto torque = [&](const Vec& q, const Vec&) { return Vec(computeStaticTorque(m, d, q, fext)); };
    const Mat by_q = computeStaticTorqueDerivatives(m, d, s.q, fext);
    expectSame(by_q, slope(m, s, true, torque));
    for (const ReferenceFrame reference : references) {
      const Mat J = [&] {
        computeJointJacobians(m, d, s.q);
        return Mat(getFrameJacobian(m, d, frame, reference));
      }();
      const Mat K = J * computeMinverse(m, d, s.q) * J.transpose();
      const Mat rows = J.rowwise().norm().cwiseMax(1e-300).cwiseInverse().asDiagonal() * J;
      const bool moves_freely = Eigen::FullPivLU<Mat>(rows).setThreshold(1e-12).rank() == 6;
      try {
        const Mat Lambda = computeOperationalSpaceInertia(m, d, s.q, frame, reference);
        EXPECT_TRUE(moves_freely);
        EXPECT_LE((K * Lambda * K - K).norm(), 1e-9 * K.norm());
      } catch (const std::domain_error&) {
        EXPECT_FALSE(moves_freely);
        continue;
      }
      ++judged;
    }
  });
  EXPECT_GE(judged, 20);
  Model<double> one;
  one.addJoint(0, Revolute<double>(Axis<double>::X()), SE3<double>::Identity(), "joint");
  one.addJointFrame(1);
  one.appendBodyToJoint(1, Inertia<double>(1, V3(0, 0, 1), Matrix3<double>::Identity()));
  Data<double> d(one, Dense::Derivatives);
  EXPECT_THROW(computeOperationalSpaceInertia(one, d, Vec(Vec::Zero(1)), 1, ReferenceFrame::LOCAL),
               std::domain_error);
}

}  // namespace
