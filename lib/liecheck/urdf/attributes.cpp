#include <array>
#include <charconv>
#include <cmath>
#include <liecheck/urdf/attributes.hpp>
#include <string>

namespace liecheck::urdf_detail {
namespace {

using tinyxml2::XMLAttribute, tinyxml2::XMLElement;

/// Attributes of one element, each with `count` numbers. Only elements below <link>, <joint> and <material>
/// are checked, since other programs may use the same names elsewhere.
struct NumericAttributes {
  std::string_view element;
  std::array<const char*, 6> names;  ///< null after the last
  int count;
  bool required;
};
constexpr NumericAttributes numeric_attributes[] = {
    {"origin", {"xyz", "rpy"}, 3, false},
    {"axis", {"xyz"}, 3, true},
    {"mass", {"value"}, 1, true},
    {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, 1, true},
    {"limit", {"lower", "upper"}, 1, false},
    {"limit", {"effort", "velocity"}, 1, true},
    {"dynamics", {"damping", "friction"}, 1, false},
    {"mimic", {"multiplier", "offset"}, 1, false},
    {"box", {"size"}, 3, true},
    {"sphere", {"radius"}, 1, true},
    {"cylinder", {"radius", "length"}, 1, true},
    {"mesh", {"scale"}, 3, false},
    {"color", {"rgba"}, 4, true},
    {"calibration", {"rising", "falling"}, 1, false},
    {"safety_controller", {"soft_lower_limit", "soft_upper_limit", "k_position"}, 1, false},
    {"safety_controller", {"k_velocity"}, 1, true},
};

std::optional<double> oneNumber(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

void check(const XMLElement& e, const std::string& attribute, const NumericAttributes& n,
           const Messages& messages) {
  const auto refuse = [&](int line, const std::string& why, const char* value) {
    messages.refuse(line, "<" + std::string(n.element) + "> " + attribute + why, value);
  };
  for (const XMLAttribute* a = e.FirstAttribute(); a; a = a->Next()) {
    if (a->Name() != attribute) continue;
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
    for (const NumericAttributes& n : numeric_attributes)
      for (const char* name : n.names)
        if (element == n.element && name) check(*child, name, n, messages);
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
