// spatial/representations, transforms, extended_pose, preintegration and multibody/means: against their definitions.

#include <gtest/gtest.h>

#include <liecheck/multibody/means.hpp>
#include <liecheck/spatial/extended_pose.hpp>
#include <liecheck/spatial/preintegration.hpp>
#include <liecheck/spatial/representations.hpp>
#include <liecheck/spatial/transforms.hpp>

#include "random_tree.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;
using M3 = Matrix3<double>;
using V4 = Vector4<double>;
using V6 = Vector6<double>;
using V7 = Vector7<double>;
using V9 = Vector9<double>;

/// Results and their definitions have up to about thirty operations on numbers of size 1, each right to half an eps.
constexpr double close = 64 * 0x1p-52;

SO3<double> turned(const V3& phi) {
  return SO3<double>(quaternion::exp3<double>(phi).to_vector());
}
V3 logOf(const SO3<double>& Q) {
  return log3<double>(Q.matrix());
}

TEST(Representations, AreTangentsOfPartsOfTheAngleAndReturn) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const V3 phi = random.vector(1.7);
    const double theta = phi.norm();
    const V3 n = phi / theta;
    const SO3<double> Q = turned(phi);
    const auto pair = toAxisAngle<double>(Q);
    EXPECT_LE((pair.angle * pair.axis - phi).norm(), close);
    EXPECT_LE((toGibbs<double>(Q) - std::tan(theta / 2) * n).norm(), close * (1 + std::tan(theta / 2)));
    EXPECT_LE((toModifiedRodrigues<double>(Q) - std::tan(theta / 4) * n).norm(), close);
    for (const SO3<double>& back :
         {fromAxisAngle<double>(pair), fromGibbs<double>(toGibbs<double>(Q)),
          fromModifiedRodrigues<double>(toModifiedRodrigues<double>(Q)), toQuaternion<double>(Q.matrix())})
      EXPECT_LE((logOf(back) - phi).norm(), 8 * close);
    // The shadow of a set of parameters is the same rotation.
    const V3 s = toModifiedRodrigues<double>(Q);
    EXPECT_LE((fromModifiedRodrigues<double>(V3(-s / s.squaredNorm())).matrix() - Q.matrix()).norm(),
              8 * close);
  }
}

TEST(Representations, TheNearestRotationIsThePolarFactorAndGramSchmidtTriangular) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    M3 E;
    for (double& x : E.reshaped()) x = random.uniform(-0.05, 0.05);
    const M3 A = turned(random.vector(2)).matrix() * (M3::Identity() + E);
    const M3 H = nearestRotation<double>(A).transpose() * A, U = orthonormalized<double>(A).transpose() * A;
    EXPECT_LE((H - H.transpose()).norm(), close);
    EXPECT_LE(std::abs(U(1, 0)) + std::abs(U(2, 0)) + std::abs(U(2, 1)), close);
    EXPECT_GT(U.diagonal().minCoeff(), 0);
  }
  EXPECT_THROW(nearestRotation<double>(2 * M3::Identity()), std::invalid_argument);
  EXPECT_THROW(toGibbs<double>(SO3<double>(V4(1, 0, 0, 0))), std::invalid_argument);
  EXPECT_THROW(toModifiedRodrigues<double>(SO3<double>(V4(0, 0, 0, 0))), std::invalid_argument);
}

TEST(Transforms, ACovarianceIsTransportedByTheAdjointAndAScrewReturnsItsTwist) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const SE3<double> X = random.pose();
    const Matrix6<double> L = Matrix6<double>::Random(), Sigma = L * L.transpose(), Ad = X.toActionMatrix(),
                          exact = Ad * Sigma * Ad.transpose();
    const Matrix6<double> moved = transported<double>(X, Sigma);
    EXPECT_LE((moved - exact).norm(), close * exact.norm());
    EXPECT_EQ(moved, moved.transpose());
    const Motion<double> V(random.vector(2), random.vector(2));
    const Screw<double> s = screwOf<double>(V);
    const double speed = V.angular().norm();
    EXPECT_LE((speed * (s.pitch * s.axis - s.axis.cross(s.point)) - V.linear()).norm(), close * 4);
    EXPECT_LE(std::abs(s.point.dot(s.axis)), close * 4 / speed);
  }
  EXPECT_THROW(screwOf<double>(Motion<double>(V3::UnitX(), V3::Zero())), std::invalid_argument);
}

V7 poseNear(Random& random, double size) {
  const V3 phi = random.vector(size);
  V7 q;
  q << random.vector(1), turned(phi).to_vector();
  return q;
}

TEST(Means, BalanceTheLogarithmsAndTheChordalMeanIsStationary) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const std::array<V7, 3> all{poseNear(random, 0.5), poseNear(random, 0.5), poseNear(random, 0.5)};
    const V3 w(random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2));
    const V7 mean = meanPose<double, 3>(all, w);
    V6 sum = V6::Zero();
    std::array<SO3<double>, 3> rotations;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += w[int(k)] * differenceSE3<double>(mean, all[k]);
      rotations[k] = SO3<double>(V4(all[k].tail<4>()));
    }
    EXPECT_LE(sum.norm(), close);
    const V4 q = chordalMean<double, 3>(rotations, w).to_vector();
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const V4 x = rotations[k].to_vector();
      M += w[int(k)] * x * x.transpose();
    }
    const double largest = q.dot(M * q);
    EXPECT_LE((M * q - largest * q).norm(), close);
    EXPECT_GE(largest, 0.5 * M.trace());  // more than half of the trace is the largest eigenvalue's
    EXPECT_THROW((chordalMean<double, 3>(rotations, V3(1, -1, 1))), std::invalid_argument);
    EXPECT_THROW((meanPose<double, 3>(all, V3(0, 0, 0))), std::invalid_argument);
  }
}

TEST(Means, InterpolationIsInProportion) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const V7 q0 = poseNear(random, 1), q1 = poseNear(random, 1);
    const double t = random.uniform(0, 1);
    const V6 whole = differenceSE3<double>(q0, q1),
             part = differenceSE3<double>(q0, interpolateSE3<double>(q0, q1, t));
    EXPECT_LE((part - t * whole).norm(), close);
    const V3 a = random.vector(1).normalized(), b = random.vector(1).normalized();
    const V3 x = slerp<double>(a, b, t);
    const double theta = angleBetween<double>(a, b);
    EXPECT_LE(std::abs(theta - std::atan2(a.cross(b).norm(), a.dot(b))), close);
    EXPECT_LE(std::abs(angleBetween<double>(a, x) - t * theta), close);
    EXPECT_LE(std::abs(angleBetween<double>(x, b) - (1 - t) * theta), close);
  }
}

/// X as the matrix [[R, v, p], [0, 1, 0], [0, 0, 1]].
using M5 = Eigen::Matrix<double, 5, 5>;
M5 matrixOf(const ExtendedPose<double>& X) {
  M5 m = M5::Identity();
  m.topLeftCorner<3, 3>() = X.R, m.block<3, 1>(0, 3) = X.v, m.block<3, 1>(0, 4) = X.p;
  return m;
}
/// xi as the matrix whose exponential is that of exp9, by its power series.
M5 expOf(const V9& xi) {
  M5 a = M5::Zero();
  a.topLeftCorner<3, 3>() = skew<double>(xi.tail<3>());
  a.block<3, 1>(0, 3) = xi.segment<3>(3), a.block<3, 1>(0, 4) = xi.head<3>();
  M5 sum = M5::Identity(), term = sum;
  for (int k = 1; k < 60; ++k) term = (term * a / k).eval(), sum += term;
  return sum;
}

TEST(ExtendedPoses, FollowFromTheExponentialOfAMatrix) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    V9 xi, d;
    xi << random.vector(1), random.vector(1), random.vector(1);
    d << random.vector(1), random.vector(1), random.vector(1);
    const ExtendedPose<double> X = exp9<double>(xi);
    const M5 exact = expOf(xi);
    EXPECT_LE((matrixOf(X) - exact).norm(), 4 * close);
    EXPECT_LE((log9<double>(X) - xi).norm(), 4 * close);
    // exp(Ad d) = X exp(d) X^-1, and exp(xi + h d) = exp(h J_l d) exp(xi) = exp(xi) exp(h J_r d) to O(h^2).
    EXPECT_LE((expOf(adjoint<double>(X) * d) * exact - exact * expOf(d)).norm(), 64 * close);
    constexpr double h = 1e-5;
    const M5 slope = (expOf(xi + h * d) - expOf(xi - h * d)) / (2 * h);
    const auto generator = [&](const V9& x) { return M5((expOf(1e-5 * x) - expOf(-1e-5 * x)) / 2e-5); };
    EXPECT_LE((generator(leftJacobian<double>(xi) * d) * exact - slope).norm(), 1e-8);
    EXPECT_LE((exact * generator(rightJacobian<double>(xi) * d) - slope).norm(), 1e-8);
  }
}

using Measured = Eigen::Matrix<double, 9, 1>;

TEST(Preintegration, OfConstantMeasurementsIsTheLimitOfSmallSteps) {
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    Measured gyro, accelerometer;
    gyro << random.vector(2), random.vector(2), random.vector(2);
    accelerometer << random.vector(3), random.vector(3), random.vector(3);
    const double dt = 0.2;
    // Forster's sums with n steps for each measurement err by O(1/n); two of them give O(1/n^2).
    const auto fine = [&](int n) {
      M3 R = M3::Identity();
      V3 p = V3::Zero(), v = p;
      const double h = dt / n;
      for (int k = 0; k < 3 * n; ++k) {
        const V3 w = gyro.segment<3>(3 * (k / n)), a = accelerometer.segment<3>(3 * (k / n));
        p += v * h + R * a * (h * h / 2), v += R * a * h, R = R * exp3<double>(V3(w * h));
      }
      return (Vec(6) << p, v).finished();
    };
    const auto exact = preintegratedBrossard<double, 3>(gyro, accelerometer, dt);
    const Vec limit = 2 * fine(4000) - fine(2000);
    EXPECT_LE((exact.delta.p - limit.head(3)).norm(), 1e-7);
    EXPECT_LE((exact.delta.v - limit.tail(3)).norm(), 1e-7);
    const Vec once = fine(1);
    const auto forster = preintegratedForster<double, 3>(gyro, accelerometer, dt);
    EXPECT_LE((forster.delta.p - once.head(3)).norm() + (forster.delta.v - once.tail(3)).norm(), 4 * close);
  }
}

TEST(Preintegration, OfFastTurnsAgreesWithHalfMeasurements) {
  Random random(9);
  for (const double turn : {0.5, 3.1, 3.2, 20., 300.}) {
    const V3 w = turn * random.vector(1).normalized(), a = random.vector(3), o = V3::Zero();
    using Two = Eigen::Matrix<double, 6, 1>;
    const auto whole = preintegratedBrossard<double, 1>(w, a, 1.0);
    const auto halves =
        preintegratedBrossard<double, 2>((Two() << w, w).finished(), (Two() << a, a).finished(), 0.5);
    const double allowed = close * (1 + turn);  // the rounding of the angle turns the result
    EXPECT_LE((whole.delta.p - halves.delta.p).norm() + (whole.delta.v - halves.delta.v).norm(), allowed);
    EXPECT_LE((whole.p_g - halves.p_g).norm() + (whole.v_g - halves.v_g).norm(), allowed);
    EXPECT_THROW((preintegratedBrossard<double, 1>(V3(1e200 * w), o, 1.0)), std::invalid_argument);
  }
}

TEST(Preintegration, DerivativesByTheBiasesAreThoseOfDifferences) {
  Random random(8);
  for (int i = 0; i < 20; ++i) {
    Measured gyro, accelerometer;
    gyro << random.vector(2), random.vector(2), random.vector(2);
    accelerometer << random.vector(3), random.vector(3), random.vector(3);
    const double dt = 0.2, h = 1e-5;
    for (const bool exact : {false, true}) {
      const auto at = [&](const V3& b_g, const V3& b_a) {
        const Measured w = gyro - b_g.replicate<3, 1>(), a = accelerometer - b_a.replicate<3, 1>();
        return exact ? preintegratedBrossard<double, 3>(w, a, dt) : preintegratedForster<double, 3>(w, a, dt);
      };
      const auto x = at(V3::Zero(), V3::Zero());
      for (int j = 0; j < 3; ++j) {
        const V3 e = h * V3::Unit(j), o = V3::Zero();
        const auto gp = at(e, o).delta, gm = at(-e, o).delta, ap = at(o, e).delta, am = at(o, -e).delta;
        const M3 turn = x.delta.R.transpose() * (gp.R - gm.R) / (2 * h);
        EXPECT_LE((x.R_g.col(j) - V3(turn(2, 1), turn(0, 2), turn(1, 0))).norm(), 1e-9);
        EXPECT_LE((x.p_g.col(j) - (gp.p - gm.p) / (2 * h)).norm(), 1e-9);
        EXPECT_LE((x.v_g.col(j) - (gp.v - gm.v) / (2 * h)).norm(), 1e-9);
        EXPECT_LE((x.p_a.col(j) - (ap.p - am.p) / (2 * h)).norm(), 1e-9);
        EXPECT_LE((x.v_a.col(j) - (ap.v - am.v) / (2 * h)).norm(), 1e-9);
      }
    }
  }
}

}  // namespace
