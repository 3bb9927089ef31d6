// Quaternions of any norm in the functions of one pose or rotation, and in batches of poses.

#include <gtest/gtest.h>

#include <liecheck/batch/poses.hpp>
#include <liecheck/multibody/configuration.hpp>

#include "off_unit.hpp"
#include "../refusal.hpp"
#include "scalar_test.hpp"

namespace {

using namespace liecheck;
using test::everyNorm, test::expectNear, test::refusal;

SCALAR_SUITE(OffUnitPose, float, double);

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

SCALAR_TEST(OffUnitPose, ANearDifferenceKeepsItsDigitsWhateverTheNorms) {
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

SCALAR_TEST(OffUnitPose, FunctionsOfOnePoseTakeTheNormalisedQuaternion) {
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
    const Vector3<S> p = q.template head<3>();
    expectNear<S>(SO3<S>(Vector4<S>(off.template tail<4>())).actInv(p),
                  SO3<S>(Vector4<S>(q.template tail<4>())).actInv(p), 4 * eps<S>());
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
  const SO3<S> none{Vector4<S>{Vector4<S>::Zero()}};
  EXPECT_EQ(refusal([&] { none.act(Vector3<S>(S(1), S(2), S(3))); }), text);
  EXPECT_EQ(refusal([&] { none.matrix(); }), text);
  EXPECT_EQ(refusal([&] { quaternion::log3<S>(none); }), text);
}

SCALAR_TEST(OffUnitPose, ABatchActsAsTheNormalisedQuaternions) {
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

}  // namespace
