// multibody/unit_vector.hpp: quaternions and (cos, sin) of any norm, in every function that reads q. A vector
// u represents u/|u|, so each result must be that of the normalised q. Zero is refused.

#include <gtest/gtest.h>

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>

#include "off_unit.hpp"
#include "random_tree.hpp"
#include "../refusal.hpp"
#include "scalar_test.hpp"

namespace {

using namespace liecheck;
using test::everyNorm, test::expectNear, test::has, test::refusal;

/// Every joint type, with bodies.
template <class S>
struct EveryJoint : Model<S> {
  test::Random random{7};
  EveryJoint() : Model<S>(test::randomModel(1, test::joint_kinds).cast<S>()) {}
  VectorX<S> tangent(double size) { return random.tangent(this->nv, size).template cast<S>(); }
  VectorX<S> anywhere() { return integrate(*this, neutral(*this), tangent(1.5)); }
  /// q with each unit vector times `norm`, or only those of `joint`.
  VectorX<S> stretched(VectorX<S> q, S norm, int joint = -1) const {
    for (std::size_t i = 1; i < this->joints.size(); ++i) {
      if (joint >= 0 && joint != int(i)) continue;
      const int unit = std::visit([](const auto& j) { return int(j.unit_begin); }, this->joints[i]);
      for (int k = unit; k < this->nqs[i]; ++k) q[this->idx_qs[i] + k] *= norm;
    }
    return q;
  }
};
SCALAR_SUITE(OffUnit, float, double);

SCALAR_TEST(OffUnit, CosineAndSineOfTwoAndZeroAreTheAngleZero) {
  const typename Continuous<S>::Configuration u(S(2), S(0));
  const Continuous<S> wheel{Axis<S>::Z()};
  const SE3<S> I = SE3<S>::Identity();
  EXPECT_EQ(wheel.transform(I, u).rotation(), I.rotation());
  EXPECT_EQ(wheel.integrate(u, Vector1<S>(S(0))), (typename Continuous<S>::Configuration(S(1), S(0))));
  const Vector4<S> q(S(3), S(4), S(2), S(0));
  EXPECT_EQ(Planar<S>::transform(I, q).rotation(), I.rotation());
  EXPECT_EQ(Planar<S>::transform(I, q).translation(), Vector3<S>(S(3), S(4), S(0)));
  EXPECT_EQ(Planar<S>::integrate(q, Vector3<S>(S(1), S(0), S(0))), Vector4<S>(S(4), S(4), S(1), S(0)));
}

SCALAR_TEST(OffUnit, IntegrateAndItsDerivativesAreThoseOfTheNormalisedConfiguration) {
  EveryJoint<S> m;
  for (const S norm : everyNorm<S>()) {
    SCOPED_TRACE(norm);
    const VectorX<S> q = m.anywhere(), delta = m.tangent(1), off = m.stretched(q, norm);
    const VectorX<S> next = integrate(m, off, delta);
    EXPECT_TRUE(isNormalized(m, next));
    expectNear<S>(next, integrate(m, q, delta), 8 * eps<S>());
    for (const auto argument : {ArgumentPosition::ARG0, ArgumentPosition::ARG1})
      expectNear<S>(dIntegrate(m, off, delta, argument), dIntegrate(m, q, delta, argument), 8 * eps<S>());
    expectNear<S>(integrateCoeffWiseJacobian(m, off), integrateCoeffWiseJacobian(m, q), 8 * eps<S>());
    EXPECT_TRUE(isNormalized(m, normalized(m, off)));
    expectNear<S>(normalized(m, off), q, 4 * eps<S>());
  }
}

SCALAR_TEST(OffUnit, DifferenceDistanceAndInterpolationAreThoseOfTheNormalisedConfigurations) {
  EveryJoint<S> m;
  for (const S norm : everyNorm<S>())
    for (const S other : {norm, S(1), S(2)}) {
      SCOPED_TRACE(testing::Message() << norm << ' ' << other);
      const VectorX<S> q0 = m.anywhere(), q1 = integrate(m, q0, m.tangent(1));
      const VectorX<S> a = m.stretched(q0, norm), b = m.stretched(q1, other);
      expectNear<S>(difference(m, a, b), difference(m, q0, q1), 16 * eps<S>());
      expectNear<S>(squaredDistance(m, a, b), squaredDistance(m, q0, q1), 16 * eps<S>());
      EXPECT_NEAR(distance(m, a, b), distance(m, q0, q1), 64 * eps<S>());
      expectNear<S>(interpolate(m, a, b, S(0.3)), interpolate(m, q0, q1, S(0.3)), 32 * eps<S>());
      for (const auto argument : {ArgumentPosition::ARG0, ArgumentPosition::ARG1})
        expectNear<S>(dDifference(m, a, b, argument), dDifference(m, q0, q1, argument), 32 * eps<S>());
      EXPECT_TRUE(isSameConfiguration(m, a, q0));
      EXPECT_FALSE(isSameConfiguration(m, a, b));
    }
}

SCALAR_TEST(OffUnit, EveryAlgorithmTakesTheNormalisedConfiguration) {
  EveryJoint<S> m;
  const VectorX<S> q = m.anywhere(), v = m.tangent(2), a = m.tangent(3), tau = m.tangent(5);
  Data<S> d(m, Dense::Mass), e(m, Dense::Mass);
  for (const S norm : everyNorm<S>()) {
    SCOPED_TRACE(norm);
    const VectorX<S> off = m.stretched(q, norm);
    const auto same = [&](auto call) {
      const auto right = call(e, q), found = call(d, off);
      EXPECT_TRUE(found.allFinite());
      EXPECT_LE((found - right).norm(), S(m.nv) * 64 * eps<S>() * right.norm());
    };
    using Any = MatrixX<S>;
    same([&](Data<S>& x, const VectorX<S>& at) { return Any(rnea(m, x, at, v, a)); });
    same([&](Data<S>& x, const VectorX<S>& at) { return Any(nonLinearEffects(m, x, at, v)); });
    same([&](Data<S>& x, const VectorX<S>& at) { return Any(computeGeneralizedGravity(m, x, at)); });
    same([&](Data<S>& x, const VectorX<S>& at) { return Any(crba(m, x, at)); });
    same([&](Data<S>& x, const VectorX<S>& at) { return Any(computeJointJacobians(m, x, at)); });
    same([&](Data<S>& x, const VectorX<S>& at) { return Any(computeCentroidalMap(m, x, at)); });
    same([&](Data<S>& x, const VectorX<S>& at) { return Any(centerOfMass(m, x, at)); });
    same([&](Data<S>& x, const VectorX<S>& at) {
      forwardKinematics(m, x, at, v, a);
      Any all(6, 4 * m.njoints);
      for (int i = 0; i < m.njoints; ++i)
        all.middleCols(4 * i, 4) << Matrix3<S>(x.oMi[std::size_t(i)].rotation()),
            x.oMi[std::size_t(i)].translation(), Matrix3<S>::Zero(), Vector3<S>::Zero();
      return all;
    });
    same(
        [&](Data<S>& x, const VectorX<S>& at) { return Any(Vector1<S>(computeKineticEnergy(m, x, at, v))); });
    // The condition number of M, about 1e4 here, multiplies the error of aba.
    const VectorX<S> right = aba(m, e, q, v, tau), found = aba(m, d, off, v, tau);
    EXPECT_LE((found - right).norm(), S(1e4) * 64 * eps<S>() * right.norm());
  }
}

SCALAR_TEST(OffUnit, AZeroVectorIsRefusedByEveryFunction) {
  EveryJoint<S> m;
  const VectorX<S> q = m.anywhere(), v = m.tangent(1);
  for (int joint = 1; joint < m.njoints; ++joint) {
    if (m.nqs[std::size_t(joint)] == m.nvs[std::size_t(joint)]) continue;
    const VectorX<S> zero = m.stretched(q, S(0), joint);
    const std::string name =
        "joint '" + m.names[std::size_t(joint)] + "' (joint " + std::to_string(joint) + ")";
    const auto refused = [&](auto call, const std::string& text) { EXPECT_TRUE(has(refusal(call), text)); };
    refused([&] { integrate(m, zero, v); }, name + ", q[");
    refused([&] { difference(m, zero, q); }, name + ", q0[");
    refused([&] { difference(m, q, zero); }, name + ", q1[");
    refused([&] { interpolate(m, q, zero, S(0.5)); }, name + ", q1[");
    refused([&] { squaredDistance(m, q, zero); }, name + ", q1[");
    refused([&] { distance(m, zero, q); }, name + ", q0[");
    refused([&] { isSameConfiguration(m, zero, q); }, name + ", q0[");
    refused([&] { isSameConfiguration(m, q, zero); }, name + ", q1[");
    refused([&] { dIntegrate(m, zero, v, ArgumentPosition::ARG0); }, name + ", q[");
    refused([&] { dDifference(m, q, zero, ArgumentPosition::ARG0); }, name + ", q1[");
    refused([&] { integrateCoeffWiseJacobian(m, zero); }, name + ", q[");
    refused([&] { normalized(m, zero); }, name + ", q[");
    Data<S> d(m, Dense::Mass);
    const std::string text = " is not a";  // "a zero quaternion is not a rotation", "... is not an angle"
    refused([&] { forwardKinematics(m, d, zero); }, text);
    refused([&] { forwardKinematics(m, d, zero, v); }, text);
    refused([&] { rnea(m, d, zero, v, v); }, text);
    refused([&] { aba(m, d, zero, v, v); }, text);
    refused([&] { crba(m, d, zero); }, text);
    refused([&] { computeJointJacobians(m, d, zero); }, text);
  }
}

}  // namespace
