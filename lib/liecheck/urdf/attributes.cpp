#include <charconv>
#include <cmath>
#include <liecheck/urdf/attributes.hpp>
#include <string>

namespace liecheck::urdf_detail {
namespace {

using tinyxml2::XMLAttribute, tinyxml2::XMLElement;

/// An attribute that holds `count` numbers. Only elements below link, joint and material are checked, since
/// extensions of other programs may use the same names elsewhere.
struct NumericAttribute {
  std::string_view element, attribute;
  int count;
  bool required;
};
constexpr NumericAttribute numeric_attributes[] = {
    {"origin", "xyz", 3, false},
    {"origin", "rpy", 3, false},
    {"axis", "xyz", 3, true},
    {"mass", "value", 1, true},
    {"inertia", "ixx", 1, true},
    {"inertia", "ixy", 1, true},
    {"inertia", "ixz", 1, true},
    {"inertia", "iyy", 1, true},
    {"inertia", "iyz", 1, true},
    {"inertia", "izz", 1, true},
    {"limit", "lower", 1, false},
    {"limit", "upper", 1, false},
    {"limit", "effort", 1, true},
    {"limit", "velocity", 1, true},
    {"dynamics", "damping", 1, false},
    {"dynamics", "friction", 1, false},
    {"mimic", "multiplier", 1, false},
    {"mimic", "offset", 1, false},
    {"box", "size", 3, true},
    {"sphere", "radius", 1, true},
    {"cylinder", "radius", 1, true},
    {"cylinder", "length", 1, true},
    {"mesh", "scale", 3, false},
    {"color", "rgba", 4, true},
    {"calibration", "rising", 1, false},
    {"calibration", "falling", 1, false},
    {"safety_controller", "soft_lower_limit", 1, false},
    {"safety_controller", "soft_upper_limit", 1, false},
    {"safety_controller", "k_position", 1, false},
    {"safety_controller", "k_velocity", 1, true},
};

std::optional<double> oneNumber(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

void check(const XMLElement& e, const NumericAttribute& n, const Messages& messages) {
  const auto refuse = [&](int line, const std::string& why, const char* value) {
    messages.refuse(line, "<" + std::string(n.element) + "> " + std::string(n.attribute) + why, value);
  };
  for (const XMLAttribute* a = e.FirstAttribute(); a; a = a->Next()) {
    if (a->Name() != n.attribute) continue;
    const auto values = numbersIn(a->Value());
    if (!values) refuse(a->GetLineNum(), " does not hold finite numbers", a->Value());
    if (int(values->size()) != n.count)
      refuse(a->GetLineNum(),
             " has " + std::to_string(values->size()) + " numbers, not " + std::to_string(n.count),
             a->Value());
    return;
  }
  if (n.required) refuse(e.GetLineNum(), " is missing", "");
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

void checkNumbersBelow(const XMLElement& e, const Messages& messages) {
  for (const XMLElement* child = e.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string_view element = child->Value();
    for (const NumericAttribute& n : numeric_attributes)
      if (element == n.element) check(*child, n, messages);
    checkNumbersBelow(*child, messages);
  }
}

double number(const XMLElement& e, const char* attribute, double fallback) {
  const char* text = e.Attribute(attribute);
  return text ? numbersIn(text).value().at(0) : fallback;
}

Vector3<double> vector(const XMLElement& e, const char* attribute, const Vector3<double>& fallback) {
  const char* text = e.Attribute(attribute);
  if (!text) return fallback;
  const std::vector<double> x = numbersIn(text).value();
  return {x.at(0), x.at(1), x.at(2)};
}

}  // namespace liecheck::urdf_detail
