// spatial/checked_rotation.hpp.

#include <gtest/gtest.h>

#include <liecheck/spatial/checked_rotation.hpp>

#include "refusal.hpp"

namespace liecheck {
namespace {

using test::refusal;

template <class S>
class CheckedRotation : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CheckedRotation, Scalars);

TYPED_TEST(CheckedRotation, AcceptsQuaternionsOfUnitNormUpToEightEps) {
  using S = TypeParam;
  const Vector4<S> Q(S(0.5), S(-0.5), S(0.5), S(0.5));
  EXPECT_EQ(checkedQuaternion<S>(Q).to_vector(), Q);
  EXPECT_EQ(refusal([&] { checkedQuaternion<S>(Vector4<S>(Q * (S(1) + S(3) * eps<S>()))); }), "");
  EXPECT_NE(refusal([&] { checkedQuaternion<S>(Vector4<S>(Q * (S(1) + S(6) * eps<S>()))); }), "");
  EXPECT_NE(refusal([&] { checkedQuaternion<S>(Vector4<S>(Q * S(0.999))); }).find("normalize"),
            std::string::npos);
  EXPECT_NE(refusal([&] { checkedQuaternion<S>(Vector4<S>(Vector4<S>::Zero())); }).find("zero quaternion"),
            std::string::npos);
}

TYPED_TEST(CheckedRotation, AcceptsMatricesOrthogonalUpToEightEpsAndRefusesReflections) {
  using S = TypeParam;
  Matrix3<S> R = Matrix3<S>::Identity();
  EXPECT_EQ(checkedRotation<S>(R), R);
  R(0, 1) = S(5) * eps<S>();  // |R^T R - I| = 5 sqrt(2) eps
  EXPECT_EQ(refusal([&] { checkedRotation<S>(R); }), "");
  R(0, 1) = S(6) * eps<S>();
  EXPECT_NE(refusal([&] { checkedRotation<S>(R); }).find("8 eps"), std::string::npos);
  R = -Matrix3<S>::Identity();
  EXPECT_NE(refusal([&] { checkedRotation<S>(R); }).find("reflection"), std::string::npos);
}

TYPED_TEST(CheckedRotation, RefusesNumbersThatAreNotFiniteOrOverflow) {
  using S = TypeParam;
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    EXPECT_NE(refusal([&] { checkedQuaternion<S>(Vector4<S>(S(0), bad, S(0), S(1))); }).find("not finite"),
              std::string::npos);
    Matrix3<S> R = Matrix3<S>::Identity();
    R(2, 1) = bad;
    EXPECT_NE(refusal([&] { checkedRotation<S>(R); }).find("not finite"), std::string::npos);
  }
  const S huge = std::numeric_limits<S>::max();
  EXPECT_NE(refusal([&] { checkedQuaternion<S>(Vector4<S>(huge, S(0), S(0), S(1))); }), "");
  EXPECT_NE(refusal([&] { checkedRotation<S>(Matrix3<S>(huge * Matrix3<S>::Identity())); }), "");
}

}  // namespace
}  // namespace liecheck
