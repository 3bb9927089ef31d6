#include <failures/alternatives.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <conventions/probe.hpp>
#include <conventions/reference.hpp>
#include <failures/calls.hpp>

namespace liecheck::properties {

namespace {

using Numbers = std::vector<double>;
using Values = Eigen::VectorXd;
using Mat3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Numbers of the arguments.
Values given(const Numbers& x, std::size_t from, Eigen::Index size) {
  return Eigen::Map<const Values>(&x.at(from), size);
}
Eigen::Quaterniond given_quaternion(const Numbers& x, std::size_t from) {
  return Eigen::Quaterniond(Eigen::Vector4d(given(x, from, 4)));
}
/// Q1, or -Q1, whichever is nearer to Q0.
Values nearer(const Numbers& x) {
  const Values a = given(x, 0, 4), b = given(x, 4, 4);
  return a.dot(b) < 0 ? Values(-b) : b;
}
Values along_the_arc(const Values& a, const Values& b, double t) {
  const double angle = std::atan2((a - b).norm() * (a + b).norm() / 2, a.dot(b));
  return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}
Values of_oracle(const char* name, const Values& arguments) {
  std::vector<oracles::Real> x(arguments.begin(), arguments.end());
  const auto result = conventions::exact_result(conventions::operation_named(name), x);
  Values all(static_cast<Eigen::Index>(result.size()));
  for (Eigen::Index i = 0; i < all.size(); ++i)
    all[i] = static_cast<double>(result[static_cast<std::size_t>(i)]);
  return all;
}

/// A formula that libraries have in place of the right one, for some numbers of the result.
struct Alternative {
  const char* operation;
  Eigen::Index from, size;
  Values (*result)(const Numbers& arguments);
  const char* text;
};
const Alternative alternatives[] = {
    {"slerp", 0, 4,
     [](const Numbers& x) -> Values { return ((1 - x[8]) * given(x, 0, 4) + x[8] * nearer(x)).normalized(); },
     "linear interpolation, normalised, in place of slerp: its angle is not t times that between Q0 and Q1"},
    {"slerp", 0, 4, [](const Numbers& x) -> Values { return (1 - x[8]) * given(x, 0, 4) + x[8] * nearer(x); },
     "linear interpolation, which is not normalised, in place of slerp"},
    {"slerp", 0, 4,
     [](const Numbers& x) -> Values { return along_the_arc(given(x, 0, 4), given(x, 4, 4), x[8]); },
     "the longer way is taken where Q0 . Q1 < 0: -Q1 is the same rotation, and nearer"},
    {"inverse", 9, 3,
     [](const Numbers& x) -> Values { return -Mat3(given(x, 0, 9).data()) * given(x, 9, 3); },
     "the translation is -R p in place of -R^T p"},
    {"inverse", 9, 3, [](const Numbers& x) -> Values { return -given(x, 9, 3); },
     "the translation is -p in place of -R^T p"},
    {"difference", 0, 3,
     [](const Numbers& x) -> Values {
       return given_quaternion(x, 3).conjugate() * Eigen::Vector3d(given(x, 7, 3) - given(x, 0, 3));
     },
     "the translation of the relative pose in place of the linear part of its logarithm"},
    {"difference", 0, 3,
     [](const Numbers& x) -> Values {
       const Values J =
           of_oracle("left_jacobian3_inverse",
                     of_oracle("log3_quaternion",
                               (given_quaternion(x, 3).conjugate() * given_quaternion(x, 10)).coeffs()));
       return Mat3(J.data()) * Eigen::Vector3d(given(x, 7, 3) - given(x, 0, 3));
     },
     "p1 - p0 is not turned into the frame of q0"},
};

/// Whether an alternative gives the results of four of five calls that are wrong, to a hundredth of their errors.
bool gives_results(const Alternative& one, const std::vector<std::pair<NotedCall, Values>>& wrong) {
  std::size_t explained = 0;
  for (const auto& [call, right] : wrong) {
    const Values got = Eigen::Map<const Values>(call.result.data(), right.size()).segment(one.from, one.size);
    const Values other = one.result(call.arguments);
    const double error = (got - right.segment(one.from, one.size)).norm(), apart = (got - other).norm();
    explained += std::min(apart, one.size == 4 ? (got + other).norm() : apart) < 0.01 * error;
  }
  return wrong.size() >= 5 && 10 * explained >= 8 * wrong.size();
}

}  // namespace

std::string alternative_of(const FailedBlock& f) try {
  const BandOf& b = *f.worst;
  const Output& output = b.series->outputs.at(b.output);
  const auto of_operation = [&](const Alternative& one) {
    return output.record && one.operation == output.record->name;
  };
  if (std::ranges::none_of(alternatives, of_operation)) return "";
  constexpr std::uint64_t any_seed = 42, cases = 300;
  std::vector<std::pair<NotedCall, Values>> wrong;
  for (std::uint64_t i = 0; i < cases; ++i)
    for (NotedCall& call : noted(*b.series, b.series->id(any_seed, i), b.output).calls) {
      if (call.operation != output.record || !call.thrown.empty() || call.result.empty()) continue;
      const auto expected = expected_of(call);
      if (expected.size() != call.result.size()) continue;
      Values right(static_cast<Eigen::Index>(expected.size()));
      double error = 0, opposite = 0;
      for (Eigen::Index k = 0; k < right.size(); ++k) {
        const auto at = static_cast<std::size_t>(k);
        right[k] = static_cast<double>(expected[at]);
        error = std::hypot(error, call.result[at] - right[k]),
        opposite = std::hypot(opposite, call.result[at] + right[k]);
      }
      if (right.size() == 4 && opposite < error) right = -right, error = opposite;
      if (error > 1e-6 * right.norm()) wrong.emplace_back(std::move(call), right);
    }
  for (const Alternative& one : alternatives)
    if (of_operation(one) && gives_results(one, wrong)) return one.text;
  return "";
} catch (const std::exception&) {  // the oracle does not know these arguments
  return "";
}

}  // namespace liecheck::properties
