#include <search/feature_names.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <operations/quaternion_poses.hpp>
#include <oracles/orientations.hpp>

namespace liecheck::properties {

const std::vector<FeatureName>& fixed_names() {
  using enum Written;
  static const std::vector<FeatureName> names{
      {Feature::trace, "trace(R)", "", sign, true},
      {Feature::fraction, "t", "", number},
      {Feature::lock, "the angle from gimbal lock", " rad", number},
      {Feature::revolute, "revolute joints", "revolute", count},
      {Feature::continuous, "continuous joints", "continuous", count},
      {Feature::prismatic, "prismatic joints", "prismatic", count},
      {Feature::helical, "helical joints", "helical", count},
      {Feature::spherical, "spherical joints", "spherical", count},
      {Feature::planar, "planar joints", "planar", count},
      {Feature::translation, "translation joints", "a translation", count},
      {Feature::free_flyer, "free-flyers", "a free-flyer", count},
      {Feature::mimics, "mimic joints", "a mimic", count},
      {Feature::armature, "a joint has an armature", "no joint has an armature", flag},
      {Feature::several_armature, "a joint of several velocities has an armature",
       "no joint of several velocities has an armature", flag},
      {Feature::several, "a joint has several velocities", "each joint has one velocity", flag},
      {Feature::turned_prismatic, "a prismatic joint is behind one that turns",
       "no prismatic joint is behind one that turns", flag},
      {Feature::inner_free_flyer, "a free-flyer is behind a joint", "no free-flyer is behind a joint", flag},
      {Feature::narrower, "a joint has fewer velocities than one before it",
       "no joint has fewer velocities than one before it", flag},
      {Feature::frame_depth, "joints up to the frame", "", count},
      {Feature::frame_off, "the frame is off its joint's origin", "the frame is at its joint's origin", flag},
      {Feature::gravity, "gravity is not (0, 0, -9.81)", "gravity is (0, 0, -9.81)", flag},
      {Feature::tilted_gravity, "gravity is not along z", "gravity is along z or 0", flag},
      {Feature::wrench, "a wrench acts", "no wrench acts", flag},
      {Feature::wrench_joint, "the number of the wrench's joint", "", count},
      {Feature::moves, "v is not 0", "v = 0", flag},
      {Feature::accelerates, "a is not 0", "a = 0", flag},
      {Feature::driven, "tau is not 0", "tau = 0", flag},
      {Feature::depth, "joints on the longest path", "", count},
      {Feature::joints, "joints", "", count},
      {Feature::shape, "the shape (0 chain, 1 star, 2 all on the world, 3 other)", "", count},
      {Feature::apart, "|p1 - p0| / |p0|", "", number},
      {Feature::off_unit, "| |Q|^2 - 1 |", " eps", number},
      {Feature::norm, "|Q|", "", number},
      {Feature::off_orthogonal, "|R^T R - I|", " eps", number},
      {Feature::along, "the cosine between the axis and the vector", "", number},
      {Feature::point, "the inertia is 0", "the inertia is not 0", flag},
      {Feature::moments_apart, "the smallest difference of moments of inertia, over the largest moment", "",
       number},
      {Feature::thin, "the smallest over the largest moment of inertia", "", number},
      {Feature::flat, "(I1 + I2 - I3) / I3 of the moments of inertia", "", number},
      {Feature::mass_ratio, "the ratio of masses", "", number},
      {Feature::position, "the largest number of q", "", number},
      {Feature::joint_speed, "the largest number of v", "", number},
      {Feature::drive, "the largest acceleration or torque", "", number},
      {Feature::length, "the longest vector", " m", scale, false, "", false, true},
      {Feature::speed, "the largest velocity", "", scale, false, "", false, true},
      {Feature::force, "the largest of force and moment", "", scale, false, "", false, true},
  };
  return names;
}

namespace {

/// Reads the arguments of a call: notes the values of the features, and, if wanted, their names.
class ArgumentReader {
 public:
  ArgumentReader(const Scalar& scalar, std::vector<FeatureName>* names, bool floating)
      : scalar_(scalar), names_(names), floating_(floating) {}
  std::vector<double> values;

  void add(const NumberFunction& f, const double* x) {
    for (const Layout* own : f.operation->arguments) {
      const Layout layout = f.quaternion_poses ? with_quaternion(*own) : *own;
      argument_ = layout.name;
      if (layout.parts.size() == 0) add_reference(*x++);
      for (const Part& part : layout.parts) {
        if (part.size > 0) add(part, x);
        if (part.size == nq) add_root(floating_ && f.model.nq >= 7 ? x + 3 : nullptr);
        if (part.size == 4 && part.unit == "1") add_quaternion(part, x);
        x += size_of(part, f.model);
      }
    }
  }

 private:
  template <class MakeName>
  void note(double value, Written written, MakeName&& name_and_unit, bool angle = false,
            bool negated = false) {
    values.push_back(value);
    if (!names_) return;
    const auto [name, unit] = name_and_unit();
    names_->push_back(FeatureName{Feature::one, name, unit, written, angle, argument_, negated});
  }
  using Pair = std::pair<std::string, std::string>;
  void flag(bool holds, auto&& name_and_unit, bool angle = false) {
    note(holds, Written::flag, name_and_unit, angle, true);
  }
  /// A flag of which both values tell something.
  void either(bool holds, auto&& name_and_unit) { note(holds, Written::flag, name_and_unit); }

  void add_reference(double seen) {
    constexpr const char* names[] = {"WORLD", "LOCAL", "LOCAL_WORLD_ALIGNED"};
    for (int k = 0; k < 3; ++k)
      flag(seen == k,
           [&] { return Pair(fmt::format("seen = {}", names[k]), fmt::format("seen is not {}", names[k])); });
  }
  /// Q of the free-flyer that is the first joint, or null: then it has no features.
  void add_root(const double* Q) {
    const std::size_t before = values.size();
    constexpr double none[4] = {};
    const Part part{"the root's Q", 3, "1"};
    argument_ = part.name;
    for (int i = 0; i < 3; ++i) add_number(part, i, (Q ? Q : none)[i]);
    add_vector(part, Q ? Q : none);
    note((Q ? Q : none)[3], Written::sign, [] { return Pair("the root's Q.w", ""); });
    if (!Q) std::fill(values.begin() + static_cast<std::ptrdiff_t>(before), values.end(), std::nan(""));
  }
  void add(const Part& part, const double* x) {
    argument_ = part.name;
    if (part.name == "order") return add_order(x[0]);
    if (part.name == "wrench_joint" || part.name == "t") return;  // search/features.hpp
    if (part.size == 9) return part.unit == "1" ? add_rotation(part, x) : add_inertia(part, x);
    for (int i = 0; i < part.size; ++i) add_number(part, i, x[i]);
    if (part.size == 3) add_vector(part, x);
    if (part.size == 1 || (part.size == 3 && part.unit != "rad"))
      note(scale_of(x, part.size), Written::scale, [&] { return Pair("|" + text(part) + "|", unit(part)); });
  }
  /// Euler angles have numbers, all else has x, y, z and w.
  static std::string component(const Part& part, int i) {
    if (part.size == 1) return text(part);
    if (part.size == 2 && part.unit == "1") return fmt::format("{}.{}", part.name, i == 0 ? "cos" : "sin");
    return part.size > 4 || part.name == "angles" ? fmt::format("{}[{}]", part.name, i)
                                                  : fmt::format("{}.{}", part.name, "xyzw"[i]);
  }
  static std::string text(const Part& part) { return std::string(part.name); }
  static std::string unit(const Part& part) { return part.unit == "1" ? "" : " " + std::string(part.unit); }
  double scale_of(const double* x, int n) const {
    long double sum = 0;
    for (int i = 0; i < n; ++i) sum += static_cast<long double>(x[i]) * x[i];
    const auto scale = static_cast<double>(std::log2(std::sqrt(sum)));
    // Rounding leaves the length of a unit vector in float within 8 eps of 1, which is 1e-6: it tells nothing.
    return std::fabs(scale) < 1e-5 ? 0 : scale / scalar_.max_exponent;
  }

  void add_number(const Part& part, int i, double x) {
    flag(x == 0, [&] {
      const std::string name = component(part, i);
      return Pair(name + " = 0", name + " is not 0");
    });
    note(x, Written::sign, [&] { return Pair(component(part, i), ""); });
    if (part.name == "angles")
      note(std::fabs(x), Written::number, [&] { return Pair("|" + component(part, i) + "|", " rad"); });
  }
  void add_quaternion(const Part& part, const double* Q) {
    add_octants(part, Q);
    const std::string vector = fmt::format("({}.x, {}.y, {}.z)", part.name, part.name, part.name);
    add_zeros(vector, Q);
    flag(Q[0] == 0 && Q[1] == 0 && Q[2] == 0, [&] { return Pair(vector + " = 0", vector + " is not 0"); });
    if (first_) {
      double product = 0;
      for (int i = 0; i < 4; ++i) product += first_[i] * Q[i];
      note(product, Written::sign, [&] { return Pair(fmt::format("{} . {}", first_name_, part.name), ""); });
    } else {
      first_ = Q, first_name_ = part.name;
    }
  }
  /// How many of three numbers are 0.
  void add_zeros(std::string_view vector, const double* x) {
    const int zeros = (x[0] == 0) + (x[1] == 0) + (x[2] == 0);
    flag(zeros == 1, [&] { return Pair(fmt::format("just one number of {} is 0", vector), ""); });
    flag(zeros == 2, [&] { return Pair(fmt::format("just two numbers of {} are 0", vector), ""); });
  }
  /// The signs of the first three numbers.
  void add_octants(const Part& part, const double* x) {
    for (int k = 0; k < 8; ++k) {
      const auto is = [&](int i) { return (x[i] < 0) == ((k >> i & 1) != 0); };
      const auto text = [&](int i) { return component(part, i) + (k >> i & 1 ? " < 0" : " >= 0"); };
      flag(is(0) && is(1) && is(2),
           [&] { return Pair(fmt::format("{}, {} and {}", text(0), text(1), text(2)), ""); });
    }
  }
  void add_vector(const Part& part, const double* x) {
    const bool zero[] = {x[0] == 0, x[1] == 0, x[2] == 0};
    const std::string c[] = {component(part, 0), component(part, 1), component(part, 2)};
    const bool all = zero[0] && zero[1] && zero[2], angles = part.name == "angles";
    flag(
        all, [&] { return Pair(text(part) + " = 0", text(part) + " is not 0"); }, part.unit == "rad");
    flag(zero[0] || zero[1] || zero[2], [&] {
      return Pair(fmt::format("a number of {} is 0", part.name),
                  fmt::format("no number of {} is 0", part.name));
    });
    flag(zero[0] + zero[1] + zero[2] >= 2,
         [&] { return Pair(fmt::format("two numbers of {} are 0", part.name), ""); });
    add_zeros(part.name, x);
    add_octants(part, x);
    for (int k = 2; k >= 0; --k) {
      const int i = k == 0 ? 1 : 0, j = k == 2 ? 1 : 2;
      flag(zero[i] && zero[j], [&] {
        return Pair(fmt::format("{} = {} = 0", c[i], c[j]), fmt::format("{} or {} is not 0", c[i], c[j]));
      });
      if (angles) continue;
      flag(std::fabs(x[k]) > std::fabs(x[i]) && std::fabs(x[k]) > std::fabs(x[j]), [&] {
        return Pair(fmt::format("|{}| is larger than |{}| and |{}|", c[k], c[i], c[j]),
                    fmt::format("|{}| is not the largest number of {}", c[k], part.name));
      });
    }
  }
  void add_rotation(const Part& part, const double* R) {
    const double trace = R[0] + R[4] + R[8], diagonal[] = {R[0], R[4], R[8], trace};
    for (int k = 0; k < 4; ++k) {
      if (k < 3)
        note(R[4 * k], Written::sign, [&] { return Pair(fmt::format("{}[{},{}]", part.name, k, k), ""); });
      bool largest = true;
      for (int i = 0; i < 4; ++i) largest = largest && (i == k || diagonal[k] > diagonal[i]);
      flag(
          largest,
          [&] {
            return k < 3 ? Pair(fmt::format("{}[{},{}] is larger than the rest of the diagonal and the trace",
                                            part.name, k, k),
                                fmt::format(
                                    "{}[{},{}] is not larger than the rest of the diagonal and the trace",
                                    part.name, k, k))
                         : Pair(fmt::format("the trace of {} is larger than its diagonal", part.name),
                                fmt::format("the trace of {} is not larger than its diagonal", part.name));
          },
          k == 3);
    }
  }
  void add_inertia(const Part& part, const double* I) {
    const double off = std::max({std::fabs(I[1]), std::fabs(I[2]), std::fabs(I[5])});
    flag(off == 0, [&] { return Pair(text(part) + " is diagonal", text(part) + " is not diagonal"); });
    note(off / (I[0] + I[4] + I[8]), Written::number, [&] {
      return Pair(fmt::format("the largest number of {} off its diagonal, over its trace", part.name), "");
    });
  }
  void add_order(double x) {
    const int number = static_cast<int>(x);
    either(number % 2 == 0, [] { return Pair("the order is static", "the order is rotating"); });
    const auto is_proper = [](const oracles::Order& o) { return o.axes[0] == o.axes[2]; };
    either(is_proper(oracles::Order(number)), [] {
      return Pair("the first axis of the order is its last", "the axes of the order are three (Tait-Bryan)");
    });
    const auto is_cyclic = [](const oracles::Order& o) { return (o.axes[1] - o.axes[0] + 3) % 3 == 1; };
    either(!is_cyclic(oracles::Order(number)), [] {
      return Pair("the first two axes of the order are not cyclic (XZ, YX, ZY)",
                  "the first two axes of the order are cyclic (XY, YZ, ZX)");
    });
    for (int k = 0; k < 24; k += 2) {
      const std::string axes = oracles::Order(k).name();
      flag(number / 2 == k / 2, [&] { return Pair("the order is " + axes, "the order is not " + axes); });
    }
  }

  const Scalar& scalar_;
  std::vector<FeatureName>* names_;
  bool floating_;
  const double* first_ = nullptr;  ///< the first quaternion
  std::string_view first_name_;
  std::string argument_;  ///< the part that is read
};

/// Two numbers with so many digits that they differ, at least two.
std::pair<std::string, std::string> different(double a, double b) {
  for (int digits = 2;; ++digits) {
    const std::string x = fmt::format("{:.{}g}", a, digits), y = fmt::format("{:.{}g}", b, digits);
    if (x != y || digits == 17) return {x, y};
  }
}

}  // namespace

std::vector<FeatureName> argument_names(const NumberFunction& function) {
  std::vector<FeatureName> names;
  const std::vector<double> zeros(count_numbers(function.operation->arguments, function.model) +
                                  64);  // poses may become shorter
  ArgumentReader(*function.scalar, &names, false).add(function, zeros.data());
  return names;
}

std::vector<double> argument_features(const NumberFunction& function, const std::vector<double>& arguments,
                                      bool floating) {
  ArgumentReader reader(*function.scalar, nullptr, floating);
  const std::vector<double> given =
      function.quaternion_poses
          ? poses_as_quaternions(*function.operation, arguments, function.scalar->is_float())
          : arguments;
  reader.add(function, given.data());
  return std::move(reader.values);
}

bool is_rounding(const FeatureName& name, double low, double high, bool in_bands) {
  const bool from_least = in_bands ? low < 16 : low < 1 && std::isinf(high);
  return name.unit == " eps" && (high < 1 || from_least);
}

std::string text_of(const FeatureName& name, double low, double high, const Scalar& scalar) {
  if (name.written == Written::flag) return low > 0 ? name.name : name.unit;
  const bool below = std::isinf(low), above = std::isinf(high);
  if (name.written == Written::count) {
    const double first = std::ceil(low), last = std::ceil(high) - 1;
    const bool of_joints = !name.unit.empty();
    if (of_joints && above && first == 1) return "a joint is " + name.unit;
    if (of_joints && !above && last == 0) return "no joint is " + name.unit;
    if (above) return fmt::format("{} >= {}", name.name, first);
    if (below) return fmt::format("{} <= {}", name.name, last);
    return first == last ? fmt::format("{} = {}", name.name, first)
                         : fmt::format("{} from {} to {}", name.name, first, last);
  }
  if (low == 0 && high == above_zero) return name.name + " = 0";
  if (high == above_log_of_zero) return name.name + " is 0";
  if (high == above_zero) return name.name + " <= 0";
  if ((low == above_zero || low == above_log_of_zero) && std::isinf(high)) return name.name + " > 0";
  const bool plain = name.unit == " eps" && (above ? low : high) * scalar.epsilon > 1e-10;
  const auto value = [&](double v) {
    return name.written == Written::scale ? std::exp2(v * scalar.max_exponent)
           : plain                        ? v * scalar.epsilon
                                          : v;
  };
  const std::string unit = plain ? "" : name.unit;
  if (below) return fmt::format("{} < {:.2g}{}", name.name, value(high), unit);
  const bool from_zero = low == above_zero || low == above_log_of_zero,
             from_rounding = name.written == Written::number && name.unit != " eps" && low > 0 &&
                             low < 128 * scalar.epsilon && low < 1e-6 * high;
  if ((from_zero || from_rounding) && !above && name.name.starts_with("the "))
    return fmt::format("{} < {:.2g}{} (not 0)", name.name, value(high), unit);
  if ((from_zero || from_rounding) && !above)
    return fmt::format("0 < {} < {:.2g}{}", name.name, value(high), unit);
  if (above) return fmt::format("{} >= {:.2g}{}", name.name, value(low), unit);
  const auto [from, to] = different(value(low), value(high));
  return fmt::format("{} from {}{} to {}{}", name.name, from, unit, to, unit);
}

}  // namespace liecheck::properties
