// multibody/unit_vector.hpp: quaternions and (cos, sin) of any norm, in every function that reads q. A vector
// u represents u/|u|, so each result must be that of the normalised q. Zero is refused.

#include <gtest/gtest.h>

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <liecheck/batch/poses.hpp>

#include "random_tree.hpp"
#include "refusal.hpp"
#include "scalar_test.hpp"

namespace {

using namespace liecheck;
using test::has, test::refusal;

/// Norms in the order of their distance from 1. |u|^2 = 3 makes a first-order normalisation zero. Squares of
/// the last two underflow and overflow.
template <class S>
std::vector<S> everyNorm() {
  return {S(1) + S(1e-6),
          S(1) - S(1e-6),
          S(1.001),
          S(0.5),
          S(2),
          std::sqrt(S(3)),
          S(1e-3),
          S(1e-6),
          S(1e3),
          S(1e9),
          std::numeric_limits<S>::min() * 1024,
          std::numeric_limits<S>::max() / 4};
}
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
template <class S, class A, class B>
void expectNear(const A& a, const B& b, S bound) {
  EXPECT_TRUE(a.allFinite());
  EXPECT_LE((a - b).norm(), bound * (S(1) + b.norm()));
}
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

/// The small angle between two vectors of any norms. Its sine is computed in 113 bits, which hold the products
/// of the stored numbers exactly, so the angle has the digits of a long double.
template <class V>
long double smallAngle(const V& a, const V& b) {
  using Real = __float128;
  Real square = 0, aa = 0, bb = 0;
  for (int i = 0; i < a.size(); ++i) {
    aa += Real(a[i]) * Real(a[i]), bb += Real(b[i]) * Real(b[i]);
    for (int j = 0; j < i; ++j) {
      const Real x = Real(a[i]) * Real(b[j]) - Real(a[j]) * Real(b[i]);
      square += x * x;
    }
  }
  return std::asin(std::sqrt(static_cast<long double>(square / aa / bb)));
}

SCALAR_TEST(OffUnit, ANearDifferenceKeepsItsDigitsWhateverTheNorms) {
  const S angle = std::sqrt(eps<S>());
  const Vector4<S> Q0 = quaternion::exp3<S>(Vector3<S>(S(0.3), S(-0.7), S(1.1))).to_vector(),
                   Q1 = Spherical<S>::integrate(Q0, Vector3<S>(angle, 2 * angle, -angle));
  const typename Continuous<S>::Configuration u0(S(0.6), S(0.8)),
      u1 = Continuous<S>::integrate(u0, Vector1<S>(angle));
  for (const S norm : everyNorm<S>())
    for (const S other : {norm, S(1), 3 * norm / 4}) {
      const Vector4<S> A = norm * Q0, B = other * Q1;
      const long double turn = 2 * smallAngle(A, B);
      EXPECT_LE(std::abs(Spherical<S>::difference(A, B).norm() - turn), 4 * eps<S>() * turn) << norm;
      const typename Continuous<S>::Configuration a = norm * u0, b = other * u1;
      const long double exact = smallAngle(a, b);
      EXPECT_LE(std::abs(Continuous<S>::difference(a, b)[0] - exact), 4 * eps<S>() * exact) << norm;
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

SCALAR_TEST(OffUnit, FunctionsOfOnePoseTakeTheNormalisedQuaternion) {
  Vector7<S> q;
  q << S(0.3), S(-1.2), S(2.5), quaternion::exp3<S>(Vector3<S>(S(1), S(-2), S(0.5))).to_vector();
  const Vector6<S> delta = (Vector6<S>() << S(0.7), S(-0.4), S(1.1), S(0.9), S(-1.3), S(0.6)).finished();
  const Vector7<S> right = integrateSE3<S>(q, delta);
  Vector6<S> half_turn = delta;
  half_turn.template tail<3>() << S(0), pi<S>(), S(0);
  const Vector7<S> opposite = integrateSE3<S>(q, half_turn);
  for (const S norm : everyNorm<S>()) {
    Vector7<S> off = q;
    off.template tail<4>() *= norm;
    expectNear<S>(integrateSE3<S>(off, delta), right, 8 * eps<S>());
    expectNear<S>(integrateSE3<S, Precision::fast>(off, delta), right, 16 * eps<S>());
    expectNear<S>(integrateSE3<S, Precision::tight>(off, delta), right, 8 * eps<S>());
    expectNear<S>(differenceSE3<S>(off, right), delta, 16 * eps<S>());
    expectNear<S>(differenceSE3<S, Precision::tight>(off, right), delta, 16 * eps<S>());
    // At pi the translation must belong to the sign of the axis that was chosen.
    Vector7<S> off_opposite = opposite;
    off_opposite.template tail<4>() *= norm;
    expectNear<S>(integrateSE3<S>(q, differenceSE3<S>(off, off_opposite)).template head<3>().eval(),
                  opposite.template head<3>().eval(), 32 * eps<S>());
    batch::Rows<S, 7> many(7, 16), ends(7, 16);
    batch::Rows<S, 6> deltas(6, 16);
    for (int i = 0; i < 16; ++i)
      many.col(i) = i % 3 == 0 ? off : q, deltas.col(i) = delta, ends.col(i) = right;
    const auto there = batch::integrate<S>(many, deltas);
    const auto back = batch::difference<S>(many, ends);
    for (int i = 0; i < 16; ++i) {
      expectNear<S>(Vector7<S>(there.col(i)), right, 8 * eps<S>());
      expectNear<S>(Vector6<S>(back.col(i)), delta, 16 * eps<S>());
    }
  }
  const Vector7<S> zero = Vector7<S>::Zero();
  const std::string text = "a zero quaternion is not a rotation";
  EXPECT_EQ(refusal([&] { integrateSE3<S>(zero, delta); }), text);
  EXPECT_EQ(refusal([&] { differenceSE3<S>(zero, q); }), text);
  EXPECT_EQ(refusal([&] { differenceSE3<S>(q, zero); }), text);
  EXPECT_EQ(refusal([&] { dDifferenceSE3<S>(zero, q, ArgumentPosition::ARG0); }), text);
}

/// R(Q) p of the stored numbers, in 113 bits.
template <class S>
Vector3<long double> exactlyRotated(const Vector4<S>& stored, const Vector3<S>& p) {
  using Real = __float128;
  Real q[4], t[3], square = 0;
  for (int i = 0; i < 4; ++i) q[i] = Real(stored[i]), square += q[i] * q[i];
  const auto cross = [&q](const auto& a, int i) {
    return q[(i + 1) % 3] * a[(i + 2) % 3] - q[(i + 2) % 3] * a[(i + 1) % 3];
  };
  const Real x[3] = {Real(p[0]), Real(p[1]), Real(p[2])};
  for (int i = 0; i < 3; ++i) t[i] = cross(x, i);
  Vector3<long double> result;
  for (int i = 0; i < 3; ++i)
    result[i] = static_cast<long double>(x[i] + 2 * (q[3] * t[i] + cross(t, i)) / square);
  return result;
}

SCALAR_TEST(OffUnit, RotationsAndLogarithmsOfAQuaternionKeepTheirBounds) {
  test::Random random(7);
  for (int n = 0; n < 200; ++n) {
    const Vector3<S> phi = random.tangent(3, n % 2 ? 1 : 1e-3).template cast<S>(),
                     p = random.tangent(3, 1).template cast<S>();
    const Vector4<S> unit = quaternion::exp3<S>(phi).to_vector();
    for (const S norm : everyNorm<S>()) {
      const Vector4<S> Q = norm * unit;
      const SO3<S> rotation(Q);
      const auto error = [](const Vector3<S>& a, const Vector3<long double>& b) {
        return (a.template cast<long double>() - b).norm();
      };
      const long double length = p.norm() * eps<S>();
      EXPECT_LE(error(rotation.act(p), exactlyRotated<S>(Q, p)), length) << norm;
      const Vector4<S> inverse(-Q[0], -Q[1], -Q[2], Q[3]);
      EXPECT_LE(error(rotation.actInv(p), exactlyRotated<S>(inverse, p)), length) << norm;
      const Matrix3<S> R = rotation.matrix();
      for (int i = 0; i < 3; ++i) {
        const Vector3<long double> column = exactlyRotated<S>(Q, Vector3<S>::Unit(i));
        EXPECT_LE((R.col(i).template cast<long double>() - column).cwiseAbs().maxCoeff(), 4 * eps<S>())
            << norm;
      }
      const long double turn = 2 * smallAngle(Q, Vector4<S>(Vector4<S>::Unit(3)));
      EXPECT_LE(std::abs(quaternion::log3<S>(rotation).norm() - turn), 2 * eps<S>() * turn) << norm;
    }
  }
  const SO3<S> zero{Vector4<S>{Vector4<S>::Zero()}};
  const std::string text = "a zero quaternion is not a rotation";
  EXPECT_EQ(refusal([&] { zero.act(Vector3<S>(S(1), S(2), S(3))); }), text);
  EXPECT_EQ(refusal([&] { zero.matrix(); }), text);
  EXPECT_EQ(refusal([&] { quaternion::log3<S>(zero); }), text);
}

SCALAR_TEST(OffUnit, ABatchActsAsTheNormalisedQuaternions) {
  const Vector4<S> unit = quaternion::exp3<S>(Vector3<S>(S(1), S(-2), S(0.5))).to_vector();
  batch::Rows<S, 7> q(7, 16);
  batch::Rows<S, 3> x(3, 16);
  for (const S norm : everyNorm<S>()) {
    for (int i = 0; i < 16; ++i)
      q.col(i) << S(0), S(0), S(0), (i % 3 == 0 ? norm : S(1)) * unit.array(), x.col(i) << S(1), S(2), S(-3);
    const auto y = batch::act<S>(q, x);
    for (int i = 0; i < 16; ++i)
      expectNear<S>(Vector3<S>(y.col(i)), SO3<S>(unit).act(Vector3<S>(S(1), S(2), S(-3))), 4 * eps<S>());
  }
}

// A run that diverges passes NaN through these functions, and its integrator reports it.
SCALAR_TEST(OffUnit, NumbersThatAreNotFiniteGiveNaNInFunctionsOfOneJoint) {
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    Vector7<S> q = Vector7<S>::Unit(6);
    q[4] = bad;
    EXPECT_TRUE(integrateSE3<S>(q, Vector6<S>::Zero()).template tail<4>().hasNaN());
    EXPECT_TRUE(differenceSE3<S>(q, q).hasNaN());
    const typename Continuous<S>::Configuration u(bad, S(0));
    EXPECT_TRUE(Continuous<S>::integrate(u, Vector1<S>(S(1))).hasNaN());
    EXPECT_TRUE(Continuous<S>::difference(u, u).hasNaN());
    EXPECT_TRUE(FreeFlyer<S>::transform(SE3<S>::Identity(), q).rotation().hasNaN());
  }
}

}  // namespace
