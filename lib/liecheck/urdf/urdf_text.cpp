#include <tinyxml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <liecheck/urdf/urdf_markup.hpp>
#include <liecheck/urdf/urdf_text.hpp>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace liecheck::urdf_detail {
namespace {

/// Numbers that an element's attributes hold: how many, and whether the attribute may be left out. Elements
/// are looked up below link, joint and material only: extensions of other programs are not ours to judge.
struct Numbers {
  const char* element;
  const char* attribute;
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

class Validator {
 public:
  Validator(const std::string& source_name, RootJoint root) : source_(source_name), root_(root) {}

  int robot(const TiXmlDocument& document) {
    const TiXmlElement* robot = document.RootElement();
    if (!robot) refuse(1, "no element, expected <robot>", "");
    for (const TiXmlNode* node = document.FirstChild(); node; node = node->NextSibling()) {
      if (node->ToElement() && node->ToElement() != robot)
        refuse(node->Row(), "a second root element", node->ValueStr());
    }
    if (robot->ValueStr() != "robot") refuse(robot->Row(), "expected <robot>", robot->ValueStr());
    name(*robot, "robot");
    for (const TiXmlElement* e = robot->FirstChildElement("material"); e;
         e = e->NextSiblingElement("material"))
      material(*e);
    for (const TiXmlElement* e = robot->FirstChildElement("link"); e; e = e->NextSiblingElement("link"))
      link(*e);
    if (link_line_.empty()) refuse(robot->Row(), "a robot without links", robot->Attribute("name"));
    for (const TiXmlElement* e = robot->FirstChildElement("joint"); e; e = e->NextSiblingElement("joint"))
      joint(*e);
    tree(*robot);
    return robot->Row();
  }

  [[noreturn]] void refuse(int line, const std::string& what, const std::string& value) const {
    throw UrdfError(source_, line, what, value);
  }

 private:
  struct Child {
    std::string link;
    int line;
  };

  std::string name(const TiXmlElement& e, const std::string& what) const {
    const char* value = e.Attribute("name");
    if (!value || !*value) refuse(e.Row(), "a " + what + " without a name", value ? value : "");
    return value;
  }

  void material(const TiXmlElement& e) {
    numbersBelow(e);
    const char* material_name = e.Attribute("name");
    if (!material_name) return;
    const auto [first, is_new] = material_line_.emplace(material_name, e.Row());
    if (!is_new)
      refuse(e.Row(), "a second material of that name, the first is in line " + std::to_string(first->second),
             material_name);
  }

  void link(const TiXmlElement& e) {
    const std::string link_name = name(e, "link");
    const auto [first, is_new] = link_line_.emplace(link_name, e.Row());
    if (!is_new)
      refuse(e.Row(), "a second link of that name, the first is in line " + std::to_string(first->second),
             link_name);
    numbersBelow(e);
    if (const TiXmlElement* inertial = e.FirstChildElement("inertial")) {
      const TiXmlElement* mass = inertial->FirstChildElement("mass");
      if (!mass) refuse(inertial->Row(), "an <inertial> without <mass>", link_name);
      if (!inertial->FirstChildElement("inertia"))
        refuse(inertial->Row(), "an <inertial> without <inertia>", link_name);
      if (std::signbit(number(mass->Attribute("value")).value_or(0)) &&
          *number(mass->Attribute("value")) != 0)
        refuse(mass->Row(), "link '" + link_name + "' has a negative mass", mass->Attribute("value"));
    }
  }

  void joint(const TiXmlElement& e) {
    const std::string joint_name = name(e, "joint"), joint_text = "joint '" + joint_name + "'";
    const auto [first, is_new] = joint_line_.emplace(joint_name, e.Row());
    if (!is_new)
      refuse(e.Row(), "a second joint of that name, the first is in line " + std::to_string(first->second),
             joint_name);
    if (joint_name == "universe" || (joint_name == "root_joint" && root_ == RootJoint::FreeFlyer))
      refuse(e.Row(), "a joint has the name that the model's own root has", joint_name);
    const char* type_text = e.Attribute("type");
    if (!type_text) refuse(e.Row(), joint_text + " has no type", "");
    const std::string type = type_text;
    if (type == "planar") refuse(e.Row(), joint_text + ": this joint type is not supported", type);
    if (type != "fixed" && type != "floating" && type != "revolute" && type != "continuous" &&
        type != "prismatic")
      refuse(e.Row(), joint_text + ": unknown joint type", type);
    numbersBelow(e);
    extras(e, joint_text);
    if (type != "fixed" && type != "floating") axis(e, joint_text);
    if ((type == "revolute" || type == "prismatic") && !e.FirstChildElement("limit"))
      refuse(e.Row(), joint_text + " has no <limit>, which its type needs", type);
    const std::string parent = linkOf(e, "parent", joint_text), child = linkOf(e, "child", joint_text);
    const auto [other, first_parent] = parent_joint_.emplace(child, joint_name);
    if (!first_parent)
      refuse(e.Row(), joint_text + " and joint '" + other->second + "' have the same child: a loop", child);
    children_[parent].push_back({child, e.Row()});
  }

  void axis(const TiXmlElement& e, const std::string& joint_text) const {
    const TiXmlElement* axis = e.FirstChildElement("axis");
    if (!axis) return;  // (1, 0, 0)
    const std::string xyz = axis->Attribute("xyz");
    const std::vector<double> v = list(xyz).value_or(std::vector<double>{});
    if (std::all_of(v.begin(), v.end(), [](double x) { return x == 0; }))
      refuse(axis->Row(), joint_text + " has a zero axis", xyz);
  }

  /// What urdfdom would refuse without a line.
  void extras(const TiXmlElement& e, const std::string& joint_text) const {
    const TiXmlElement* mimic = e.FirstChildElement("mimic");
    if (mimic && !mimic->Attribute("joint"))
      refuse(mimic->Row(), joint_text + " has a <mimic> that names no joint", "");
    const TiXmlElement* dynamics = e.FirstChildElement("dynamics");
    if (dynamics && !dynamics->Attribute("damping") && !dynamics->Attribute("friction"))
      refuse(dynamics->Row(), joint_text + " has a <dynamics> without damping and friction", "");
  }

  std::string linkOf(const TiXmlElement& e, const char* role, const std::string& joint_text) const {
    const TiXmlElement* element = e.FirstChildElement(role);
    const char* link_name = element ? element->Attribute("link") : nullptr;
    if (!link_name) refuse(e.Row(), joint_text + " has no " + role + " link", "");
    if (!link_line_.contains(link_name))
      refuse(element->Row(), joint_text + ": its " + role + " link does not exist", link_name);
    return link_name;
  }

  /// One root, every link reached from it, none too deep.
  void tree(const TiXmlElement& robot) const {
    std::vector<std::string> roots;
    for (const auto& [link_name, line] : link_line_)
      if (!parent_joint_.contains(link_name)) roots.push_back(link_name);
    if (roots.empty()) refuse(robot.Row(), "every link has a parent: a loop", link_line_.begin()->first);
    if (roots.size() > 1)
      refuse(link_line_.at(roots[1]), "two roots, the other is '" + roots[0] + "'", roots[1]);
    std::map<std::string, int> depth{{roots[0], 0}};
    std::vector<std::string> todo = roots;
    while (!todo.empty()) {
      const std::string link_name = todo.back();
      todo.pop_back();
      const auto found = children_.find(link_name);
      if (found == children_.end()) continue;
      for (const Child& child : found->second) {
        const int d = depth.at(link_name) + 1;
        if (d > max_tree_depth)
          refuse(child.line, "more than " + std::to_string(max_tree_depth) + " joints in a chain",
                 child.link);
        depth.emplace(child.link, d);
        todo.push_back(child.link);
      }
    }
    for (const auto& [link_name, line] : link_line_)
      if (!depth.contains(link_name))
        refuse(line, "not connected to the root: its joints form a loop", link_name);
  }

  void numbersBelow(const TiXmlElement& e) const {
    for (const TiXmlElement* child = e.FirstChildElement(); child; child = child->NextSiblingElement()) {
      for (const Numbers& n : numbers)
        if (child->ValueStr() == n.element) check(*child, n);
      numbersBelow(*child);
    }
  }

  void check(const TiXmlElement& e, const Numbers& n) const {
    const std::string what = std::string("<") + n.element + "> " + n.attribute;
    for (const TiXmlAttribute* a = e.FirstAttribute(); a; a = a->Next()) {
      if (std::string(a->Name()) != n.attribute) continue;
      const auto values = list(a->ValueStr());
      if (!values) refuse(a->Row(), what + " is not finite numbers", a->ValueStr());
      if (int(values->size()) != n.count)
        refuse(a->Row(),
               what + " has " + std::to_string(values->size()) + " numbers, not " + std::to_string(n.count),
               a->ValueStr());
      return;
    }
    if (n.required) refuse(e.Row(), what + " is missing", "");
  }

  /// One number in C notation whatever the locale; nothing if it is not one, not finite, or out of a double's
  /// range.
  static std::optional<double> number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
  }
  static std::optional<std::vector<double>> list(std::string_view text) {
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

  const std::string& source_;
  RootJoint root_;
  std::map<std::string, int> link_line_, joint_line_, material_line_;
  std::map<std::string, std::string> parent_joint_;  // of a link
  std::map<std::string, std::vector<Child>> children_;
};

}  // namespace

int validateUrdfText(const std::string& text, const std::string& source_name, RootJoint root) {
  Validator validator(source_name, root);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    validator.refuse(1, "empty", std::to_string(text.size()) + " bytes");
  checkMarkup(text, source_name);
  TiXmlDocument document;
  document.Parse(text.c_str());
  if (document.Error())
    validator.refuse(std::max(document.ErrorRow(), 1), "malformed XML, or cut off", document.ErrorDesc());
  return validator.robot(document);
}

}  // namespace liecheck::urdf_detail
