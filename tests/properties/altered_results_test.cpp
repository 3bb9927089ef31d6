// Results that are those of a whole argument's opposite, of another order or formula, or right but for a length or for signs.

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <failures/alternatives.hpp>
#include <failures/lost_digits.hpp>
#include <failures/single_numbers.hpp>
#include <failures/terms.hpp>
#include <failures/wrong_parts.hpp>
#include <numbers>
#include <operations/operations.hpp>

#include "judged_calls.hpp"

namespace liecheck::properties {
namespace {

using V3 = Vec<double, 3>;

TEST(Substitutions, AnotherOrderOfEulerAngles) {
  auto arguments = numbers(4);
  for (auto& x : arguments) x[0] = 4;
  const auto calls = calls_of(op::euler_to_quaternion, arguments, [](const auto& x, auto& result) {
    std::vector<double> y = x;
    y[0] = 6;
    result = exact("euler_to_quaternion", y);
  });
  EXPECT_EQ(other_order_of(op::euler_to_quaternion, calls),
            "where it fails, the result is that of the order YZX");
}

TEST(Substitutions, AnotherOrderOfEulerAnglesOfEachKind) {
  auto arguments = numbers(4);
  for (std::size_t i = 0; i < arguments.size(); ++i) arguments[i][0] = 6 + static_cast<double>(i % 2);
  const auto calls = calls_of(op::euler_to_matrix, arguments, [](const auto& x, auto& result) {
    std::vector<double> y = x;
    y[0] = x[0] == 6 ? 4 : 11;
    result = exact("euler_to_matrix", y);
  });
  EXPECT_EQ(other_order_of(op::euler_to_matrix, calls),
            "where it fails, the result is that of the order ZYX, rotating, or YXZ, static");
}

TEST(Substitutions, AnAngleOfTheOppositeSignOfEachKind) {
  auto arguments = numbers(4);
  for (std::size_t i = 0; i < arguments.size(); ++i) arguments[i][0] = 6 + static_cast<double>(i % 2);
  const auto calls = calls_of(op::euler_to_matrix, arguments, [](const auto& x, auto& result) {
    std::vector<double> y = x;
    y[x[0] == 6 ? 1 : 3] *= -1;
    result = exact("euler_to_matrix", y);
  });
  const std::string text = substitution_of_one_kind(op::euler_to_matrix, calls);
  EXPECT_NE(text.find("of rotating axes, where it fails, the result is what angles[2] of the opposite sign"),
            text.npos)
      << text;
  EXPECT_NE(text.find("of static axes, where it fails, the result is what angles[0] of the opposite sign"),
            text.npos)
      << text;
}

TEST(Substitutions, FormulasOfLibraries) {
  auto arguments = numbers(15);
  for (auto& x : arguments)
    for (std::size_t i = 12; i < 15; ++i) x[i] = 1 + std::fabs(x[i]);
  const auto sum = [](const auto& x, auto& result) {
    double square = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      result[k] = x[12] * x[k];
      for (const std::size_t i : {4u, 8u}) {
        double dot = 0;
        for (std::size_t n = 0; n < 4; ++n) dot += x[n] * x[i + n];
        result[k] += (dot < 0 ? -1 : 1) * x[12 + i / 4] * x[i + k];
      }
      square += result[k] * result[k];
    }
    for (double& number : result) number /= std::sqrt(square);
  };
  EXPECT_TRUE(alternative_of(op::mean_rotation, calls_of(op::mean_rotation, arguments, sum))
                  .starts_with("the sum of the quaternions"));
  std::vector<std::vector<double>> rotations;
  for (const auto& x : numbers(3))
    rotations.push_back(exact("exp3_matrix", {2.8 + 0.1 * x[0], x[1] / 2, x[2] / 2}));
  EXPECT_TRUE(alternative_of(
                  op::quaternion_from_matrix,
                  calls_of(op::quaternion_from_matrix, rotations,
                           [](const auto& R, auto& result) { result[1] *= (R[1] - R[3]) / (R[1] + R[3]); }))
                  .starts_with("in the branch of one of the entries of the diagonal"));
}

TEST(Substitutions, TheOppositeOfAWholeArgument) {
  auto arguments = numbers(13);
  for (auto& x : arguments)
    for (std::size_t i = 3; i < 7; ++i) x[i] = i == 6 ? 0.5 : (i == 4 ? -0.5 : 0.5);
  const auto calls = calls_of(op::integrate, arguments, [](const auto& x, auto& result) {
    std::vector<double> y = x;
    for (std::size_t i = 7; i < 13; ++i) y[i] = -y[i];
    result = exact("integrate", y);
  });
  EXPECT_EQ(substitution_of(op::integrate, calls), "where it fails, the result is what -delta would give");
}

TEST(Substitutions, SignsThatAreLost) {
  const auto calls = calls_of(op::log3_any_norm, numbers(4), [](const auto&, auto& result) {
    for (double& x : result) x = std::fabs(x);
  });
  EXPECT_EQ(substitution_of(op::log3_any_norm, calls),
            "where it fails, the result is right but for the signs of its numbers, which are lost");
}

TEST(Substitutions, ASignOfANumberThatIsLost) {
  const auto lost = [](const auto&, auto& result) { result[0] = std::fabs(result[0]); };
  const auto opposite = [](const auto&, auto& result) { result[0] = -result[0]; };
  auto arguments = numbers(7);
  for (auto& x : arguments) x = {x[0], x[1], x[2], std::fabs(x[3]), 1, 0, 0};
  for (std::size_t i = 0; i < 8; ++i) arguments.push_back(arguments[i]), arguments.back()[0] *= -1;
  EXPECT_EQ(substitution_of(op::twist_angle, calls_of(op::twist_angle, arguments, lost)),
            "where it fails, the result is the absolute value of the right one");
  EXPECT_EQ(substitution_of(op::twist_angle, calls_of(op::twist_angle, arguments, opposite)),
            "where it fails, the result is the opposite of the right one");
}

TEST(Substitutions, AnAngleThatIsBroughtBackByPi) {
  auto arguments = numbers(3);
  for (auto& x : arguments)
    for (double& number : x) number *= 4;
  const auto calls = calls_of(op::exp3_matrix, arguments, [](const auto& x, auto& result) {
    const double angle = std::hypot(x[0], x[1], x[2]), pi = std::numbers::pi;
    std::vector<double> y = x;
    for (double& number : y) number *= angle > pi ? 1 - pi / angle : 1;
    result = exact("exp3_matrix", y);
  });
  EXPECT_EQ(
      substitution_of(op::exp3_matrix, calls),
      "where it fails, the result is what phi with pi, not 2 pi, taken from an angle above pi would give");
}

TEST(Substitutions, ALength) {
  const auto longer = [](const auto& x, auto& result) {
    for (double& number : result) number *= 1.5 + std::sin(9 * x[0]);
  };
  EXPECT_EQ(substitution_of(op::exp3_quaternion, calls_of(op::exp3_quaternion, numbers(3), longer)),
            "where it fails, Q is right but for its length: it is not normalised");
  EXPECT_EQ(substitution_of(op::screw_parameters, calls_of(op::screw_parameters, numbers(6),
                                                           [](const auto& x, auto& result) {
                                                             result[3] *= std::hypot(x[3], x[4], x[5]);
                                                           })),
            "where it fails, pitch is the right one times |omega|");
}

TEST(Substitutions, ALengthThatIsLimited) {
  auto arguments = numbers(4);
  for (auto& x : arguments) x[3] *= 1e-3;
  const auto calls = calls_of(op::gibbs_from_quaternion, arguments, [](const auto&, auto& result) {
    const double length = std::hypot(result[0], result[1], result[2]);
    for (double& number : result) number *= std::min(1.0, 10 / length);
  });
  EXPECT_EQ(
      wrong_length_of(op::gibbs_from_quaternion, calls),
      "where it fails, gibbs is right but for its length, which is 10 in all of them: a limit of it, or of "
      "what it is divided by");
}

TEST(Substitutions, ASumInFloat) {
  const auto in_float = [](const auto& x, auto& result) {
    for (std::size_t i = 0; i < 3; ++i) {
      float sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += static_cast<float>(x[3 * i + k]) * static_cast<float>(x[12 + k]);
      result[i] = static_cast<double>(sum + static_cast<float>(x[9 + i]));
    }
  };
  auto arguments = numbers(15);
  for (auto& x : arguments) std::ranges::copy(exact("exp3_matrix", {x[0], x[1], x[2]}), x.begin());
  EXPECT_EQ(float_of(op::act_point, calls_of(op::act_point, arguments, in_float)),
            "where it fails, the result has numbers of a float: it is calculated in float");
}

TEST(Substitutions, TermsOfTheCouplingAsADerivative) {
  const auto without = [](const auto& xi, auto& J) {  // C lacks (phi . rho) (B - 3 C)/theta^2 [phi]^2
    const double x = xi[3], y = xi[4], z = xi[5], theta = std::hypot(x, y, z);
    const double B = (1 - std::cos(theta)) / (theta * theta),
                 C = (theta - std::sin(theta)) / (theta * theta * theta);
    const double factor = (x * xi[0] + y * xi[1] + z * xi[2]) * (B - 3 * C) / (theta * theta);
    const double square[] = {-y * y - z * z, x * y, x * z, x * y,         -x * x - z * z,
                             y * z,          x * z, y * z, -x * x - y * y};
    for (std::size_t i = 0; i < 9; ++i) J[9 + i] -= factor * square[i];
  };
  auto calls = calls_of(op::left_jacobian6, numbers(6), [](const auto&, auto&) {});
  for (JudgedCall& c : calls) {
    c.right = in_blocks(op::left_jacobian6, c.right), c.call.result = c.right;
    without(c.call.arguments, c.call.result);
  }
  EXPECT_TRUE(
      wrong_term_of(op::left_jacobian6, calls).find("the term (phi . rho) (B - 3 C)/theta^2 [phi]^2") !=
      std::string::npos)
      << wrong_term_of(op::left_jacobian6, calls);
}

TEST(Substitutions, APositionWithTheVelocityAfterItsUpdate) {
  const auto late = [](const auto& x, auto& result) {  // dp += dv dt + 1/2 dR a dt^2, with the new dv
    const double dt = x[18];
    std::vector<double> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (std::size_t m = 0; m < 3; ++m) {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) result[9 + i] += R[3 * i + k] * x[9 + 3 * m + k] * dt * dt;
      const std::vector<double> turn = exact("exp3_matrix",
                                             {dt * x[3 * m], dt * x[3 * m + 1], dt * x[3 * m + 2]}),
                                old = R;
      for (std::size_t i = 0; i < 9; ++i) {
        R[i] = 0;
        for (std::size_t k = 0; k < 3; ++k) R[i] += old[3 * (i / 3) + k] * turn[3 * k + i % 3];
      }
    }
  };
  EXPECT_EQ(wrong_term_of(op::preintegrate_forster, calls_of(op::preintegrate_forster, numbers(19), late)),
            "where it fails, the term 1/2 dR a dt^2 has 3 times its factor");
}

/// Small rotations, as quaternions.
std::vector<std::vector<double>> small_rotations() {
  std::vector<std::vector<double>> all;
  double theta = 1e-6;
  for (const auto& x : numbers(3))
    all.push_back(exact("exp3_quaternion", {theta * x[0], theta * x[1], theta * x[2]})), theta *= 3;
  return all;
}

TEST(LostDigits, NameWhatCancels) {
  const auto of_cosine = [](const auto& Q, auto& result) {
    const double angle = 2 * std::acos(Q[3]), length = std::sqrt(Q[0] * Q[0] + Q[1] * Q[1] + Q[2] * Q[2]);
    for (std::size_t i = 0; i < 3; ++i) result[i] = Q[i] / length * angle;
  };
  EXPECT_TRUE(
      lost_digits_of(op::log3_quaternion, calls_of(op::log3_quaternion, small_rotations(), of_cosine), false)
          .starts_with("acos near 1"));
  const auto of_root = [](const auto& Q, auto& result) {
    const double sine = std::sqrt(1 - Q[3] * Q[3]);
    for (std::size_t i = 0; i < 3; ++i) result[i] = Q[i] * (2 * std::acos(Q[3])) / sine;
  };
  EXPECT_TRUE(
      lost_digits_of(op::log3_quaternion, calls_of(op::log3_quaternion, small_rotations(), of_root), false)
          .starts_with("acos(w) and sqrt(1 - w^2)"));
}

TEST(LostDigits, NameNothingWhereErrorsAreOfAnotherKind) {
  const auto longer = [](const auto&, auto& result) {
    for (double& number : result) number *= 1 + 1e-9;
  };
  EXPECT_EQ(
      lost_digits_of(op::log3_quaternion, calls_of(op::log3_quaternion, small_rotations(), longer), false),
      "");
  const auto right = [](const auto&, auto&) {};
  EXPECT_EQ(
      lost_digits_of(op::log3_quaternion, calls_of(op::log3_quaternion, small_rotations(), right), false),
      "");
}

TEST(Substitutions, ColumnsThatAreNotNormalised) {
  std::vector<std::vector<double>> arguments;
  for (const auto& x : numbers(12)) {
    std::vector<double> A = exact("exp3_matrix", {x[0], x[1], x[2]});
    for (std::size_t i = 0; i < 9; ++i) A[i] += 0.05 * x[3 + i];
    arguments.push_back(A);
  }
  const auto calls = calls_of(op::gram_schmidt, arguments, [](const auto& x, auto& result) {
    for (std::size_t i = 0; i < 9; ++i) result[i] *= i % 3 == 0 ? 1 : 0.9 + 0.1 * std::sin(9 * x[0]);
  });
  EXPECT_EQ(wrong_length_of(op::gram_schmidt, calls),
            "where it fails, the columns of R are right but for their lengths: they are not normalised");
}

TEST(Substitutions, AVectorThatIsOnlyTurned) {
  std::vector<std::vector<double>> arguments;
  for (const auto& x : numbers(9)) {
    arguments.push_back(exact("exp3_matrix", {x[0], x[1], x[2]}));
    arguments.back().insert(arguments.back().end(), x.begin() + 3, x.end());
  }
  const auto calls = calls_of(op::se23_log, arguments, [](const auto& x, auto& result) {
    const V3 v(&x[12]);
    V3::Map(&result[3]) =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(x.data()).transpose() * v;
  });
  EXPECT_EQ(substitution_of(op::se23_log, calls), "where it fails, nu is R^T v");
}

}  // namespace
}  // namespace liecheck::properties
