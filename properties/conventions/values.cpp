#include <conventions/values.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <operations/operations.hpp>
#include <stdexcept>

namespace liecheck::properties::conventions {

Kind kind_of(const Layout& layout) {
  const Part& first = layout.parts[0];
  if (layout.parts.size() == 3) {
    if (first.size == 1) return Kind::body;
    if (first.name == "R") return Kind::extended_pose;
    return first.name == "rho"    ? Kind::extended_tangent
           : first.name == "axis" ? Kind::screw
                                  : Kind::increments;
  }
  if (layout.parts.size() == 2) {
    if (first.size == 9) return Kind::pose;
    if (first.name == "axis") return Kind::axis_angle;
    if (first.size == 2) return layout.parts[1].size == 2 ? Kind::planar_pose : Kind::planar_tangent;
    if (layout.parts[1].size == 4) return Kind::configuration;
    if (first.unit == "m") return Kind::tangent;
    return first.unit == "m/s" || first.unit == "m/s^2" ? Kind::twist : Kind::wrench;
  }
  switch (first.size) {
    case 1:
      return first.name == "order" ? Kind::order : first.unit == "rad" ? Kind::angle : Kind::scalar;
    case 3:
      if (first.name == "angles") return Kind::euler_angles;
      if (first.name == "gibbs" || first.name == "mrp") return Kind::parameters;
      if (first.name == "weights") return Kind::weights;
      if (first.unit == "1") return Kind::direction;
      return first.unit == "rad" ? Kind::rotation_vector : Kind::vector;
    case 4:
      return Kind::quaternion;
    case 81:
      return Kind::jacobian9;
    case 9:
      if (first.unit.ends_with("/s") || first.unit.ends_with("s^2")) return Kind::samples;
      return first.name == "R" || first.name == "A" ? Kind::rotation_matrix : Kind::jacobian3;
    case 36:
      if (first.unit.starts_with("m^2")) return Kind::covariance;
      return first.unit.starts_with("kg") ? Kind::inertia_matrix : Kind::jacobian6;
    case 42:
      return Kind::jacobian76;
    default:
      throw std::logic_error("a value of unknown kind");
  }
}

std::size_t size_of(const Layout& layout) {
  std::size_t size = 0;
  for (const Part& p : layout.parts) {
    if (p.size <= 0) throw std::logic_error("a value whose size the model determines");
    size += static_cast<std::size_t>(p.size);
  }
  return size;
}

std::string number_name(const Part& part, std::size_t i) {
  if (part.size == 1) return std::string(part.name);
  if (part.size == 4) return fmt::format("{}.{}", part.name, "xyzw"[i]);
  const std::size_t columns = part.size == 9 ? 3 : part.size == 36 || part.size == 42 ? 6 : 1;
  return columns == 1 ? fmt::format("{}[{}]", part.name, i)
                      : fmt::format("{}[{},{}]", part.name, i / columns, i % columns);
}

std::size_t arguments_of(const Operation& operation) {
  std::size_t size = 0;
  for (const Layout* l : operation.arguments) size += size_of(*l);
  return size;
}

const Operation& operation_named(std::string_view name) {
  const auto& all = all_operations();
  const auto at = std::ranges::find(all, name, [](const Operation* o) { return o->name; });
  if (at == all.end()) throw std::logic_error("no operation " + std::string(name));
  return **at;
}

}  // namespace liecheck::properties::conventions
