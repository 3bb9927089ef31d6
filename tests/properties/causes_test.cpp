// Findings of libraries with one fault: what follows from it is no finding of its own, choices and refusals of what is no
// rotation are none at all, and each says where in terms of what decides.

#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <numbers>
#include "../own_subject.hpp"
#include "finding_texts.hpp"

namespace liecheck::properties {
namespace {

using V3 = Vec<double, 3>;
using V4 = Vec<double, 4>;
using M3 = Mat<double, 3>;
using std::numbers::pi;

/// The texts of the findings of a library that has the functions of `plant`.
std::vector<std::string> findings(void (*plant)(TypedOperations<double>&)) {
  static int number = 0;
  const std::string name = "one_fault_" + std::to_string(++number);
  [[maybe_unused]] const auto registered = liecheck::properties::registered(name, plant);
  return finding_texts(name);
}

M3 hat(const V3& v) {
  M3 K;
  K << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return K;
}
V4 planar_exp(const V3& delta) {
  const double t = delta[2], c = std::fabs(t) < 1e-6 ? t / 2 : (1 - std::cos(t)) / t,
               s = std::fabs(t) < 1e-6 ? 1 - t * t / 6 : std::sin(t) / t;
  return {s * delta[0] - c * delta[1], c * delta[0] + s * delta[1], std::cos(t), std::sin(t)};
}

TEST(Causes, OfAPoseInThePlaneAreThoseOfItsExponential) {
  const auto all = findings([](TypedOperations<double>& o) {
    o[op::se2_exp] = planar_exp;
    o[op::se2_integrate] = [](const V4& q, const V3& delta) -> V4 {
      const V4 X = planar_exp(delta);
      return {q[0] + q[2] * X[0] - q[3] * X[1], q[1] + q[3] * X[0] + q[2] * X[1], q[2] * X[2] - q[3] * X[3],
              q[3] * X[2] + q[2] * X[3]};
    };
  });
  ASSERT_EQ(all.size(), 1);
  EXPECT_TRUE(says(all[0], "1  se2_exp (translation)") &&
              says(all[0], "so       se2_integrate fails in the same way"))
      << all[0];
  EXPECT_TRUE(says(all[0], "a cutoff at theta about 1e-6: above it the closed form cancels")) << all[0];
}

TEST(Causes, OfAJumpAreThoseOfTheBlockThatJumps) {
  const auto all = findings([](TypedOperations<double>& o) {
    o[op::left_jacobian3] = [](const V3& phi) -> M3 {
      const double t = phi.norm();
      if (t < 1e-4) return M3::Identity() + (0.5 - t * t / 24) * hat(phi) + hat(phi) * hat(phi) / 6;
      return M3::Identity() + (1 - std::cos(t)) / (t * t) * hat(phi) +
             (t - std::sin(t)) / (t * t * t) * hat(phi) * hat(phi);
    };
  });
  ASSERT_EQ(all.size(), 1);
  EXPECT_TRUE(says(all[0], "1  left_jacobian3 (jacobian")) << all[0];
  EXPECT_TRUE(says(all[0], "a cutoff at theta about 1e-4: above it the closed form cancels")) << all[0];
}

TEST(Causes, OfEulerAnglesSayHowFarFromGimbalLock) {
  const auto all = findings([](TypedOperations<double>& o) {
    o[op::euler_from_quaternion] = [](const double& order, const V4& Q) -> V3 {
      V3 angles = own_subject().operations[op::euler_from_quaternion](order, Q);
      const double end = order < 12 ? std::copysign(pi / 2, angles[1]) : angles[1] < 1 ? 0 : pi;
      if (std::fabs(end - angles[1]) < 1e-3) angles[1] = end;
      return angles;
    };
  });
  ASSERT_EQ(all.size(), 1);
  EXPECT_TRUE(says(all[0], "where    the angle from gimbal lock")) << all[0];
  EXPECT_TRUE(says(all[0], "perhaps  a threshold: less than 0.001 rad from gimbal lock")) << all[0];
  EXPECT_TRUE(says(all[0], "is wrong by ")) << all[0];
}

TEST(Causes, OfADerivativeAreKnownWithoutADifference) {
  const auto all = findings([](TypedOperations<double>& o) {
    o[op::right_jacobian6_inverse] = [](const Vec<double, 6>& xi) -> Mat<double, 6> {
      return 1.001 * own_subject().operations[op::right_jacobian6_inverse](xi);
    };
    o[op::d_difference_arg1] = [](const Vec<double, 7>& q0, const Vec<double, 7>& q1) -> Mat<double, 6> {
      return 1.001 * own_subject().operations[op::d_difference_arg1](q0, q1);
    };
  });
  ASSERT_EQ(all.size(), 1);
  EXPECT_TRUE(says(all[0], "so       d_difference_arg1 fails in the same way")) << all[0];
}

TEST(Causes, OfAVectorSayItsLength) {
  const auto all = findings([](TypedOperations<double>& o) {
    o[op::act_point] = [](const Pose<double>& X, const V3& p) -> V3 {
      if (p.isZero(0)) return V3::Zero();  // forgets the translation
      return own_subject().operations[op::act_point](X, p);
    };
  });
  ASSERT_EQ(all.size(), 1);
  EXPECT_TRUE(says(all[0], "where    p_Y = 0: ")) << all[0];
}

TEST(Causes, OfAResultThatIsFiniteAreNotCalledNaN) {
  const auto all = findings([](TypedOperations<double>& o) {
    o[op::relative_angle] = [](const V4& Q, const V4& P) {
      const double angle = own_subject().operations[op::relative_angle](Q, P);
      return Q.dot(P) < 0 ? 2 * pi - angle : angle;
    };
  });
  ASSERT_EQ(all.size(), 1);
  EXPECT_TRUE(says(all[0], "all 15.7 digits lost") && !says(all[0], "NaN")) << all[0];
  EXPECT_TRUE(says(all[0], "where    Q0 . Q1 < 0: ")) << all[0];
}

TEST(Causes, TheOppositeQuaternionIsTheSameRotation) {
  EXPECT_TRUE(findings([](TypedOperations<double>& o) {
                o[op::normalize] = [](const V4& Q) -> V4 {
                  const V4 unit = own_subject().operations[op::normalize](Q);
                  return unit[3] < 0 ? V4(-unit) : unit;
                };
                o[op::first_order_normalize] = [](const V4& Q) -> V4 {
                  const V4 unit = own_subject().operations[op::first_order_normalize](Q);
                  return unit[3] < 0 ? V4(-unit) : unit;
                };
              }).empty());
  EXPECT_EQ(findings([](TypedOperations<double>& o) {
              o[op::normalize] = [](const V4& Q) -> V4 {
                V4 unit = own_subject().operations[op::normalize](Q);
                if (unit[3] < 0) unit[0] = -unit[0];
                return unit;
              };
            }).size(),
            1);
}

template <int PerMille>
V4 normalized_unless_small(const V4& Q) {
  if (Q.stableNorm() < PerMille * 1e-3) throw std::domain_error("too small");
  return own_subject().operations[op::normalize](Q);
}

TEST(Causes, AQuaternionWhoseNormIsFarFromOneMayBeRefused) {
  EXPECT_TRUE(findings([](TypedOperations<double>& o) {
                o[op::normalize] = [](const V4& Q) -> V4 {
                  if (Q.stableNorm() < 1e-5) throw std::domain_error("too small");
                  return own_subject().operations[op::normalize](Q);
                };
              }).empty());
  const auto all =
      findings([](TypedOperations<double>& o) { o[op::normalize] = normalized_unless_small<10>; });
  ASSERT_EQ(all.size(), 1);
  EXPECT_TRUE(says(all[0], "normalize (quaternion): refused in double")) << all[0];
}

}  // namespace
}  // namespace liecheck::properties
