#include <tinyxml2.h>

#include <algorithm>
#include <liecheck/multibody/inertia_validity.hpp>
#include <liecheck/urdf/urdf_markup.hpp>
#include <liecheck/urdf/urdf_numbers.hpp>
#include <liecheck/urdf/urdf_text.hpp>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

namespace liecheck::urdf_detail {
namespace {

using tinyxml2::XMLDocument, tinyxml2::XMLElement, tinyxml2::XMLNode;

class Validator {
 public:
  Validator(const std::string& source_name, const UrdfOptions& options)
      : source_(source_name), options_(options) {}

  ValidUrdf robot(const XMLDocument& document) {
    const XMLElement* robot = document.RootElement();
    if (!robot) refuse(1, "no element, expected <robot>", "");
    for (const XMLNode* node = document.FirstChild(); node; node = node->NextSibling()) {
      if (node->ToElement() && node->ToElement() != robot)
        refuse(node->GetLineNum(), "a second root element", node->Value());
    }
    if (std::string_view(robot->Value()) != "robot")
      refuse(robot->GetLineNum(), "expected <robot>", robot->Value());
    name(*robot, "robot");
    for (const XMLElement* e = robot->FirstChildElement("material"); e; e = e->NextSiblingElement("material"))
      material(*e);
    for (const XMLElement* e = robot->FirstChildElement("link"); e; e = e->NextSiblingElement("link"))
      link(*e);
    if (link_line_.empty()) refuse(robot->GetLineNum(), "a robot without links", robot->Attribute("name"));
    for (const XMLElement* e = robot->FirstChildElement("joint"); e; e = e->NextSiblingElement("joint"))
      joint(*e);
    mimics();
    tree(*robot);
    return {"", robot->GetLineNum(), std::move(joint_line_), std::move(faults_), std::move(warnings_)};
  }

  [[noreturn]] void refuse(int line, const std::string& what, const std::string& value) const {
    throw UrdfError(source_, line, what, value);
  }

 private:
  void warn(int line, const std::string& what, const std::string& value) {
    if (options_.strict) refuse(line, what, value);
    warnings_.push_back(complaint(source_, line, what, value));
  }

  std::string name(const XMLElement& e, const std::string& what) const {
    const char* value = e.Attribute("name");
    if (!value || !*value) refuse(e.GetLineNum(), "a " + what + " without a name", value ? value : "");
    return value;
  }

  void material(const XMLElement& e) {
    checkNumbersBelow(e, source_);
    const char* material_name = e.Attribute("name");
    if (!material_name) return;
    const auto [first, is_new] = material_line_.emplace(material_name, e.GetLineNum());
    if (!is_new)
      refuse(e.GetLineNum(),
             "a second material of that name, the first is in line " + std::to_string(first->second),
             material_name);
  }

  void link(const XMLElement& e) {
    const std::string link_name = name(e, "link");
    const auto [first, is_new] = link_line_.emplace(link_name, e.GetLineNum());
    if (!is_new)
      refuse(e.GetLineNum(),
             "a second link of that name, the first is in line " + std::to_string(first->second), link_name);
    checkNumbersBelow(e, source_);
    if (const XMLElement* inertial = e.FirstChildElement("inertial")) {
      const XMLElement* mass = inertial->FirstChildElement("mass");
      if (!mass) refuse(inertial->GetLineNum(), "an <inertial> without <mass>", link_name);
      if (!inertial->FirstChildElement("inertia"))
        refuse(inertial->GetLineNum(), "an <inertial> without <inertia>", link_name);
      body(*inertial, link_name);
    }
  }

  /// Mass >= 0, and is the inertia one that a body could have, up to the digits it is printed with?
  void body(const XMLElement& inertial, const std::string& link_name) {
    const XMLElement &mass = *inertial.FirstChildElement("mass"),
                     &inertia = *inertial.FirstChildElement("inertia");
    const auto of = [&](const char* name) { return numberOf(inertia.Attribute(name)); };
    const double m = numberOf(mass.Attribute("value"));
    if (m < 0)
      refuse(mass.GetLineNum(), "link '" + link_name + "' has a negative mass", mass.Attribute("value"));
    Matrix3<double> I;
    I << of("ixx"), of("ixy"), of("ixz"), of("ixy"), of("iyy"), of("iyz"), of("ixz"), of("iyz"), of("izz");
    const std::string why =
        whyUnphysical(Inertia<double>(m, Vector3<double>::Zero(), I), printed_inertia_slack);
    if (why.empty()) return;
    const std::size_t colon = why.find(": ");
    faults_.push_back({link_name, inertia.GetLineNum(), "link '" + link_name + "': " + why.substr(0, colon),
                       colon == why.npos ? "" : why.substr(colon + 2)});
  }

  void joint(const XMLElement& e) {
    const std::string joint_name = name(e, "joint"), joint_text = "joint '" + joint_name + "'";
    const auto [first, is_new] = joint_line_.emplace(joint_name, e.GetLineNum());
    if (!is_new)
      refuse(e.GetLineNum(),
             "a second joint of that name, the first is in line " + std::to_string(first->second),
             joint_name);
    if (joint_name == "universe" ||
        (joint_name == "root_joint" && (options_.root_joint || options_.root == RootJoint::FreeFlyer)))
      refuse(e.GetLineNum(), "a joint has the name that the model's own root has", joint_name);
    const char* type_text = e.Attribute("type");
    if (!type_text) refuse(e.GetLineNum(), joint_text + " has no type", "");
    const std::string type = type_text;
    if (type != "fixed" && type != "floating" && type != "planar" && type != "revolute" &&
        type != "continuous" && type != "prismatic")
      refuse(e.GetLineNum(), joint_text + ": unknown joint type", type);
    checkNumbersBelow(e, source_);
    extras(e, joint_text);
    const bool one_coordinate = type == "revolute" || type == "continuous" || type == "prismatic";
    if (one_coordinate) axis(e, joint_text);
    limits(e, joint_text, type);
    if (const XMLElement* mimic = e.FirstChildElement("mimic"); mimic && one_coordinate)
      mimics_.push_back({joint_name, mimic->Attribute("joint"), mimic->GetLineNum()});
    if (type == "planar" || type == "floating") unused(e, joint_text, type);
    const std::string parent = linkOf(e, "parent", joint_text), child = linkOf(e, "child", joint_text);
    const auto [other, first_parent] = parent_joint_.emplace(child, joint_name);
    if (!first_parent)
      refuse(e.GetLineNum(), joint_text + " and joint '" + other->second + "' have the same child: a loop",
             child);
    children_[parent].push_back(child);
  }

  void limits(const XMLElement& e, const std::string& joint_text, const std::string& type) {
    const XMLElement* limit = e.FirstChildElement("limit");
    const bool bounded = type == "revolute" || type == "prismatic";
    if (!limit) {
      if (bounded) refuse(e.GetLineNum(), joint_text + " has no <limit>, which its type needs", type);
      return;
    }
    const auto of = [&](const char* name) {
      const char* text = limit->Attribute(name);
      return text ? numberOf(text) : 0.0;
    };
    for (const char* name : {"effort", "velocity"})
      if (of(name) < 0)
        refuse(limit->GetLineNum(), joint_text + " has a negative " + name + " limit",
               limit->Attribute(name));
    if (bounded && of("lower") > of("upper"))
      refuse(limit->GetLineNum(), joint_text + " has crossed limits, lower > upper",
             std::to_string(of("lower")) + " > " + std::to_string(of("upper")));
    if (type == "continuous" && (limit->Attribute("lower") || limit->Attribute("upper")) &&
        of("lower") != of("upper"))
      warn(limit->GetLineNum(), joint_text + " has position limits, which a continuous joint has no use for",
           std::to_string(of("lower")) + " " + std::to_string(of("upper")));
  }

  /// What is said in vain of a joint that moves in more than one way. A planar joint moves in the x y plane whatever
  /// axis is given.
  void unused(const XMLElement& e, const std::string& joint_text, const std::string& type) {
    const XMLElement* axis = e.FirstChildElement("axis");
    const std::string xyz = axis ? axis->Attribute("xyz") : "none, so 1 0 0";
    const std::vector<double> v = list(axis ? xyz : "1 0 0").value_or(std::vector<double>{});
    if (type == "planar" && v != std::vector<double>{0, 0, 1})
      warn(axis ? axis->GetLineNum() : e.GetLineNum(),
           joint_text + " is planar and its axis is ignored: it moves in its x y plane", xyz);
    if (type == "floating" && axis)
      warn(axis->GetLineNum(), joint_text + " is floating and its axis is ignored", xyz);
    for (const char* element : {"limit", "dynamics", "mimic"})
      if (const XMLElement* found = e.FirstChildElement(element))
        warn(found->GetLineNum(), joint_text + ": its <" + element + "> is ignored", type);
  }

  void mimics() {
    for (const auto& [joint_name, primary, line] : mimics_) {
      if (!joint_line_.contains(primary))
        refuse(line, "joint '" + joint_name + "' mimics a joint that does not exist", primary);
      if (options_.mimic == MimicJoints::Independent)
        warn(line, "joint '" + joint_name + "' is a mimic and is treated as independent", primary);
    }
  }

  void axis(const XMLElement& e, const std::string& joint_text) const {
    const XMLElement* axis = e.FirstChildElement("axis");
    if (!axis) return;  // (1, 0, 0)
    const std::string xyz = axis->Attribute("xyz");
    const std::vector<double> v = list(xyz).value_or(std::vector<double>{});
    if (std::all_of(v.begin(), v.end(), [](double x) { return x == 0; }))
      refuse(axis->GetLineNum(), joint_text + " has a zero axis", xyz);
  }

  /// What urdfdom would refuse without a line.
  void extras(const XMLElement& e, const std::string& joint_text) const {
    const XMLElement* mimic = e.FirstChildElement("mimic");
    if (mimic && !mimic->Attribute("joint"))
      refuse(mimic->GetLineNum(), joint_text + " has a <mimic> that names no joint", "");
    const XMLElement* dynamics = e.FirstChildElement("dynamics");
    if (dynamics && !dynamics->Attribute("damping") && !dynamics->Attribute("friction"))
      refuse(dynamics->GetLineNum(), joint_text + " has a <dynamics> without damping and friction", "");
  }

  std::string linkOf(const XMLElement& e, const char* role, const std::string& joint_text) const {
    const XMLElement* element = e.FirstChildElement(role);
    const char* link_name = element ? element->Attribute("link") : nullptr;
    if (!link_name) refuse(e.GetLineNum(), joint_text + " has no " + role + " link", "");
    if (!link_line_.contains(link_name))
      refuse(element->GetLineNum(), joint_text + ": its " + role + " link does not exist", link_name);
    return link_name;
  }

  /// One root, every link reached from it, none too deep.
  void tree(const XMLElement& robot) const {
    std::vector<std::string> roots;
    for (const auto& [link_name, line] : link_line_)
      if (!parent_joint_.contains(link_name)) roots.push_back(link_name);
    if (roots.empty())
      refuse(robot.GetLineNum(), "every link has a parent: a loop", link_line_.begin()->first);
    if (roots.size() > 1)
      refuse(link_line_.at(roots[1]), "two roots, the other is '" + roots[0] + "'", roots[1]);
    std::set<std::string> reached{roots[0]};
    std::vector<std::string> todo = roots;
    while (!todo.empty()) {
      const std::string link_name = todo.back();
      todo.pop_back();
      const auto found = children_.find(link_name);
      if (found == children_.end()) continue;
      for (const std::string& child : found->second) {
        reached.insert(child);
        todo.push_back(child);
      }
    }
    for (const auto& [link_name, line] : link_line_)
      if (!reached.contains(link_name))
        refuse(line, "not connected to the root: its joints form a loop", link_name);
  }

  struct MimicLine {
    std::string joint, primary;
    int line;
  };

  const std::string& source_;
  const UrdfOptions& options_;
  std::map<std::string, int> link_line_, material_line_;
  std::unordered_map<std::string, int> joint_line_;
  std::map<std::string, std::string> parent_joint_;  // of a link
  std::map<std::string, std::vector<std::string>> children_;
  std::vector<MimicLine> mimics_;
  std::vector<ValidUrdf::Fault> faults_;
  std::vector<std::string> warnings_;
};

/// The text of what a model is made of: joints, and links with their inertials.
std::string skeleton(XMLDocument& document) {
  const auto keep = [](XMLNode& parent, auto wanted) {
    for (XMLNode *node = parent.FirstChild(), *next = nullptr; node; node = next) {
      next = node->NextSibling();
      if (!wanted(node->Value())) parent.DeleteChild(node);
    }
  };
  XMLElement& robot = *document.RootElement();
  keep(document, [](std::string_view name) { return name == "robot"; });
  keep(robot, [](std::string_view name) { return name == "link" || name == "joint"; });
  for (XMLElement* e = robot.FirstChildElement("link"); e; e = e->NextSiblingElement("link"))
    keep(*e, [](std::string_view name) { return name == "inertial"; });
  for (XMLElement* e = robot.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint"))
    keep(*e, [](std::string_view name) { return name != "safety_controller" && name != "calibration"; });
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace

ValidUrdf validateUrdfText(const std::string& text, const std::string& source_name,
                           const UrdfOptions& options) {
  Validator validator(source_name, options);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    validator.refuse(1, "empty", std::to_string(text.size()) + " bytes");
  checkMarkup(text, source_name);
  XMLDocument document;
  document.Parse(text.data(), text.size());
  if (const tinyxml2::XMLError error = document.ErrorID()) {
    const char* why =
        error == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT  ? "an element that nothing of its name closes"
        : error == tinyxml2::XML_ERROR_PARSING_ATTRIBUTE ? "an attribute without a value, or twice"
                                                         : document.ErrorName();
    validator.refuse(std::max(document.ErrorLineNum(), 1), "malformed XML, or cut off", why);
  }
  ValidUrdf valid = validator.robot(document);
  valid.skeleton = skeleton(document);
  return valid;
}

}  // namespace liecheck::urdf_detail
