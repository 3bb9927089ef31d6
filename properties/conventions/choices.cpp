#include <conventions/choices.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <oracles/orientations.hpp>

namespace liecheck::properties::conventions {
namespace {

using std::numbers::pi;
using Numbers4 = Eigen::Vector4d;

constexpr std::string_view of_sign = "quaternion sign", of_range = "angle range", of_lock = "gimbal lock",
                           of_half_turn = "half turn", of_norm = "quaternion norm",
                           of_shadow = "modified Rodrigues parameters";

bool one_of(const Operation& o, std::initializer_list<std::string_view> names) {
  return std::ranges::count(names, o.name) > 0;
}
Numbers4 four_of(std::span<const double> x, std::size_t from = 0) {
  return Eigen::Map<const Numbers4>(x.data() + from);
}

/// Whether the first and the last axis of Euler angles are the same.
bool has_equal_ends(double order) {
  const oracles::Order o(static_cast<int>(order));
  return o.axes[0] == o.axes[2];
}
Eigen::Quaterniond turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}
Numbers4 quaternion_of_angles(double order, std::span<const double> angles) {
  const oracles::Order o(static_cast<int>(order));
  Eigen::Quaterniond Q = Eigen::Quaterniond::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Quaterniond next = turn(angles[i], Eigen::Vector3d::Unit(o.axes[i]));
    Q = o.rotating ? Q * next : next * Q;
  }
  return Q.coeffs();
}

/// Whether the result of an operation has a quaternion, and where it begins.
bool gives_quaternion(const Operation& o, std::size_t* from) {
  const Kind k = kind_of(*o.results[0]);
  *from = k == Kind::configuration ? 3 : 0;
  return k == Kind::quaternion || k == Kind::configuration;
}
/// The quaternion from which the result does not jump to its opposite: of the stored numbers, and of a rotation vector the
/// one that begins at the identity. Zero if the operation has none.
Numbers4 begins_at(const Operation& o, std::span<const double> x) {
  if (o.name == "exp3_quaternion") {
    const Eigen::Vector3d phi(x[0], x[1], x[2]);
    return turn(phi.stableNorm(), phi.stableNormalized()).coeffs();
  }
  if (o.name == "euler_to_quaternion") return quaternion_of_angles(x[0], x.subspan(1));
  if (one_of(o, {"integrate", "integrate_any_norm"})) return four_of(x, 3);
  if (one_of(o, {"quaternion_from_axis_angle"}))
    return turn(x[3], Eigen::Vector3d(x[0], x[1], x[2])).coeffs();
  if (o.name == "quaternion_product") {
    const auto quaternion = [&](std::size_t at) {
      return Eigen::Quaterniond(x[at + 3], x[at], x[at + 1], x[at + 2]);
    };
    return (quaternion(0) * quaternion(4)).coeffs();
  }
  if (o.name == "quaternion_inverse") return Numbers4(-x[0], -x[1], -x[2], x[3]);
  if (one_of(o, {"interpolate"})) return four_of(x, 3);
  if (one_of(o, {"slerp", "normalize", "first_order_normalize", "mean_rotation", "geodesic_mean"}))
    return four_of(x);
  return Numbers4::Zero();
}

std::string broken_sign(std::string_view value, const Operation& o, std::span<const double> x,
                        std::span<const double> y, double epsilon) {
  std::size_t from;
  if (!gives_quaternion(o, &from)) return "";
  const Numbers4 Q = four_of(y, from);
  if (value == "w >= 0") return Q[3] < 0 ? fmt::format("w is {:.6g}", Q[3]) : "";
  const Numbers4 start = begins_at(o, x);
  const double product = start.dot(Q);
  return product < -8 * epsilon * start.norm() * Q.norm()
             ? fmt::format("the product with {} is {:.6g}",
                           one_of(o, {"exp3_quaternion", "euler_to_quaternion", "quaternion_from_axis_angle"})
                               ? "the product of half angles"
                           : one_of(o, {"quaternion_product", "quaternion_inverse"})
                               ? "the quaternion of its formula"
                               : "its input",
                           product)
             : "";
}

std::string broken_range(std::string_view value, const Operation& o, std::span<const double> y,
                         double epsilon) {
  const Kind k = kind_of(*o.results[0]);
  if (k == Kind::axis_angle) {  // -pi to pi: the shorter turn
    const double most = value == "-pi to pi" ? pi : 2 * pi, slack = 4 * epsilon * pi;
    return y[3] < -slack || y[3] > most + slack ? fmt::format("an angle is {:.6g}", y[3]) : "";
  }
  if (k != Kind::euler_angles && o.name != "twist_angle") return "";
  const double low = value == "-pi to pi" ? -pi : 0, slack = 4 * epsilon * pi;
  for (std::size_t i = 0; i < y.size(); i += 2)
    if (y[i] < low - slack || y[i] > low + 2 * pi + slack) return fmt::format("an angle is {:.6g}", y[i]);
  return "";
}

std::string broken_lock(std::string_view value, const Operation& o, std::span<const double> x,
                        std::span<const double> y, double epsilon) {
  if (kind_of(*o.results[0]) != Kind::euler_angles) return "";
  const auto is = [&](double angle) { return std::fabs(std::fabs(y[1]) - angle) <= epsilon * angle / 2; };
  if (has_equal_ends(x[0]) ? !is(0) && !is(pi) : !is(pi / 2)) return "";
  const bool first = value == "first is 0";
  const double zero = first ? y[0] : y[2];
  return zero != 0 ? fmt::format("the {} angle is {:.6g} where the middle one is {:.6g}",
                                 first ? "first" : "last", zero, y[1])
                   : "";
}

std::string broken_half_turn(std::string_view value, const Operation& o, std::span<const double> x,
                             std::span<const double> y) {
  const Eigen::Map<const Eigen::Vector3d> v(x.data());
  const bool stored = value == "as stored";
  if (o.name == "slerp") {
    if (four_of(x).dot(four_of(x, 4)) != 0) return "";
    const double product = four_of(y).dot(four_of(x, 4));
    return stored && product < 0 ? fmt::format("the product with Q1 is {:.6g}", product) : "";
  }
  if (o.name == "twist_angle") {
    const double along = v.dot(Eigen::Map<const Eigen::Vector3d>(x.data() + 4));
    if (x[3] != 0 || along == 0) return "";
    return y[0] < 0 && (!stored || along > 0)  ? fmt::format("the angle is {:.6g}", y[0])
           : y[0] > 0 && (stored && along < 0) ? fmt::format("the angle is {:.6g}", y[0])
                                               : "";
  }
  const bool of_quaternion = one_of(o, {"log3_quaternion", "log3_any_norm"});
  if (of_quaternion ? x[3] != 0
                    : o.name != "log3_matrix" || x[1] != x[3] || x[2] != x[6] || x[5] != x[7] ||
                          !(x[0] + x[4] + x[8] < 0))
    return "";
  const Eigen::Map<const Eigen::Vector3d> phi(y.data());
  if (stored) return of_quaternion && v.dot(phi) < 0 ? "phi is opposite to the stored numbers" : "";
  for (std::size_t i = 0; i < 3; ++i)
    if (const std::size_t k = value == "first number positive" ? i : 2 - i; y[k] != 0)
      return y[k] < 0 ? fmt::format("phi[{}] is {:.6g}", k, y[k]) : "";
  return "";
}

std::string broken_shadow(std::string_view value, const Operation& o, std::span<const double> x,
                          std::span<const double> y, double epsilon) {
  if (o.name != "mrp_from_quaternion") return "";
  const Eigen::Map<const Eigen::Vector3d> v(x.data()), s(y.data());
  if (value == "at most 1")
    return s.norm() > 1 + 16 * epsilon ? fmt::format("their length is {:.6g}", s.norm()) : "";
  return v.dot(s) < 0 ? fmt::format("their product with the vector part is {:.6g}", v.dot(s)) : "";
}

std::string broken_norm(std::string_view value, const Operation& o, std::span<const double> x,
                        std::span<const double> y, double epsilon) {
  if (o.name != "integrate") return "";
  const double is = four_of(y, 3).norm(), due = value == "1" ? 1 : four_of(x, 3).norm();
  return std::fabs(is / due - 1) > 16 * epsilon
             ? fmt::format("|Q1| is {:.9g}, and |Q0| is {:.9g}", is, four_of(x, 3).norm())
             : "";
}

}  // namespace

const std::vector<Choice>& choices() {
  static const std::vector<Choice> all{
      {of_sign, {"continuous", "w >= 0", free_choice}},
      {of_range, {"-pi to pi", "0 to 2 pi", free_choice}},
      {of_lock, {"first is 0", "last is 0", free_choice}},
      {of_half_turn, {"as stored", "first number positive", "last number positive", free_choice}},
      {of_norm, {"1", "kept", free_choice}},
      {of_shadow, {"at most 1", "as stored", free_choice}}};
  return all;
}

const Choice* choice_named(std::string_view name) {
  const auto at = std::ranges::find(choices(), name, &Choice::name);
  return at == choices().end() ? nullptr : &*at;
}

std::string broken_choice(std::string_view choice, std::string_view value, const Operation& o,
                          std::span<const double> x, std::span<const double> y, double epsilon) {
  if (value == free_choice || y.empty()) return "";
  if (choice == of_sign) return broken_sign(value, o, x, y, epsilon);
  if (choice == of_range) return broken_range(value, o, y, epsilon);
  if (choice == of_lock) return broken_lock(value, o, x, y, epsilon);
  if (choice == of_half_turn) return broken_half_turn(value, o, x, y);
  if (choice == of_shadow) return broken_shadow(value, o, x, y, epsilon);
  return broken_norm(value, o, x, y, epsilon);
}

template <class S>
std::vector<Numbers> choice_arguments(const Operation& o) {
  std::vector<Numbers> all;
  const auto add = [&](const auto&... parts) {
    Numbers x;
    ((x.insert(x.end(), parts.begin(), parts.end())), ...);
    for (double& number : x) number = static_cast<S>(number);
    all.push_back(x);
  };
  using Four = std::array<double, 4>;
  using Three = std::array<double, 3>;
  const double off = 1 + std::sqrt(std::numeric_limits<S>::epsilon());
  const Three p{0.5, -0.25, 1};
  const Four halves[] = {{.5, .5, .5, .5},  {-.5, .5, .5, .5},  {.5, -.5, .5, .5},  {.5, .5, -.5, .5},
                         {.5, .5, .5, -.5}, {-.5, -.5, .5, .5}, {.5, -.5, -.5, .5}, {-.5, .5, -.5, .5},
                         {.6, 0, 0, .8},    {0, .6, 0, .8},     {0, 0, .6, .8},     {0, 1, 0, 0},
                         {0, 0, 1, 0},      {1, 0, 0, 0},       {.1, -.3, .3, -.9}, {-.1, .7, .5, -.5},
                         {.5, -.1, .7, .5}};
  const Four turns[] = {{.6, .8, 0, 0}, {-.6, .8, 0, 0}, {-.6, -.8, 0, 0}, {0, -1, 0, 0}, {0, 0, 1, 0}};
  const auto matrix = [](const Four& Q) {
    const Eigen::Matrix3d R = Eigen::Quaterniond(Q[3], Q[0], Q[1], Q[2]).toRotationMatrix().transpose();
    std::array<double, 9> rows;  // Eigen stores columns
    std::ranges::copy(R.reshaped(), rows.begin());
    return rows;
  };
  if (o.name == "exp3_quaternion")
    for (const double angle : {0.3, 2.1, 3.5, 5.0}) add(Three{angle, 0, 0}, Three{}), all.back().resize(3);
  if (o.name == "integrate")
    for (const double w : {0.8, -0.8})
      for (const double scale : {1.0, off}) {
        add(p, Four{0, 0.6 * scale, 0, w * scale}, p, Three{0.1, 0, 0.2});
      }
  if (one_of(o, {"normalize", "first_order_normalize"}))
    for (const double w : {0.8, -0.8}) add(Four{0, 0.6, 0, w});
  if (o.name == "slerp") {
    for (const double w : {0.8, -0.8}) add(Four{0, 0.6, 0, w}, Four{0.6, 0, 0, w}, std::array{0.25});
    for (const Four& Q : turns) add(Four{0, 0, 0, 1}, Q, std::array{0.5});
  }
  if (one_of(o, {"axis_angle_from_quaternion", "mrp_from_quaternion", "quaternion_inverse"}))
    for (const Four& Q : halves)
      if (Q[3] != 0) add(Q);
  if (o.name == "quaternion_product")
    for (const Four& Q : halves) add(Q, Four{0, 0.6, 0, -0.8});
  if (one_of(o, {"quaternion_from_matrix", "axis_angle_from_matrix"}))
    for (const Four& Q : halves)
      if (Q[3] != 0) add(matrix(Q));
  if (o.name == "quaternion_from_axis_angle")
    for (const double angle : {0.3, 2.1, -0.3, -2.1}) add(Three{1, 0, 0}, std::array{angle});
  if (one_of(o, {"mean_rotation", "geodesic_mean"}))
    for (const double w : {0.8, -0.8})
      add(Four{0, 0.6, 0, w}, Four{0.6, 0, 0, 0.8}, Four{0, 0, 0, 1}, Three{1, 1, 1});
  if (o.name == "interpolate")
    for (const double w : {0.8, -0.8}) add(p, Four{0, 0.6, 0, w}, p, Four{0.6, 0, 0, 0.8}, std::array{0.25});
  if (o.name == "rotation_between")
    add(Three{1, 0, 0}, Three{0, 1, 0}), add(Three{1, 0, 0}, Three{-.8, .6, 0});
  if (o.name == "twist_angle") {
    for (const Four& Q : turns) add(Q, Three{Q[0], Q[1], Q[2]}), add(Q, Three{-Q[0], -Q[1], -Q[2]});
    for (const Four& Q : halves)
      if (Q[3] != 0) add(Q, Three{0, 1, 0});
  }
  if (one_of(o, {"log3_quaternion", "log3_any_norm"}))
    for (const Four& Q : turns) add(Q);
  if (o.name == "log3_matrix")
    for (const Four& Q : turns) add(matrix(Q));
  for (int order = 0; order < 24; ++order) {
    const std::array number{double(order)};
    if (o.name == "euler_to_quaternion") add(number, Three{3, 1, 2.5}), add(number, Three{-3, 0.2, 3});
    if (one_of(o, {"euler_from_quaternion", "euler_from_matrix"}))
      for (const Four& Q : halves) o.name == "euler_from_matrix" ? add(number, matrix(Q)) : add(number, Q);
  }
  return all;
}
template std::vector<Numbers> choice_arguments<float>(const Operation&);
template std::vector<Numbers> choice_arguments<double>(const Operation&);

std::vector<Finding> choices_made(const std::vector<Probed>& all,
                                  const std::map<std::string, std::string>& stated, double epsilon) {
  std::vector<Finding> findings;
  for (const Choice& c : choices()) {
    const auto statement = stated.find(std::string(c.name));
    const auto keeps = [&](const Probed& p, std::string_view value) {
      return std::ranges::all_of(p.answers, [&](const Answer& a) {
        return broken_choice(c.name, value, *p.operation, a.arguments, a.result, epsilon).empty();
      });
    };
    std::vector<std::string> decided;                 // operations whose answers tell the values apart
    std::vector<std::string_view> values = c.values;  // what all of them keep to
    std::vector<std::string_view> common = c.values;  // what those keep to that can choose the first value
    std::vector<std::string> each;
    for (const Probed& p : all) {
      std::vector<std::string_view> kept;
      std::ranges::copy_if(c.values, std::back_inserter(kept), [&](auto v) { return keeps(p, v); });
      if (kept.size() == c.values.size()) continue;
      if (p.operation->name == "log3_matrix") std::erase(kept, "as stored");  // a matrix stores no axis
      decided.emplace_back(p.operation->name);
      each.push_back(fmt::format("\"{}\" in {}", kept.front(), p.operation->name));
      const auto others = [&](auto v) { return std::ranges::count(kept, v) == 0; };
      std::erase_if(values, others);
      if (p.operation->name != "log3_matrix") std::erase_if(common, others);
    }
    if (decided.empty() || statement != stated.end()) continue;
    const std::string_view value = values.front();
    const bool differ = value == free_choice && std::ranges::any_of(each, [](const std::string& e) {
                          return !e.starts_with("\"free\"");
                        });
    findings.push_back(
        {false,
         differ ? fmt::format("choice \"{}\": {}; all are right", c.name, fmt::join(each, ", "))
                : fmt::format("choice \"{}\": \"{}\" in {}; all choices are right, and an adapter that "
                              "states one is held to it",
                              c.name, value, fmt::join(decided, ", ")),
         decided, true,
         (!differ || common.front() != free_choice) && (value == c.values.front() || value == free_choice)});
  }
  return findings;
}

}  // namespace liecheck::properties::conventions
