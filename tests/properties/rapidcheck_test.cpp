// The generators for RapidCheck: rc::check finds a planted bug and shrinks it to short numbers.

#include <gtest/gtest.h>

#include <generators/rapidcheck.hpp>
#include <optional>

namespace liecheck::properties {
namespace {

/// Runs rc's loop without output; the last failing value is the smallest.
template <class T, class Fails>
std::optional<T> smallest_failure(const rc::Gen<T>& gen, Fails fails) {
  std::optional<T> last;
  rc::detail::TestParams params;
  params.seed = 42, params.maxSuccess = 2000;
  const auto result = rc::detail::checkTestable(
      [&] {
        const T x = *gen;
        if (fails(x)) last = x;
        RC_ASSERT(!fails(x));
      },
      rc::detail::TestMetadata(), params);
  EXPECT_EQ(last.has_value(), result.template is<rc::detail::FailureResult>());
  return last;
}

TEST(RapidCheck, FindsABandOfAnglesAndShrinksToAShortNumberAlongAnAxis) {
  // A planted bug of exp: it is wrong for angles between 2e-9 and 1e-7 rad.
  const auto found = smallest_failure(gen::rotation_vector<double>(),
                                      [](const auto& phi) { return phi.norm() > 2e-9 && phi.norm() < 1e-7; });
  ASSERT_TRUE(found);
  EXPECT_EQ((found->array() == 0).count(), 2);
  char text[32];
  std::snprintf(text, sizeof text, "%.0e", found->norm());
  EXPECT_EQ(found->norm(), std::strtod(text, nullptr)) << found->transpose();
}

TEST(RapidCheck, FindsThetaEqualToPiAndMinusQ) {
  const auto at_pi =
      smallest_failure(gen::unit_quaternion<double>(), [](const auto& Q) { return std::abs(Q.w()) < 1e-9; });
  ASSERT_TRUE(at_pi);
  EXPECT_EQ(at_pi->coeffs(), Eigen::Vector4d(1, 0, 0, 0));
  EXPECT_TRUE(smallest_failure(gen::unit_quaternion<float>(), [](const auto& Q) { return Q.w() < 0; }));
}

TEST(RapidCheck, GivesValidPosesTwistsAndConfigurations) {
  EXPECT_FALSE(smallest_failure(gen::pose<double>(), [](const auto& T) {
    return (T.linear().transpose() * T.linear() - Eigen::Matrix3d::Identity()).norm() > 1e-14;
  }));
  EXPECT_FALSE(smallest_failure(gen::configuration<float>(), [](const auto& q) {
    return std::abs(q.template tail<4>().template cast<double>().squaredNorm() - 1) > 8 * 0x1p-23;
  }));
  EXPECT_FALSE(smallest_failure(gen::twist<double>(AngleRange::to_pi),
                                [](const auto& xi) { return xi.template tail<3>().norm() > 3.1416; }));
  const auto tail = smallest_failure(gen::twist<double>(),
                                     [](const auto& xi) { return xi.template head<3>().norm() > 1e20; });
  ASSERT_TRUE(tail);
  EXPECT_EQ(tail->tail<3>().norm(), 0);
}

}  // namespace
}  // namespace liecheck::properties
