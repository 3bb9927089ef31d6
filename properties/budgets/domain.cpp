#include <budgets/domain.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace liecheck::properties {

namespace {

/// In the order of Quantity. The joints' quantities have no unit of their own, and a norm has none.
constexpr std::array<std::string_view, 12> units = {"rad", "m",      "m/s", "rad/s", "N", "N m",
                                                    "kg",  "kg m^2", "",    "",      "",  ""};
static_assert(units.size() == static_cast<std::size_t>(Quantity::quaternion_norm) + 1);

template <class F>
bool any_part(const Few<const Layout*, 6>& arguments, F f) {
  for (const Layout* l : arguments)
    for (const Part& p : l->parts)
      if (f(p)) return true;
  return false;
}
bool has_part(const Operation& o, std::string_view name) {
  return any_part(o.arguments, [&](const Part& p) { return p.name == name; });
}
/// Whether the operation belongs to a robot or a tree, whose sizes its arguments have.
bool of_joints(const Operation& o) {
  return any_part(o.arguments, [](const Part& p) { return p.size < 0; });
}
bool returns_angle(const Operation& o) {
  for (const Layout* l : o.results)
    for (const Part& p : l->parts)
      if (p.unit == "rad") return true;
  return false;
}
/// Whether it is an operation on two configurations, such as difference.
bool compares(const Operation& o) {
  return (has_part(o, "Q0") && has_part(o, "Q1")) || (has_part(o, "q0") && has_part(o, "q1"));
}

/// "v" of the field v3_u of a tree; "q0" of the field q0_7 of a robot.
std::string stem_of(const Operation& o, const std::string& field) {
  std::string stem = field.substr(0, field.find('_'));
  if (!has_part(o, stem)) stem = stem.substr(0, stem.find_first_of("0123456789"));
  return stem;
}

bool is_quaternion(Kind kind) {
  return kind == Kind::quaternion || kind == Kind::any_quaternion;
}

/// Whether an operation takes a field of a law's input.
bool takes_field(const Operation& o, const Field& f) {
  if (has_part(o, f.name) || (f.name == "theta" && has_part(o, "phi"))) return true;
  if (!of_joints(o)) return false;
  static const std::array<std::string_view, 6> arguments = {"q", "v", "a", "d", "force", "moment"};
  const std::string stem = stem_of(o, f.name);
  const bool argument = std::find(arguments.begin(), arguments.end(), stem) != arguments.end();
  return has_part(o, stem) || (!argument && !has_part(o, "q0"));  // or else it describes the tree
}

bool is(Quantity q, const Operation& o, const Field& f) {
  const std::string stem = stem_of(o, f.name);
  switch (q) {
    case Quantity::angle:
      return f.kind == Kind::rotation_vector || f.name == "theta";
    case Quantity::joint_position:
      return f.unit == "m, rad" || f.unit == "m or rad";
    case Quantity::joint_velocity:
      return f.unit == "m, rad, s" && stem == "v";
    case Quantity::joint_acceleration:
      return f.unit == "m, rad, s" && stem == "a";
    case Quantity::quaternion_norm:
      return f.kind == Kind::any_quaternion;
    default:
      return f.unit == units[static_cast<std::size_t>(q)];
  }
}

double norm(const double* x, std::size_t n) {
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(x[i]));
  if (!(largest > 0) || std::isinf(largest)) return largest;
  for (std::size_t i = 0; i < n; ++i) {
    const double scaled = x[i] / largest;
    sum += scaled * scaled;
  }
  return largest * std::sqrt(sum);
}

using Four = std::array<double, 4>;
Four four(const double* x) {
  return {x[0], x[1], x[2], x[3]};
}
/// a b - c d, without cancellation of the rounding errors of the products (Kahan).
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) - std::fma(c, d, -cd);
}
/// The angle of a* b.
double angle_between(const Four& a, const Four& b) {
  std::array<double, 3> v{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    v[i] = difference_of_products(a[3], b[i], b[3], a[i]) - difference_of_products(a[j], b[k], a[k], b[j]);
  }
  const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  return 2 * std::atan2(norm(v.data(), 3), std::fabs(w));
}
double angle_of_matrix(const double* R) {
  const auto at = [R](std::size_t i) { return R[i]; };
  const double axis[] = {(at(7) - at(5)) / 2, (at(2) - at(6)) / 2, (at(3) - at(1)) / 2};
  return std::atan2(norm(axis, 3), (at(0) + at(4) + at(8) - 1) / 2);
}

}  // namespace

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names = {
      "angle",   "translation",    "linear velocity", "angular velocity",  "force", "moment", "mass",
      "inertia", "joint position", "joint velocity",  "joint acceleration", "quaternion norm"};
  return names;
}

bool takes(const Operation& o, Quantity q) {
  if (q == Quantity::quaternion_norm)
    return o.name.ends_with("_any_norm") || o.name.ends_with("normalize");
  if (of_joints(o)) return q != Quantity::linear_velocity && q != Quantity::angular_velocity;
  if (q == Quantity::angle && (returns_angle(o) || compares(o))) return true;
  const std::string_view unit = units[static_cast<std::size_t>(q)];
  return !unit.empty() && any_part(o.arguments, [&](const Part& p) { return p.unit == unit; });
}

Domain::Domain(const std::vector<DomainBound>& bounds, const std::vector<Field>& fields,
               const std::vector<Output>& outputs) {
  const auto groups_of = [&](const Operation& o, auto wanted) {
    std::vector<Group> groups;
    std::size_t from = 0;
    for (const Field& f : fields) {
      const auto size = static_cast<std::size_t>(f.size);
      if (takes_field(o, f) && wanted(f)) groups.push_back({f.kind, from, size});
      from += size;
    }
    return groups;
  };
  for (const Output& output : outputs) {
    const Operation& o = *output.record;
    auto& angle =
        angles_.emplace_back(groups_of(o, [&](const Field& f) { return is(Quantity::angle, o, f); }));
    if (angle.empty() && (returns_angle(o) || compares(o))) {
      angle = groups_of(o, [](const Field& f) { return is_quaternion(f.kind); });
      if (angle.empty()) angle = groups_of(o, [](const Field& f) { return f.kind == Kind::rotation_matrix; });
    }
    for (const DomainBound& b : bounds) {
      if (b.operation ? b.operation != &o
                      : std::any_of(bounds.begin(), bounds.end(), [&](const DomainBound& other) {
                          return other.operation == &o && other.quantity == b.quantity &&
                                 other.lower == b.lower;
                        }))
        continue;
      const bool turned = b.quantity == Quantity::angle;
      auto groups = turned ? angle : groups_of(o, [&](const Field& f) { return is(b.quantity, o, f); });
      if (!groups.empty())
        tests_.push_back({b.bound, b.lower, turned, std::move(groups), angles_.size() - 1});
    }
  }
}

namespace {

/// The angle of rotation vectors or matrices, or between the quaternions of two configurations; of the latter the second
/// has none.
template <class Groups>
double angle_of(const std::vector<double>& x, const Groups& groups, std::size_t i) {
  const std::size_t n = groups.size();
  const auto& g = groups[i];
  const double* at = x.data() + g.from;
  if (is_quaternion(g.kind) && n > 1)
    return i < n / 2 ? angle_between(four(at), four(x.data() + groups[i + n / 2].from)) : 0;
  if (is_quaternion(g.kind)) return angle_between({0, 0, 0, 1}, four(at));
  if (g.kind == Kind::rotation_matrix) return angle_of_matrix(at);
  return g.size == 2 ? std::max(norm(at, 1), norm(at + 1, 1)) : norm(at, g.size);
}

}  // namespace

bool Domain::Test::excludes(const std::vector<double>& x) const {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const double size = angle ? angle_of(x, groups, i) : norm(x.data() + groups[i].from, groups[i].size);
    if (lower ? size > 0 && size < bound : !(size <= bound)) return true;
  }
  return false;
}

std::vector<bool> Domain::outside(const std::vector<double>& x) const {
  std::vector<bool> all(angles_.size(), false);
  for (const Test& t : tests_)
    if (t.excludes(x)) all[t.output] = true;
  return all;
}

double Domain::angle(const std::vector<double>& x, std::size_t output) const {
  double largest = -1;
  for (std::size_t i = 0; i < angles_[output].size(); ++i)
    largest = std::max(largest, angle_of(x, angles_[output], i));
  return largest;
}

}  // namespace liecheck::properties
