// Wrong results that lack a term, or have one with another sign, factor or in place of another, say which.

#include <failures/terms.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <failures/relations.hpp>
#include <functional>
#include <operations/operations.hpp>

namespace liecheck::properties {
namespace {

using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Plant = std::function<void(const std::vector<double>& x, std::vector<double>& result)>;

V3 three(const std::vector<double>& x, std::size_t from) {
  return V3(&x.at(from));
}
M3 skew(const V3& a) {
  M3 m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}
template <class V>
void add(std::vector<double>& to, std::size_t from, const V& v) {
  for (Eigen::Index i = 0; i < v.size(); ++i) to.at(from + static_cast<std::size_t>(i)) += v.data()[i];
}
/// What is told of an operation's results at eight arguments, changed by `plant`. 6 x 6 numbers are in blocks.
std::string told(const Operation& operation, std::size_t size, const Plant& plant, bool of_pose = false) {
  std::vector<JudgedCall> calls;
  double number = 0.3;
  for (int k = 1; k <= 8; ++k) {
    std::vector<double> x;
    for (std::size_t i = 0; i < size; ++i)
      number = std::fmod(997 * number + 0.137, 1), x.push_back(2 * number - 1);
    if (of_pose) {  // R and p come first, and R of a second pose
      const std::vector<double> R = exact("exp3_matrix", {x[0], x[1], x[2]});
      std::copy(R.begin(), R.end(), x.begin());
      if (size == 24) std::copy(R.rbegin(), R.rend(), x.begin() + 12);
    }
    JudgedCall call{{&operation, x, {}, ""}, {}};
    for (const oracles::Real& exact_number : expected_of(call.call))
      call.right.push_back(static_cast<double>(exact_number));
    if (call.right.size() == 36) {
      const std::vector<double> rows = call.right;
      call.right.clear();
      for (const std::size_t corner : {0, 3, 18, 21})
        for (std::size_t i = 0; i < 9; ++i) call.right.push_back(rows[corner + i / 3 * 6 + i % 3]);
    }
    call.call.result = call.right;
    plant(x, call.call.result);
    calls.push_back(std::move(call));
  }
  return wrong_term_of(operation, calls);
}

TEST(Terms, OfSpatialAlgebra) {
  EXPECT_EQ(told(op::cross_motion, 12,
                 [](const auto& x, auto& y) { add(y, 0, V3(-three(x, 0).cross(three(x, 9)))); }),
            "where it fails, the term u x omega_W is left out");
  EXPECT_EQ(told(op::cross_force, 12,
                 [](const auto& x, auto& y) { add(y, 3, V3(-2 * three(x, 0).cross(three(x, 6)))); }),
            "where it fails, the term u x f has the opposite sign");
  EXPECT_EQ(told(op::momentum, 19,
                 [](const auto& x, auto& y) { add(y, 3, V3(x[0] * three(x, 1).cross(three(x, 13)))); }),
            "where it fails, the term m c x u is counted twice");
  EXPECT_EQ(told(op::kinetic_energy, 19,
                 [](const auto& x, auto& y) {
                   y[0] -= x[0] * three(x, 13).dot(three(x, 16).cross(three(x, 1))) / 2;
                 }),
            "where it fails, the term m u . (omega x c) has 0.5 times its factor");
  EXPECT_EQ(
      told(op::rotate_point, 7,
           [](const auto& x, auto& y) {
             add(y, 0,
                 V3(-4 * x[3] * three(x, 0).cross(three(x, 4)) / Eigen::Vector4d(x.data()).squaredNorm()));
           }),
      "");  // not of unit length
}

TEST(Terms, OfPoses) {
  const auto R = [](const auto& x) { return M3(x.data()); };
  EXPECT_EQ(
      told(
          op::act_motion, 18,
          [&](const auto& x, auto& y) { add(y, 0, V3(-three(x, 9).cross(R(x) * three(x, 15)))); }, true),
      "where it fails, the term p x R omega is left out");
  EXPECT_EQ(told(
                op::act_inverse_force, 18,
                [&](const auto& x, auto& y) {
                  add(y, 3, V3(2 * R(x).transpose() * three(x, 9).cross(three(x, 12))));
                },
                true),
            "where it fails, the term -R^T (p x f) has the opposite sign");
  EXPECT_EQ(told(
                op::act_point, 15, [&](const auto& x, auto& y) { add(y, 0, V3(-three(x, 9))); }, true),
            "where it fails, the term p is left out");
  EXPECT_EQ(
      told(
          op::log6, 12,
          [&](const auto& x, auto& y) {
            add(y, 0, V3(three(exact("log3_matrix", {x.begin(), x.begin() + 9}), 0).cross(three(x, 9))));
          },
          true),
      "where it fails, the term -1/2 phi x p has the opposite sign");
}

TEST(Terms, OfTheInertiaMatrix) {
  EXPECT_EQ(told(op::inertia_matrix, 13,
                 [](const auto& x, auto& y) {
                   const V3 c = three(x, 1);
                   add(y, 27, M3(x[0] * c * c.transpose()));
                 }),
            "where it fails, the term -m c c^T is left out");
}

TEST(Terms, WithAPowerOfTheta) {
  const auto square = [](const auto& x) { return M3(skew(three(x, 0)) * skew(three(x, 0))); };
  EXPECT_EQ(told(op::exp3_matrix, 3,
                 [&](const auto& x, auto& y) {
                   const double t = three(x, 0).norm();
                   add(y, 0, M3((1 - std::cos(t)) * (1 / t - 1 / (t * t)) * square(x)));
                 }),
            "where it fails, the term (1 - cos(theta))/theta^2 [phi]^2 is theta times the right one");
}

TEST(Terms, OfExponentialsAndJacobians) {
  EXPECT_EQ(told(op::left_jacobian3_inverse, 3,
                 [](const auto& x, auto& y) { add(y, 0, M3(0.5 * skew(three(x, 0)))); }),
            "where it fails, the term 1/2 [phi] is left out");
  const auto coefficient = [](double t) { return (t * t + 2 * std::cos(t) - 2) / (2 * std::pow(t, 4)); };
  EXPECT_EQ(told(op::left_jacobian6, 6,
                 [&](const auto& x, auto& y) {
                   const M3 F = skew(three(x, 3)), P = skew(three(x, 0));
                   add(y, 9, M3(2 * coefficient(three(x, 3).norm()) * F * P * F));
                 }),
            "where it fails, the term -3 (theta^2 + 2 cos(theta) - 2)/(2 theta^4) [phi][rho][phi] has 0.333 "
            "times its factor");
  EXPECT_EQ(told(op::right_jacobian6, 6,
                 [&](const auto& x, auto& y) {
                   const M3 F = skew(-three(x, 3)), P = skew(-three(x, 0));
                   add(y, 9, M3(coefficient(three(x, 3).norm()) * (F * F * P - P * F * F)));
                 }),
            "where it fails, (theta^2 + 2 cos(theta) - 2)/(2 theta^4) [phi]^2 [rho] stands in place of "
            "(theta^2 + 2 cos(theta) - 2)/(2 theta^4) [rho] [phi]^2");
  EXPECT_EQ(told(op::d_integrate_arg0, 13,
                 [](const auto& x, auto& y) {
                   const std::vector<double> X = exact("exp6", {x.begin() + 7, x.end()});
                   const M3 R(X.data()), p = skew(three(X, 9)), other = p * R.transpose();
                   add(y, 9, M3(other + R.transpose() * p));
                 }),
            "where it fails, [p] R^T stands in place of -R^T [p]");
}

TEST(Terms, NothingIsSaidOfOtherErrors) {
  EXPECT_EQ(told(op::cross_motion, 12, [](const auto& x, auto& y) { y[0] += x[1] * x[2]; }), "");
}

}  // namespace
}  // namespace liecheck::properties
