// spatial/checked_rotation.hpp.

#include <gtest/gtest.h>

#include <liecheck/spatial/checked_rotation.hpp>

#include "../refusal.hpp"
#include "scalar_test.hpp"

namespace liecheck {
namespace {

using test::has, test::refusal;

SCALAR_SUITE(CheckedRotation, float, double);

SCALAR_TEST(CheckedRotation, AcceptsQuaternionsOfUnitNormUpToEightEps) {
  const Vector4<S> Q(S(0.5), S(-0.5), S(0.5), S(0.5));
  EXPECT_EQ(checkedQuaternion<S>(Q).to_vector(), Q);
  EXPECT_EQ(refusal([&] { checkedQuaternion<S>(Vector4<S>(Q * (S(1) + S(3) * eps<S>()))); }), "");
  EXPECT_NE(refusal([&] { checkedQuaternion<S>(Vector4<S>(Q * (S(1) + S(6) * eps<S>()))); }), "");
  EXPECT_TRUE(has(refusal([&] { checkedQuaternion<S>(Vector4<S>(Q * S(0.999))); }), "normalize"));
  EXPECT_TRUE(has(refusal([&] { checkedQuaternion<S>(Vector4<S>(Vector4<S>::Zero())); }), "zero quaternion"));
}

SCALAR_TEST(CheckedRotation, AcceptsMatricesOrthogonalUpToEightEpsAndRefusesReflections) {
  Matrix3<S> R = Matrix3<S>::Identity();
  EXPECT_EQ(checkedRotation<S>(R), R);
  R(0, 1) = S(5) * eps<S>();  // |R^T R - I| = 5 sqrt(2) eps
  EXPECT_EQ(refusal([&] { checkedRotation<S>(R); }), "");
  R(0, 1) = S(6) * eps<S>();
  EXPECT_TRUE(has(refusal([&] { checkedRotation<S>(R); }), "8 eps"));
  R = -Matrix3<S>::Identity();
  EXPECT_TRUE(has(refusal([&] { checkedRotation<S>(R); }), "reflection"));
}

SCALAR_TEST(CheckedRotation, RefusesNumbersThatAreNotFiniteOrOverflow) {
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    EXPECT_TRUE(has(refusal([&] { checkedQuaternion<S>(Vector4<S>(S(0), bad, S(0), S(1))); }), "not finite"));
    Matrix3<S> R = Matrix3<S>::Identity();
    R(2, 1) = bad;
    EXPECT_TRUE(has(refusal([&] { checkedRotation<S>(R); }), "not finite"));
  }
  const S huge = std::numeric_limits<S>::max();
  EXPECT_NE(refusal([&] { checkedQuaternion<S>(Vector4<S>(huge, S(0), S(0), S(1))); }), "");
  EXPECT_NE(refusal([&] { checkedRotation<S>(Matrix3<S>(huge * Matrix3<S>::Identity())); }), "");
}

}  // namespace
}  // namespace liecheck
