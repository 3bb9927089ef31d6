// Findings of libraries whose wrong results are right ones of another call, or right ones with one change, say which.

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <campaign/campaign.hpp>
#include <campaign/robots.hpp>
#include <cmath>
#include <failures/relations.hpp>
#include <failures/single_numbers.hpp>
#include <numbers>
#include "../own_subject.hpp"
#include "finding_texts.hpp"
#include "judged_calls.hpp"

namespace liecheck::properties {
namespace {

using V3 = Vec<double, 3>;
using V4 = Vec<double, 4>;
using V6 = Vec<double, 6>;
using M6 = Mat<double, 6>;

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

TEST(Substitutions, ANumberOfAnArgumentInFloat) {
  const auto calls = calls_of(op::rotate_point, numbers(7), [](const auto& x, auto& result) {
    std::vector<double> y = x;
    y[6] = oracles::rounded_to_float(y[6]);
    result = exact("rotate_point", y);
  });
  EXPECT_EQ(float_of(op::rotate_point, calls),
            "where it fails, the result is what p[2] rounded to float would give");
}

TEST(Substitutions, ASmallResultIsNotZero) {
  const auto times = [](double factor) {
    auto calls = calls_of(op::log3_quaternion, numbers(4), [](const auto&, auto&) {});
    for (JudgedCall& c : calls)
      for (double& x : c.call.result) x *= factor;
    return substitution_of(op::log3_quaternion, calls);
  };
  EXPECT_EQ(times(0), "where it fails, the result is 0");
  EXPECT_EQ(times(1e-9), "where it fails, the result is the right one times 1e-09");
}

TEST(Substitutions, AProductInPlace) {
  const auto calls = calls_of(op::rotate_point, numbers(7), [](const auto& x, auto& result) {
    std::vector<double> y = x;
    for (std::size_t i = 0; i < 3; ++i) y[4 + i] = result[i] = exact("rotate_point", y)[i];
  });
  EXPECT_TRUE(in_place_of(op::rotate_point, calls).starts_with("x_A is computed in place (aliasing)"))
      << in_place_of(op::rotate_point, calls);
  EXPECT_EQ(in_place_of(op::rotate_point, calls_of(op::rotate_point, numbers(7),
                                                   [](const auto&, auto& result) { result[1] += 1; })),
            "");
}

TEST(Substitutions, AProductOfRotationsInPlace) {
  std::vector<std::vector<double>> poses;
  for (const std::vector<double>& x : numbers(12)) {
    poses.push_back(exact("exp6", {x.begin(), x.begin() + 6}));
    for (const double y : exact("exp6", {x.begin() + 6, x.end()})) poses.back().push_back(y);
  }
  const auto calls = calls_of(op::compose, poses, [](const auto& x, auto& result) {
    Eigen::Matrix3d R;
    for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = x[static_cast<std::size_t>(i)];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) sum += R(i, k) * x[static_cast<std::size_t>(12 + 3 * k + j)];
        result[static_cast<std::size_t>(3 * i + j)] = R(i, j) = sum;
      }
  });
  EXPECT_TRUE(says(in_place_of(op::compose, calls), "overwrite those of the first factor"))
      << in_place_of(op::compose, calls);
}

TEST(Substitutions, ANumberThatIsNeverNegative) {
  std::vector<std::vector<double>> beyond_pi;
  for (std::vector<double>& x : numbers(3)) {
    const double norm = std::hypot(x[0], x[1], x[2]);
    for (double& v : x) v *= 4 / norm;
    beyond_pi.push_back(x);
  }
  const auto calls =
      calls_of(op::exp3_quaternion, beyond_pi, [](const auto&, auto& Q) { Q[3] = std::fabs(Q[3]); });
  EXPECT_EQ(substitution_of(op::exp3_quaternion, calls),
            "where it fails, the result is right but for Q.w, which is its absolute value");
}

TEST(Substitutions, AFactor) {
  const auto of = [](void (*plant)(const std::vector<double>&, std::vector<double>&)) {
    return substitution_of(op::log3_quaternion, calls_of(op::log3_quaternion, numbers(4), plant));
  };
  EXPECT_EQ(of([](const auto&, auto& phi) {
              for (double& x : phi) x *= 1.5;
            }),
            "where it fails, the result is the right one times 1.5");
  EXPECT_EQ(of([](const auto&, auto& phi) { phi[1] *= 1.1; }),
            "where it fails, the result is right but for phi[1], which is the right one times 1.1");
  EXPECT_EQ(of([](const auto&, auto& phi) {
              for (double& x : phi) x *= 1 - 2e-7;
            }),
            "");  // as of a constant in float
  EXPECT_EQ(of([](const auto& x, auto& phi) { phi[x[0] > 0 ? 0 : 1] *= 1.1; }), "");
  EXPECT_EQ(of([](const auto&, auto& phi) {
              for (double& x : phi) x *= 2;
            }),
            "where it fails, the result is twice the right one");
}

TEST(Substitutions, AnAngleBeyondPiThatIsWrapped) {
  std::vector<std::vector<double>> large = numbers(3);
  for (auto& x : large)
    for (double& v : x) v *= 5;
  const auto calls = calls_of(op::left_jacobian3, large, [](const auto& x, auto& J) {
    const double angle = std::hypot(x[0], x[1], x[2]), wrapped = std::remainder(angle, 2 * EIGEN_PI);
    J = exact("left_jacobian3", {x[0] * wrapped / angle, x[1] * wrapped / angle, x[2] * wrapped / angle});
  });
  EXPECT_EQ(substitution_of(op::left_jacobian3, calls),
            "where it fails, the result is what phi with its angle brought into [-pi, pi] would give");
  const auto angles = calls_of(op::twist_angle, numbers(7), [](const auto&, auto& angle) {
    angle[0] += angle[0] > 0 ? -2 * EIGEN_PI : 2 * EIGEN_PI;
  });
  EXPECT_TRUE(says(substitution_of(op::twist_angle, angles), "it is not brought into [-pi, pi]"))
      << substitution_of(op::twist_angle, angles);
}

TEST(Substitutions, ACouplingBlockWithAFactorTooFew) {
  const auto calls = calls_of(op::left_jacobian6_inverse, numbers(6), [](const auto&, auto& J) {
    using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> all(J.data());
    const Block D = all.topLeftCorner<3, 3>();
    all.topRightCorner<3, 3>() *= D.inverse();
  });
  auto in_blocks = calls;  // as judged_calls() gives them
  for (JudgedCall& c : in_blocks)
    for (std::vector<double>* x : {&c.call.result, &c.right}) {
      std::vector<double> all;
      for (const std::size_t corner : {0, 3, 18, 21})
        for (std::size_t i = 0; i < 9; ++i) all.push_back((*x)[corner + i / 3 * 6 + i % 3]);
      *x = all;
    }
  EXPECT_TRUE(says(substitution_of(op::left_jacobian6_inverse, in_blocks),
                   "the upper right block is C D^-1 in place of C"))
      << substitution_of(op::left_jacobian6_inverse, in_blocks);
}

TEST(Substitutions, TheIdentity) {
  const auto calls = calls_of(op::normalize, numbers(4), [](const auto&, auto& Q) { Q = {0, 0, 0, 1}; });
  EXPECT_EQ(substitution_of(op::normalize, calls), "where it fails, the result is the identity (0, 0, 0, 1)");
}

TEST(Substitutions, AMatrixOfAQuaternionThatIsNotNormalised) {
  const auto calls = calls_of(op::matrix_from_quaternion_any_norm, numbers(4), [](const auto& x, auto& R) {
    const double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
    for (std::size_t i = 0; i < 9; ++i) R[i] = (i % 4 == 0) + square * (R[i] - (i % 4 == 0));
  });
  EXPECT_EQ(norm_power_of(op::matrix_from_quaternion_any_norm, calls),
            "where it fails, R - 1 is |Q|^2 times the right one: Q is not normalised");
}

TEST(Substitutions, APowerOfTheNormOfQ) {
  const auto calls = calls_of(op::log3_any_norm, numbers(4), [](const auto& x, auto& result) {
    for (double& y : result) y *= std::hypot(std::hypot(x[0], x[1], x[2]), x[3]);
  });
  EXPECT_EQ(norm_power_of(op::log3_any_norm, calls), "where it fails, the result is |Q| times the right one");
}

TEST(Substitutions, WhichNumbersAreWrong) {
  const auto of = [](void (*plant)(const std::vector<double>&, std::vector<double>&)) {
    return wrong_numbers_of(op::exp3_matrix, calls_of(op::exp3_matrix, numbers(3), plant));
  };
  EXPECT_EQ(of([](const auto&, auto& R) { std::swap(R[1], R[3]); }),
            "where it fails, R[0,1] and R[1,0] are exchanged");
  EXPECT_EQ(
      of([](const auto& x, auto& R) { R[5] += x[0], R[7] += x[0]; }),
      "a wrong term, factor or sign in R[1,2] and R[2,1]: the other numbers are right, or err far less");
  EXPECT_EQ(of([](const auto& x, auto& R) { R[static_cast<std::size_t>(std::fabs(1e4 * x[0])) % 9] += 1; }),
            "");
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

TEST(Substitutions, AnAngleThatIsWrongByAConstant) {
  const auto with_pi = [](double two_pi) {
    return [two_pi](const auto&, auto& result) {
      const double angle = std::hypot(result[0], result[1], result[2]);
      for (double& x : result) x *= (angle + two_pi - 2 * std::numbers::pi) / angle;
    };
  };
  const auto calls = [&](double two_pi) {
    auto all = calls_of(op::log3_quaternion, numbers(4), [](const auto&, auto&) {});
    for (JudgedCall& c : all) with_pi(two_pi)(c.call.arguments, c.call.result);
    return all;
  };
  EXPECT_EQ(constant_of(op::log3_quaternion, calls(static_cast<float>(2 * std::numbers::pi))),
            "where it fails, the angle is 1.7e-07 rad too large: 2 pi in float");
  EXPECT_EQ(constant_of(op::log3_quaternion, calls(6.2831853)),
            "where it fails, the angle is 7.2e-09 rad too small: 6.2831853 in place of 2 pi");
  EXPECT_EQ(constant_of(op::log3_quaternion, calls(6.2841)),
            "where it fails, the angle is 0.00091 rad too large");
  EXPECT_EQ(constant_of(op::log3_quaternion, calls_of(op::log3_quaternion, numbers(4),
                                                      [](const auto&, auto& r) { r[0] += 1e-5; })),
            "");
}

TEST(Substitutions, AnApproximation) {
  const auto calls = [](double error) {
    std::vector<std::vector<double>> x = numbers(4);
    for (const auto& more : numbers(4)) x.push_back({more[3], more[2], more[1], more[0]});
    auto all = calls_of(op::log3_quaternion, x, [](const auto&, auto&) {});
    for (std::size_t i = 0; i < all.size(); ++i) all[i].call.result[i % 3] *= 1 + error;
    return all;
  };
  const std::string text = approximation_of(op::log3_quaternion, calls(5e-6));
  EXPECT_TRUE(text.starts_with("an approximation: most results are right to 5 digits")) << text;
  EXPECT_EQ(approximation_of(op::log3_quaternion, calls(0.5)), "");
}

TEST(Substitutions, SeveralNumbersOfTheOppositeSign) {
  const auto calls = calls_of(op::exp6, numbers(6), [](const auto&, auto& result) {
    for (const std::size_t i : {1u, 3u}) result[i] = -result[i];
  });
  EXPECT_EQ(wrong_numbers_of(op::exp6, calls), "where it fails, R[0,1], R[1,0] are of the opposite sign");
}

TEST(Substitutions, PartsThatAreWrongEachInItsOwnWay) {
  const auto zero = calls_of(op::cross_motion, numbers(12),
                             [](const auto&, auto& result) { std::ranges::fill(result, 0.0); });
  EXPECT_EQ(substitution_of(op::cross_motion, zero), "where it fails, the result is 0");
  const auto two = calls_of(op::cross_motion, numbers(12), [](const auto& x, auto& result) {
    for (std::size_t i = 0; i < 3; ++i) result[i] = x[i] * x[6] + 1, result[3 + i] = -result[3 + i];
  });
  EXPECT_EQ(substitution_of(op::cross_motion, two),
            "where angular is wrong, it is the opposite of the right one");
}

TEST(Substitutions, AnEulerAngleThatIsOffByPi) {
  std::vector<std::vector<double>> x = numbers(5);
  for (auto& of_call : x) of_call[0] = 11;
  const auto calls = calls_of(op::euler_from_quaternion, x, [](const auto&, std::vector<double>& angles) {
    angles[0] += angles[0] > 0 ? -std::numbers::pi : std::numbers::pi;
  });
  EXPECT_EQ(substitution_of(op::euler_from_quaternion, calls),
            "where it fails, the result is right but for angles[0], which is off by pi, as atan(y / x) is in "
            "place of atan2(y, x)");
}

TEST(Substitutions, AnAngleThatIsCutOffAtPi) {
  std::vector<std::vector<double>> x = numbers(3);
  for (auto& phi : x)
    for (double& v : phi) v *= 5;
  const auto calls = calls_of(op::exp3_quaternion, x, [](const std::vector<double>& phi, auto& result) {
    const double angle = std::hypot(phi[0], phi[1], phi[2]), part = std::min(1.0, std::numbers::pi / angle);
    const double sin = std::sin(part * angle / 2) / angle;
    result = {sin * phi[0], sin * phi[1], sin * phi[2], std::cos(part * angle / 2)};
  });
  EXPECT_EQ(substitution_of(op::exp3_quaternion, calls),
            "where it fails, the result is what phi with its angle cut off at pi would give");
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
