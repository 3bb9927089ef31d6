#pragma once
// The description of a scene as numbers, places and coordinates of the second formulation (independent.cpp).

#include <oracles/motions/contact_laws.hpp>
#include <oracles/motions/force_laws.hpp>
#include <oracles/motions/maximal_motion.hpp>
#include <scenes/benchmark.hpp>

namespace liecheck::properties {

using namespace oracles;
using Robot = Model<double>;

/// Throws std::invalid_argument with the entry of unconfirmed_parts().
[[noreturn]] void refuse(const std::string& effect, const std::string& part);

inline JointKind kind_of(const Robot& robot, std::size_t i) {
  const Joint<double>& j = robot.joints[i];
  if (std::holds_alternative<FreeFlyer<double>>(j)) return JointKind::free_flyer;
  if (std::holds_alternative<Revolute<double>>(j)) return JointKind::revolute;
  if (std::holds_alternative<Continuous<double>>(j)) return JointKind::continuous;
  if (std::holds_alternative<Prismatic<double>>(j)) return JointKind::prismatic;
  if (std::holds_alternative<Helical<double>>(j)) return JointKind::helical;
  if (std::holds_alternative<Spherical<double>>(j)) return JointKind::spherical;
  if (std::holds_alternative<Planar<double>>(j)) return JointKind::planar;
  if (std::holds_alternative<Translation<double>>(j)) return JointKind::translation;
  throw std::invalid_argument("joint '" + robot.names[i] + "' is a mimic, which maximal coordinates lack");
}

/// The numbers of a request as T.
template <class T>
class Values {
 public:
  Values(const scene::Parameters& p, const Benchmark& scene) : p_(p), scene_(scene) {}
  T number(const char* key) const { return T(p_.number(key)); }
  T number(const char* key, double otherwise) const { return T(p_.number(key, otherwise)); }
  /// Infinite if the key is missing.
  T limit(const char* key) const { return number(key, std::numeric_limits<double>::infinity()); }
  bool has(const char* key) const { return p_.has(key); }
  Column3<T> vector(const char* key) const { return vector(p_.numbers(key)); }
  static Column3<T> vector(const auto& x) { return {T(x[0]), T(x[1]), T(x[2])}; }
  std::vector<T> numbers(const char* key) const {
    return std::vector<T>(p_.numbers(key).begin(), p_.numbers(key).end());
  }
  bool is(const char* key, const char* word) const { return p_.word(key) == word; }
  Place<T> place() const { return place(p_.word("frame")); }
  /// Of the key `frames`; none if it is missing.
  std::vector<Place<T>> places() const {
    std::vector<Place<T>> all;
    if (has("frames"))
      for (const std::string& name : p_.names("frames")) all.push_back(place(name));
    return all;
  }
  /// A constant, as a table of one row.
  static laws::Curve<T> constant(const std::vector<T>& row) { return {{}, {row}}; }
  /// The table of a key; none if it is missing.
  laws::Curve<T> curve(const char* key) const {
    laws::Curve<T> curve{{}, {}, has("interpolation") && is("interpolation", "cubic")};
    if (!has(key)) return curve;
    const scene::Value& table = p_.table(key);
    for (std::size_t i = 0; i < table.numbers.size(); i += table.width) {
      const auto row = table.numbers.begin() + long(i);
      curve.times.push_back(T(*row));
      curve.rows.emplace_back(row + 1, row + long(table.width));
    }
    return curve;
  }
  /// The table of a column of numbers at the times of the key `times`.
  laws::Curve<T> column(const char* key) const {
    laws::Curve<T> column = curve("rows");
    if (!has("times")) return column;
    column.times = numbers("times");
    for (const T& x : numbers(key)) column.rows.push_back({x});
    return column;
  }
  laws::Pursuit<T> pursuit() const {
    const auto targets = has("rows")     ? curve("rows")
                         : has("target") ? constant(numbers("target"))
                                         : constant({T(0)});
    return {number("stiffness"), number("damping"), targets};
  }
  std::size_t joint(const char* key) const { return std::size_t(scene_.robot.requireJointId(p_.word(key))); }
  laws::Touch<T> touch() const {
    return {number("stiffness"), number("exponent"), number("dissipation"), number("friction"),
            number("slip"),      number("rolling"),  number("torsion"),     number("angular_slip")};
  }
  /// The shapes of the key `bodies`, those of all bodies for "all", none if it is missing.
  std::vector<laws::Solid<T>> solids() const {
    std::vector<laws::Solid<T>> all;
    if (!has("bodies")) return all;
    const auto& names = p_.names("bodies");
    for (const scene::Shape& shape : scene_.around.shapes)
      if (names[0] == "all" || std::find(names.begin(), names.end(), shape.body) != names.end())
        all.push_back(solid(shape));
    return all;
  }
  /// The indices in v of the joints named; "all" is every joint except free-flyers.
  std::vector<std::size_t> coordinates() const { return select(false); }
  /// Those that have a scalar position.
  std::vector<std::size_t> positions() const { return select(true); }
  /// The number `key` for each coordinate, or the robot's own if it is missing.
  std::vector<T> each(const char* key, const Eigen::VectorXd& of_robot) const {
    std::vector<T> all;
    for (const std::size_t k : coordinates())
      all.push_back(p_.has(key) ? T(p_.number(key)) : T(of_robot[Eigen::Index(k)]));
    return all;
  }
  /// A robot's numbers by q or v of the coordinates with a scalar position.
  std::vector<T> of_positions(const Eigen::VectorXd& of_robot) const {
    const Robot& robot = scene_.robot;
    std::vector<T> all;
    for (const std::size_t k : positions()) {
      const std::size_t joint = std::size_t(robot.column_to_joint[k]);
      const int shift = of_robot.size() == robot.nv ? 0 : robot.idx_qs[joint] - robot.idx_vs[joint];
      all.push_back(T(of_robot[Eigen::Index(k) + shift]));
    }
    return all;
  }
  const Benchmark& scene() const { return scene_; }

 private:
  Place<T> place(const std::string& name) const { return place(scene_.robot.requireFrameId(name)); }
  Place<T> place(int frame) const {
    const auto& f = scene_.robot.frames[std::size_t(frame)];
    return {f.parentJoint, nearest_rotation<T>(f.placement.rotation().template cast<T>()),
            f.placement.translation().template cast<T>()};
  }
  laws::Solid<T> solid(const scene::Shape& shape) const {
    using Type = scene::Shape::Type;
    if (shape.type == Type::Cylinder) refuse("contact", "cylinders");
    if (shape.type == Type::Unusable)
      throw std::invalid_argument("the collision shape of '" + shape.body + "' " + shape.why);
    laws::Solid<T> solid{place(shape.frame)};
    solid.at.p += solid.at.R * Column3<T>(shape.X_FS.translation().template cast<T>());
    solid.at.R = solid.at.R * nearest_rotation<T>(shape.X_FS.rotation().template cast<T>());
    solid.box = shape.type == Type::Box;
    if (solid.box) solid.sides = vector(shape.size) / T(2);
    if (!solid.box) solid.r = T(shape.size[0]);
    if (shape.type == Type::Capsule) solid.half = T(shape.size[1]) / T(2);
    return solid;
  }
  std::vector<std::size_t> select(bool with_position) const {
    const Robot& robot = scene_.robot;
    const auto& names = p_.names("joints");
    std::vector<std::size_t> all;
    for (std::size_t i = 1; i < robot.joints.size(); ++i) {
      const bool named = std::find(names.begin(), names.end(), robot.names[i]) != names.end();
      const bool meant = names[0] == "all" ? kind_of(robot, i) != JointKind::free_flyer : named;
      if (!meant || (with_position && robot.nqs[i] != robot.nvs[i])) continue;
      for (int k = 0; k < robot.nvs[i]; ++k) all.push_back(std::size_t(robot.idx_vs[i] + k));
    }
    return all;
  }
  const scene::Parameters& p_;
  const Benchmark& scene_;
};

template <class T>
T from(const Values<T>& p) {
  return p.number("from", -std::numeric_limits<double>::infinity());
}
template <class T>
T until(const Values<T>& p) {
  return p.number("until", std::numeric_limits<double>::infinity());
}
/// The finite times at which a force begins and ends.
template <class T>
std::vector<T> interval(const Values<T>& p) {
  std::vector<T> times;
  for (const T& t : {from(p), until(p)})
    if (t - t == 0) times.push_back(t);
  return times;
}

}  // namespace liecheck::properties
