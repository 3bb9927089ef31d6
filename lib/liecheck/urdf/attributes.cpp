#include <algorithm>
#include <array>
#include <cmath>
#include <liecheck/text/from_chars.hpp>
#include <liecheck/urdf/attributes.hpp>
#include <limits>
#include <string>

namespace liecheck::urdf_detail {
namespace {

/// Attributes of one element, each with `count` numbers. Only elements below <link>, <joint> and <material>
/// are checked, since other programs may use the same names elsewhere.
struct NumericAttributes {
  std::string_view element;
  std::array<const char*, 6> names;  ///< null after the last
  int count;
  /// What is missing is refused if this is null, is allowed if it is empty, and is a warning otherwise, which
  /// says that the attribute is taken as this.
  const char* otherwise;
};
constexpr const char *required = nullptr, *optional = "";
constexpr NumericAttributes numeric_attributes[] = {
    {"origin", {"xyz", "rpy"}, 3, optional},
    {"axis", {"xyz"}, 3, "1 0 0"},
    {"mass", {"value"}, 1, required},
    {"inertia", {"ixx", "iyy", "izz"}, 1, required},
    {"inertia", {"ixy", "ixz", "iyz"}, 1, "0"},
    {"limit", {"lower", "upper"}, 1, optional},  // description.cpp: not all types need them
    {"limit", {"effort", "velocity"}, 1, "infinite"},
    {"dynamics", {"damping", "friction"}, 1, optional},
    {"mimic", {"multiplier", "offset"}, 1, optional},
    {"box", {"size"}, 3, required},
    {"sphere", {"radius"}, 1, required},
    {"cylinder", {"radius", "length"}, 1, required},
    {"mesh", {"scale"}, 3, optional},
    {"color", {"rgba"}, 4, required},
    {"calibration", {"rising", "falling"}, 1, optional},
    {"safety_controller", {"soft_lower_limit", "soft_upper_limit", "k_position"}, 1, optional},
    {"safety_controller", {"k_velocity"}, 1, required},
};

std::optional<double> oneNumber(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = fromChars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

/// The largest double whose square is finite.
const double largest_root = std::sqrt(std::numeric_limits<double>::max());

/// Checks one attribute of e. If the model does not read it, an error is only a warning.
void check(const Element& e, const std::string& attribute, const NumericAttributes& n, bool is_read,
           Messages& messages) {
  const std::string what = "<" + std::string(n.element) + "> " + attribute;
  const auto refuse = [&](int line, const std::string& why, const std::string& value) {
    if (is_read) messages.refuse(line, what + why, value);
    messages.warn(line, what + why, value);
  };
  for (const Attribute& a : e.attributes) {
    if (a.name != attribute) continue;
    const auto values = numbersIn(a.value);
    if (!values) return refuse(a.line, " does not hold finite numbers", a.value);
    if (int(values->size()) != n.count)
      return refuse(a.line,
                    " has " + std::to_string(values->size()) + " numbers, not " + std::to_string(n.count),
                    a.value);
    if (is_read &&
        std::any_of(values->begin(), values->end(), [](double x) { return std::abs(x) > largest_root; }))
      messages.warn(a.line, what + " is so large that its square overflows", a.value);
    return;
  }
  if (!n.otherwise) refuse(e.line, " is missing", "");
  if (n.otherwise && *n.otherwise) messages.warn(e.line, what + " is missing and is taken as", n.otherwise);
}

void checkBelow(const Element& e, bool is_read, Messages& messages) {
  for (const Element& child : e.children) {
    const std::string_view element = child.name;
    for (const NumericAttributes& n : numeric_attributes)
      for (const char* name : n.names)
        if (element == n.element && name) check(child, name, n, is_read, messages);
    checkBelow(child, is_read && element != "visual" && element != "collision", messages);
  }
}

}  // namespace

std::optional<std::vector<double>> numbersIn(std::string_view text) {
  std::vector<double> values;
  constexpr std::string_view space = " \t\r\n";
  for (std::size_t i = text.find_first_not_of(space); i != std::string_view::npos;
       i = text.find_first_not_of(space, i)) {
    const std::size_t end = std::min(text.find_first_of(space, i), text.size());
    const auto value = oneNumber(text.substr(i, end - i));
    if (!value) return {};
    values.push_back(*value);
    i = end;
  }
  return values;
}

void checkNumbersBelow(const Element& e, Messages& messages) {
  checkBelow(e, e.name != "material", messages);
}

double number(const Element& e, const char* attribute, double fallback) {
  const char* text = e.attribute(attribute);
  return text ? numbersIn(text).value().at(0) : fallback;
}

Vector3<double> vector(const Element& e, const char* attribute, const Vector3<double>& fallback) {
  const char* text = e.attribute(attribute);
  if (!text) return fallback;
  const std::vector<double> x = numbersIn(text).value();
  return {x.at(0), x.at(1), x.at(2)};
}

}  // namespace liecheck::urdf_detail
