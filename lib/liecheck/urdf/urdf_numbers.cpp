#include <charconv>
#include <cmath>
#include <liecheck/urdf/urdf.hpp>
#include <liecheck/urdf/urdf_numbers.hpp>

namespace liecheck::urdf_detail {
namespace {

using tinyxml2::XMLAttribute, tinyxml2::XMLElement;

/// Numbers that an element's attributes hold: how many, and whether the attribute may be left out. Elements
/// are looked up below link, joint and material only: extensions of other programs are not ours to judge.
struct Numbers {
  std::string_view element, attribute;
  int count;
  bool required;
};
constexpr Numbers numbers[] = {
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

std::optional<double> number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

void check(const XMLElement& e, const Numbers& n, const std::string& source) {
  const auto refuse = [&](int line, const std::string& why, const char* value) {
    throw UrdfError(source, line, "<" + std::string(n.element) + "> " + std::string(n.attribute) + why,
                    value);
  };
  for (const XMLAttribute* a = e.FirstAttribute(); a; a = a->Next()) {
    if (a->Name() != n.attribute) continue;
    const auto values = list(a->Value());
    if (!values) refuse(a->GetLineNum(), " is not finite numbers", a->Value());
    if (int(values->size()) != n.count)
      refuse(a->GetLineNum(),
             " has " + std::to_string(values->size()) + " numbers, not " + std::to_string(n.count),
             a->Value());
    return;
  }
  if (n.required) refuse(e.GetLineNum(), " is missing", "");
}

}  // namespace

std::optional<std::vector<double>> list(std::string_view text) {
  std::vector<double> values;
  constexpr std::string_view space = " \t\r\n";
  for (std::size_t i = text.find_first_not_of(space); i != std::string_view::npos;
       i = text.find_first_not_of(space, i)) {
    const std::size_t end = std::min(text.find_first_of(space, i), text.size());
    const auto value = number(text.substr(i, end - i));
    if (!value) return {};
    values.push_back(*value);
    i = end;
    if (i == text.size()) break;
  }
  return values;
}

double numberOf(std::string_view text) {
  return list(text).value().at(0);
}

void checkNumbersBelow(const XMLElement& e, const std::string& source) {
  for (const XMLElement* child = e.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string_view element = child->Value();
    for (const Numbers& n : numbers)
      if (element == n.element) check(*child, n, source);
    checkNumbersBelow(*child, source);
  }
}

}  // namespace liecheck::urdf_detail
