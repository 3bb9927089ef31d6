#include <failures/lost_digits.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <failures/part_changes.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

template <class S>
using Values = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// The numbers of a quaternion with w >= 0.
template <class S>
struct Rotation {
  explicit Rotation(const Values<S>& x) : v(x.template head<3>()), w(x[3]) {
    if (w < 0) v = -v, w = -w;
    w = std::min(w, S(1));
  }
  S from_cosine() const { return 2 * std::acos(w); }
  S sine() const { return std::sqrt(1 - w * w); }
  Eigen::Matrix<S, 3, 1> v;
  S w;
};
template <class S>
Values<S> axis_and_angle(const Eigen::Matrix<S, 3, 1>& axis, S angle) {
  Values<S> x(4);
  x << axis, angle;
  return x;
}
/// The weighted sum of a and b, n numbers each at x, for an angle and its sine.
template <class S>
Values<S> interpolated(const Values<S>& x, Eigen::Index n, S sign, S angle, S sine) {
  const S t = x[2 * n];
  return (std::sin((1 - t) * angle) * x.head(n) + sign * std::sin(t * angle) * x.segment(n, n)) / sine;
}
template <class S>
S cosine_between(const Values<S>& x, Eigen::Index n) {
  return std::clamp(x.head(n).dot(x.segment(n, n)), S(-1), S(1));
}

constexpr const char* of_acos =
    "acos near 1, which keeps half of the digits: the error grows as 1 / theta^2; atan2 of both parts does "
    "not";
constexpr const char* of_acos_and_root =
    "acos(w) and sqrt(1 - w^2) near w = 1, which keep half of the digits: |v| and atan2(|v|, w) keep all";
constexpr const char* of_root =
    "1 - w^2 cancels as theta goes to 0, in sqrt(1 - w^2) for |v|, for example: |v| keeps all digits";
constexpr const char* of_dot =
    "theta is acos of the dot product, which keeps half of the digits near theta = 0 and pi; atan2 of both "
    "parts does not";
constexpr const char* of_one_minus_cosine =
    "1 - cos(theta) cancels, and is 0 below theta about 1.5e-8 in double: 2 sin(theta / 2)^2 keeps all "
    "digits";

/// The formulas of an operation in one scalar.
template <class S>
struct Formula {
  const char* operation;
  Values<S> (*result)(const Values<S>& arguments);
  const char* text;
  double worst = 0;  ///< what share of its result one error must be: without a cutoff, one loses all digits
};
template <class S>
const Formula<S> formulas[] = {
    {"log3_quaternion",
     [](const Values<S>& x) -> Values<S> {
       const Rotation<S> Q(x);
       return Q.from_cosine() / Q.v.norm() * Q.v;
     },
     of_acos},
    {"log3_quaternion",
     [](const Values<S>& x) -> Values<S> {
       const Rotation<S> Q(x);
       return Q.from_cosine() / Q.sine() * Q.v;
     },
     of_acos_and_root},
    {"log3_quaternion",
     [](const Values<S>& x) -> Values<S> {
       const Rotation<S> Q(x);
       return 2 * std::atan2(Q.sine(), Q.w) / Q.sine() * Q.v;
     },
     of_root},
    {"axis_angle_from_quaternion",
     [](const Values<S>& x) -> Values<S> {
       const Rotation<S> Q(x);
       return axis_and_angle<S>(Q.v / Q.sine(), Q.from_cosine());
     },
     of_acos_and_root},
    {"axis_angle_from_quaternion",
     [](const Values<S>& x) -> Values<S> {
       const Rotation<S> Q(x);
       return axis_and_angle<S>(Q.v.normalized(), Q.from_cosine());
     },
     of_acos},
    {"axis_angle_from_quaternion",
     [](const Values<S>& x) -> Values<S> {
       const Rotation<S> Q(x);
       return axis_and_angle<S>(Q.v / Q.sine(), 2 * std::atan2(Q.v.norm(), Q.w));
     },
     of_root},
    {"slerp",
     [](const Values<S>& x) -> Values<S> {
       const S dot = cosine_between(x, 4), cosine = std::fabs(dot), angle = std::acos(cosine);
       return interpolated<S>(x, 4, dot < 0 ? S(-1) : S(1), angle, std::sqrt(1 - cosine * cosine));
     },
     of_dot},
    {"slerp_directions",
     [](const Values<S>& x) -> Values<S> {
       const S angle = std::acos(cosine_between(x, 3));
       return interpolated<S>(x, 3, 1, angle, std::sin(angle));
     },
     of_dot},
    {"slerp_directions",
     [](const Values<S>& x) -> Values<S> {
       const S cosine = cosine_between(x, 3);
       return interpolated<S>(x, 3, 1, std::acos(cosine), std::sqrt(1 - cosine * cosine));
     },
     of_dot},
    {"se2_log",
     [](const Values<S>& x) -> Values<S> {
       const S angle = std::atan2(x[3], x[2]), a = angle * std::sin(angle) / (2 * (1 - std::cos(angle)));
       return Eigen::Matrix<S, 3, 1>(a * x[0] + angle / 2 * x[1], a * x[1] - angle / 2 * x[0], angle);
     },
     of_one_minus_cosine, 0.05},
    {"se2_exp",
     [](const Values<S>& x) -> Values<S> {
       const S angle = x[2], a = std::sin(angle) / angle, b = (1 - std::cos(angle)) / angle;
       Values<S> pose(4);
       pose << a * x[0] - b * x[1], b * x[0] + a * x[1], std::cos(angle), std::sin(angle);
       return pose;
     },
     of_one_minus_cosine, 0.05}};

template <class S>
Values<S> in_scalar(const Numbers& x) {
  return Eigen::Map<const Values<double>>(x.data(), std::ssize(x)).cast<S>();
}

/// The text of the formula that errs, to a twentieth of the error, as five results do that have lost three digits or more,
/// and half of all that have: below a cutoff there may be another formula.
template <class S>
std::string formula_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  for (const Formula<S>& one : formulas<S>) {
    if (operation.name != one.operation) continue;
    std::size_t explained = 0, wrong = 0;
    double worst = 0;
    for (const auto& [call, right_numbers] : calls) {
      const Values<double> right = in_scalar<double>(right_numbers), got = in_scalar<double>(call.result);
      const double error = (got - right).norm();
      // A result of 0 may be that of a threshold.
      if (!(error > 1e3 * std::numeric_limits<S>::epsilon() * right.norm()) || got.isZero(0)) continue;
      const Values<double> other = one.result(in_scalar<S>(call.arguments)).template cast<double>();
      ++wrong;
      if (!((got - other).norm() < 0.05 * error)) continue;
      ++explained, worst = std::max(worst, error / right.norm());
    }
    if (explained >= 5 && 2 * explained >= wrong && worst >= one.worst) return one.text;
  }
  return "";
}

}  // namespace

bool has_lost_digits(std::string_view operation) {
  return std::ranges::find(formulas<double>, operation, &Formula<double>::operation) !=
         std::end(formulas<double>);
}

std::string lost_digits_of(const Operation& operation, const std::vector<JudgedCall>& calls, bool is_float) {
  return is_float ? formula_of<float>(operation, calls) : formula_of<double>(operation, calls);
}

}  // namespace liecheck::properties
