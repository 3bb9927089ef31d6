// Findings of libraries whose wrong results are right ones of another call, or right ones with one change, say which.

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <campaign/campaign.hpp>
#include <campaign/robots.hpp>
#include <cmath>
#include <failures/substitutions.hpp>
#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

using V3 = Vec<double, 3>;
using V4 = Vec<double, 4>;
using V6 = Vec<double, 6>;
using M6 = Mat<double, 6>;

/// The call of an operation as the subject of liecheck answers it, changed by `plant`, at eight arguments.
std::vector<JudgedCall> calls_of(const Operation& operation,
                                 const std::vector<std::vector<double>>& arguments,
                                 void (*plant)(const std::vector<double>& x, std::vector<double>& result)) {
  std::vector<JudgedCall> all;
  for (const std::vector<double>& x : arguments) {
    JudgedCall call{{&operation, x, {}, ""}, {}};
    for (const oracles::Real& number : expected_of(call.call))
      call.right.push_back(static_cast<double>(number));
    call.call.result = call.right;
    plant(x, call.call.result);
    all.push_back(std::move(call));
  }
  return all;
}
std::vector<std::vector<double>> numbers(std::size_t size) {
  std::vector<std::vector<double>> all;
  for (int k = 1; k <= 8; ++k) {
    std::vector<double>& x = all.emplace_back();
    for (std::size_t i = 0; i < size; ++i) x.push_back(std::sin(k + 2.3 * static_cast<double>(i)));
  }
  return all;
}

TEST(Substitutions, AnArgumentThatIsLeftOut) {
  const auto calls = calls_of(op::cross_motion, numbers(12), [](const auto& x, auto& result) {
    for (std::size_t i = 0; i < 3; ++i)
      result[i] = x[(i + 1) % 3] * x[9 + (i + 2) % 3] - x[(i + 2) % 3] * x[9 + (i + 1) % 3];
  });
  EXPECT_EQ(substitution_of(op::cross_motion, calls), "where it fails, linear is what omega = 0 would give");
}

TEST(Substitutions, ANumberOfTheOppositeSign) {
  const auto calls =
      calls_of(op::exp3_quaternion, numbers(3), [](const auto&, auto& result) { result[1] = -result[1]; });
  EXPECT_EQ(substitution_of(op::exp3_quaternion, calls),
            "where it fails, the result is right but for Q.y, which is of the opposite sign");
}

TEST(Substitutions, AResultInFloat) {
  const auto in_float = [](const auto&, auto& result) {
    for (double& x : result) x = oracles::rounded_to_float(x);
  };
  EXPECT_EQ(float_of(op::exp3_quaternion, calls_of(op::exp3_quaternion, numbers(3), in_float)),
            "where it fails, the result is rounded to float");
}

TEST(Substitutions, AVectorInAnotherFrame) {
  const auto calls = calls_of(op::rotate_point, numbers(7), [](const auto& x, auto& result) {
    const Eigen::Quaterniond Q(&x[0]);
    const Eigen::Vector3d turned = Q.normalized() * (Q.normalized() * Eigen::Vector3d(&x[4]));
    std::copy_n(turned.data(), 3, result.begin());
  });
  EXPECT_EQ(
      substitution_of(op::rotate_point, calls),
      "where it fails, the result is what R(Q) p in place of p would give: it is taken in another frame");
}

TEST(Substitutions, NothingIsSaidOfRandomErrors) {
  const auto by_chance = [](const auto& x, auto& result) { result[0] += 0.1 * std::sin(1e4 * x[0]); };
  const auto calls = calls_of(op::exp3_quaternion, numbers(3), by_chance);
  EXPECT_EQ(substitution_of(op::exp3_quaternion, calls), "");
  EXPECT_EQ(float_of(op::exp3_quaternion, calls), "");
  EXPECT_EQ(substitution_of(op::exp3_quaternion,
                            calls_of(op::exp3_quaternion, numbers(3), [](const auto&, auto&) {})),
            "");
}

TEST(Substitutions, OfTooFewResultsNothingIsSaid) {
  auto calls =
      calls_of(op::exp3_quaternion, numbers(3), [](const auto&, auto& result) { result[1] = -result[1]; });
  calls.resize(3);
  EXPECT_EQ(substitution_of(op::exp3_quaternion, calls), "");
}

}  // namespace
}  // namespace liecheck::properties
