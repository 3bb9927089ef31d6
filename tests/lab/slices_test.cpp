// The slices of whole operations in float: their reference against 100 digits, and the errors that they find.

#include <gtest/gtest.h>

#include <cmath>
#include <coefficients/slices.hpp>
#include <numbers>
#include <operations/operations.hpp>
#include <oracles/slice_reference.hpp>
#include <wide/wide_errors.hpp>

namespace liecheck::properties {
namespace {

namespace reference = oracles::slice;

/// The errors of a result of `operation` in eps of float, by the closed forms at 100 digits.
double worst_error(const Operation& operation, const std::vector<double>& arguments,
                   const std::vector<double>& result) {
  WideNumbers in, out;
  for (double x : arguments) in.push_back(wide(x));
  for (double x : result) out.push_back(wide(x));
  std::vector<BlockErrors> blocks;
  add_wide_errors(blocks, operation, 0x1p-23, in, out);
  double worst = 0;
  for (const BlockErrors& b : blocks)
    for (double e : b.errors) worst = std::max(worst, e);
  return worst;
}
template <class A>
std::vector<double> list(const A& a) {
  return {a.begin(), a.end()};
}

TEST(Slices, TheReferenceErrsByLessThan1e_5EpsOfFloat) {
  for (double theta = 1e-30; theta < std::numbers::pi; theta = theta < 1e-3 ? theta * 9.7 : theta + 0.0137) {
    const double unit[3] = {2.0 / 7, -3.0 / 7, 6.0 / 7};
    const reference::V3 phi{theta * unit[0], theta * unit[1], theta * unit[2]}, rho{0.3, -1.7, 0.9};
    std::vector<double> xi = list(rho), p = list(phi);
    xi.insert(xi.end(), phi.begin(), phi.end());
    const auto R = reference::rotation(phi), J = reference::left_jacobian(phi),
               C = reference::coupling(rho, phi);
    EXPECT_LT(worst_error(op::exp3_quaternion, p, list(reference::quaternion(phi))), 1e-5) << theta;
    EXPECT_LT(worst_error(op::exp3_matrix, p, list(R)), 1e-5) << theta;
    EXPECT_LT(worst_error(op::left_jacobian3, p, list(J)), 1e-5) << theta;
    EXPECT_LT(worst_error(op::left_jacobian3_inverse, p, list(reference::left_jacobian_inverse(phi))), 1e-5)
        << theta;
    std::vector<double> T = list(R), J6(36, 0);
    for (double x : reference::translation(rho, phi)) T.push_back(x);
    EXPECT_LT(worst_error(op::exp6, xi, T), 1e-5) << theta;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        J6[6 * i + j] = J6[6 * (i + 3) + j + 3] = J[3 * i + j], J6[6 * i + j + 3] = C[3 * i + j];
    EXPECT_LT(worst_error(op::left_jacobian6, xi, J6), 1e-5) << theta;
    const auto Q = reference::quaternion(phi);
    EXPECT_LT(worst_error(op::log3_quaternion, list(Q), list(reference::logarithm(Q))), 1e-5) << theta;
  }
}

TEST(Slices, OfEveryOperationStayWithinTheBudgetsAndNearTheHuntedErrors) {
  SliceOptions options;
  options.stride = 4001, options.tried = 50;
  const auto slices = sweep_slices(options);
  EXPECT_EQ(slices.size(), 2 * slice_operations().size());
  for (const Slice& s : slices) {
    EXPECT_TRUE(s.complete) << s.operation;
    EXPECT_EQ(s.evaluated, 1'078'530'011 / 4001 + 1) << s.operation;
    EXPECT_FALSE(s.failed()) << s.operation << ' ' << s.max_eps;
    EXPECT_GT(s.max_eps, s.limit / 8) << s.operation;
    EXPECT_EQ(slice_error(s.operation, s.max_at, s.axis, s.rho), s.max_eps) << s.operation;
  }
}

TEST(Slices, ABudgetBelowASliceFails) {
  Slice s;
  s.max_eps = 1.5, s.limit = 1.4;
  EXPECT_TRUE(s.failed());
  s.max_eps = std::nan("");
  EXPECT_TRUE(s.failed());
  SliceOptions options;
  options.operations = {"exp7"};
  EXPECT_THROW(sweep_slices(options), std::invalid_argument);
}

}  // namespace
}  // namespace liecheck::properties
