#include <algorithm>
#include <array>
#include <cmath>
#include <liecheck/spatial/inertia.hpp>
#include <liecheck/urdf/attributes.hpp>
#include <liecheck/urdf/description.hpp>
#include <liecheck/urdf/markup.hpp>
#include <limits>
#include <set>
#include <string_view>

namespace liecheck::urdf_detail {
namespace {

/// The <origin> of an element: p = xyz [m], R = R_z(yaw) R_y(pitch) R_x(roll) of rpy [rad], as in urdfdom.
SE3<double> origin(const Element& of) {
  const Element* e = of.first("origin");
  if (!e) return SE3<double>::Identity();
  const Vector3<double> half = vector(*e, "rpy") / 2;
  const auto [sx, sy, sz] = std::array{std::sin(half[0]), std::sin(half[1]), std::sin(half[2])};
  const auto [cx, cy, cz] = std::array{std::cos(half[0]), std::cos(half[1]), std::cos(half[2])};
  const double x = sx * cy * cz - cx * sy * sz, y = cx * sy * cz + sx * cy * sz,
               z = cx * cy * sz - sx * sy * cz, w = cx * cy * cz + sx * sy * sz;
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  return {SO3<double>(Vector4<double>(x / norm, y / norm, z / norm, w / norm)), vector(*e, "xyz")};
}

class Reader {
 public:
  Reader(const UrdfOptions& options, Messages& messages) : options_(options), messages_(messages) {}

  Description robot(const Element& robot) {
    if (robot.name != "robot") refuse(robot, "expected <robot>", robot.name);
    robot_.line = robot.line;
    checkMarkup(robot, messages_);
    if (const char* robot_name = robot.attribute("name")) robot_.name = robot_name;
    if (robot_.name.empty()) messages_.warn(robot_.line, "a robot without a name is named", unnamed_robot);
    if (const char* version = robot.attribute("version"); version && version != std::string_view("1.0"))
      refuse(robot_.line, "a URDF version other than 1.0", version);
    for (const Element& e : robot.children)
      if (e.name == "material") material(e);
    for (const Element& e : robot.children)
      if (e.name == "link") link(e);
    if (robot_.links.empty()) refuse(robot_.line, "a robot without links", robot_.name);
    for (const Element& e : robot.children)
      if (e.name == "joint") joint(e);
    mimics();
    tree();
    return std::move(robot_);
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& what, const std::string& value) const {
    messages_.refuse(line, what, value);
  }
  [[noreturn]] void refuse(const Element& at, const std::string& what, const std::string& value) const {
    messages_.refuse(at.line, what, value);
  }

  std::string name(const Element& e, const std::string& what) const {
    const char* value = e.attribute("name");
    if (!value || !*value) refuse(e, "a " + what + " without a name", value ? value : "");
    return value;
  }

  /// Adds the part of a new name and sets its line. Refuses a second part of that name, and a reserved name.
  template <class Part>
  Part& added(std::map<std::string, Part>& parts, const Element& e, const std::string& what,
              const std::string& part_name) const {
    if (part_name == "universe")
      refuse(e, "this " + what + " name is reserved for the model's root", part_name);
    const auto [entry, is_new] = parts.try_emplace(part_name);
    Part& part = entry->second;
    if (!is_new)
      refuse(e, "a second " + what + " of that name, the first is in line " + std::to_string(part.line),
             part_name);
    part.line = e.line;
    return part;
  }

  void material(const Element& e) {
    checkNumbersBelow(e, messages_);
    const char* material_name = e.attribute("name");
    if (!material_name) return;
    const auto [first, is_new] = material_lines_.try_emplace(material_name, e.line);
    if (!is_new)
      messages_.warn(e.line,
                     "a second material of that name, the first is in line " + std::to_string(first->second),
                     material_name);
  }

  void link(const Element& e) {
    const std::string link_name = name(e, "link");
    LinkDescription& link = added(robot_.links, e, "link", link_name);
    checkNumbersBelow(e, messages_);
    if (const Element* inertial = e.first("inertial"))
      link.inertia = origin(*inertial).act(body(*inertial, link_name));
  }

  /// The inertia at the centre of mass, in the axes of <inertial>. Refuses a negative mass. Records moments
  /// that no body can have in unphysical_links, unless they are below m (eps |c|)^2: the rounding errors of
  /// the centre of mass c in the link's frame alone change them by more.
  Inertia<double> body(const Element& inertial, const std::string& link_name) {
    const Element *mass = inertial.first("mass"), *inertia = inertial.first("inertia");
    const auto warn = [&](const char* what) { messages_.warn(inertial.line, what, link_name); };
    if (!mass) warn("an <inertial> without <mass> is ignored, and the link has no mass");
    if (!mass) return Inertia<double>::Zero();
    if (!inertia) warn("an <inertial> without <inertia> is that of a point");
    const auto of = [&](const char* moment) { return inertia ? number(*inertia, moment) : 0; };
    const double m = number(*mass, "value");
    if (m < 0) refuse(*mass, "link '" + link_name + "' has a negative mass", mass->attribute("value"));
    if (m > 0 && m * m < std::numeric_limits<double>::min())
      messages_.warn(mass->line, "link '" + link_name + "' has a mass so small that its square underflows",
                     mass->attribute("value"));
    Matrix3<double> I;
    I << of("ixx"), of("ixy"), of("ixz"), of("ixy"), of("iyy"), of("iyz"), of("ixz"), of("iyz"), of("izz");
    const Inertia<double> body(m, Vector3<double>::Zero(), I);
    const double c_error = eps<double>() * origin(inertial).translation().norm();
    if (I.cwiseAbs().maxCoeff() <= m * c_error * c_error) return body;
    const std::string why = whyUnphysicalLink(body);
    const std::size_t colon = why.find(": ");
    if (!why.empty())
      robot_.unphysical_links.push_back({link_name, inertia->line,
                                         "link '" + link_name + "': " + why.substr(0, colon),
                                         colon == why.npos ? "" : why.substr(colon + 2)});
    return body;
  }

  void joint(const Element& e) {
    const std::string joint_name = name(e, "joint"), joint_text = "joint '" + joint_name + "'";
    JointDescription& joint = added(robot_.joints, e, "joint", joint_name);
    if (joint_name == "root_joint" && (options_.root_joint || options_.root == RootJoint::FreeFlyer))
      refuse(joint.line, "this joint name is reserved for the model's root", joint_name);
    joint.type = type(e, joint_text);
    checkNumbersBelow(e, messages_);
    joint.X_PJ = origin(e);
    const bool one_coordinate = joint.type == JointType::Revolute || joint.type == JointType::Continuous ||
                                joint.type == JointType::Prismatic;
    const Element *mimic = e.first("mimic"), *dynamics = e.first("dynamics");
    if (mimic && !mimic->attribute("joint"))
      refuse(*mimic, joint_text + " has a <mimic> that names no joint", "");
    if (dynamics && !dynamics->attribute("damping") && !dynamics->attribute("friction"))
      messages_.warn(dynamics->line, joint_text + " has a <dynamics> without damping and friction",
                     e.attribute("type"));
    if (dynamics) joint.dynamics = {number(*dynamics, "damping"), number(*dynamics, "friction")};
    if (one_coordinate) joint.axis = axis(e, joint_text);
    limit(e, joint_text, joint);
    softLimits(e, joint_text);
    if (mimic && one_coordinate) {
      joint.mimic = {mimic->attribute("joint"), number(*mimic, "multiplier", 1), number(*mimic, "offset")};
      mimics_.push_back({joint_name, joint.mimic->primary, mimic->line});
    }
    if (!one_coordinate && joint.type != JointType::Fixed) unused(e, joint_text, joint.type);
    joint.parent = linkOf(e, "parent", joint_text), joint.child = linkOf(e, "child", joint_text);
    const auto [other, first_parent] = parent_joint_.emplace(joint.child, joint_name);
    if (!first_parent)
      refuse(joint.line, joint_text + " and joint '" + other->second + "' have the same child: a loop",
             joint.child);
  }

  JointType type(const Element& e, const std::string& joint_text) const {
    static const std::map<std::string_view, JointType> types = {
        {"fixed", JointType::Fixed},           {"revolute", JointType::Revolute},
        {"continuous", JointType::Continuous}, {"prismatic", JointType::Prismatic},
        {"planar", JointType::Planar},         {"floating", JointType::Floating}};
    const char* text = e.attribute("type");
    if (!text) refuse(e, joint_text + " has no type", "");
    const auto found = types.find(text);
    if (found == types.end()) refuse(e, joint_text + ": unknown joint type", text);
    return found->second;
  }

  /// Reads <limit> as it is written; ModelBuilder ignores the limits that this warns of.
  void limit(const Element& e, const std::string& joint_text, JointDescription& joint) const {
    const Element* limit = e.first("limit");
    const bool bounded = joint.type == JointType::Revolute || joint.type == JointType::Prismatic;
    if (!limit) {
      if (bounded)
        messages_.warn(joint.line,
                       joint_text + " has no <limit>, which its type needs, and moves without limits",
                       e.attribute("type"));
      return;
    }
    const auto warn = [&](const std::string& what, const std::string& value) {
      messages_.warn(limit->line, joint_text + what, value);
    };
    for (const char* bound : {"lower", "upper"})
      if (bounded && !limit->attribute(bound))
        warn(std::string(" has a <limit> without ") + bound + ", which is taken as", "0");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    joint.limit = {number(*limit, "lower"), number(*limit, "upper"), number(*limit, "effort", infinity),
                   number(*limit, "velocity", infinity)};
    const auto [lower, upper, effort, velocity] = *joint.limit;
    if (effort < 0) warn(" has a negative effort limit, which is ignored", limit->attribute("effort"));
    if (velocity < 0) warn(" has a negative velocity limit, which is ignored", limit->attribute("velocity"));
    const std::string bounds = std::to_string(lower) + " " + std::to_string(upper);
    if (bounded && lower > upper) warn(" has crossed limits, lower > upper, which are ignored", bounds);
    if (joint.type == JointType::Continuous && lower != upper)
      warn(" has position limits, which a continuous joint ignores", bounds);
  }

  /// Warns of the soft limits of a controller, since the model has no place for them.
  void softLimits(const Element& e, const std::string& joint_text) const {
    const Element* safety = e.first("safety_controller");
    if (!safety) return;
    const char *lower = safety->attribute("soft_lower_limit"), *upper = safety->attribute("soft_upper_limit");
    if (lower || upper)
      messages_.warn(safety->line, joint_text + ": the soft limits of its <safety_controller> are ignored",
                     std::string(lower ? lower : "0") + " " + (upper ? upper : "0"));
  }

  /// Warns of elements that a planar or floating joint ignores. A planar joint always moves in its x y plane.
  void unused(const Element& e, const std::string& joint_text, JointType type) const {
    const Element* axis = e.first("axis");
    const char* text = axis ? axis->attribute("xyz") : nullptr;
    const std::string xyz = text ? text : "none, so 1 0 0";
    if (type == JointType::Planar && (!text || vector(*axis, "xyz") != Vector3<double>::UnitZ()))
      messages_.warn(axis ? axis->line : e.line,
                     joint_text + " is planar and its axis is ignored: it moves in its x y plane", xyz);
    if (type == JointType::Floating && axis)
      messages_.warn(axis->line, joint_text + " is floating and its axis is ignored", xyz);
    for (const char* element : {"limit", "dynamics", "mimic"})
      if (const Element* found = e.first(element))
        messages_.warn(found->line, joint_text + ": its <" + element + "> is ignored", e.attribute("type"));
  }

  /// Warns that each mimic is independent. If mimics are tied, refuses one that cannot follow its primary.
  void mimics() {
    for (const auto& [joint_name, primary, line] : mimics_) {
      const std::string mimic = "joint '" + joint_name + "' mimics ",
                        why = whyNotPrimary(joint_name, primary);
      if (options_.mimic == MimicJoints::Tied) {
        if (!why.empty()) refuse(line, mimic + why, primary);
        continue;
      }
      messages_.warn(line, "joint '" + joint_name + "' is a mimic and is treated as independent", primary);
      if (!why.empty()) messages_.warn(line, mimic + why, primary);
    }
  }

  std::string whyNotPrimary(const std::string& mimic, const std::string& primary) const {
    const auto found = robot_.joints.find(primary);
    if (found == robot_.joints.end()) return "a joint that does not exist";
    const JointDescription& joint = found->second;
    if (mimic == primary) return "itself";
    if (joint.type == JointType::Fixed) return "a joint that does not move";
    if (joint.type == JointType::Planar || joint.type == JointType::Floating)
      return "a joint that does not have exactly one degree of freedom";
    return joint.mimic ? "a joint that is a mimic itself" : "";
  }

  Vector3<double> axis(const Element& e, const std::string& joint_text) const {
    const Element* axis = e.first("axis");
    if (!axis) return Vector3<double>::UnitX();
    const Vector3<double> xyz = vector(*axis, "xyz", Vector3<double>::UnitX());
    if (xyz.isZero(0)) refuse(*axis, joint_text + " has a zero axis", axis->attribute("xyz"));
    if (std::fabs(xyz.stableNorm() - 1) > 1e-3)  // a rounding to three digits is no mistake
      messages_.warn(axis->line, joint_text + " has an axis whose length is not 1; only its direction counts",
                     axis->attribute("xyz"));
    return xyz;
  }

  std::string linkOf(const Element& e, const char* role, const std::string& joint_text) const {
    const Element* element = e.first(role);
    const char* link_name = element ? element->attribute("link") : nullptr;
    if (!link_name) refuse(e, joint_text + " has no " + role + " link", "");
    if (!robot_.links.contains(link_name))
      refuse(*element, joint_text + ": its " + role + " link does not exist", link_name);
    return link_name;
  }

  /// Checks that there is one root, and that every link is connected to it.
  void tree() {
    for (const auto& [joint_name, joint] : robot_.joints)
      robot_.joints_below[joint.parent].push_back(joint_name);
    std::vector<std::string> roots;
    for (const auto& [link_name, link] : robot_.links)
      if (!parent_joint_.contains(link_name)) roots.push_back(link_name);
    if (roots.empty()) refuse(robot_.line, "every link has a parent: a loop", robot_.links.begin()->first);
    if (roots.size() > 1)
      refuse(robot_.links.at(roots[1]).line, "two roots, the other is '" + roots[0] + "'", roots[1]);
    robot_.root = roots[0];
    std::set<std::string> reached;
    while (!roots.empty()) {
      const std::string link_name = roots.back();
      roots.pop_back();
      reached.insert(link_name);
      for (const std::string& joint_name : robot_.joints_below[link_name])
        roots.push_back(robot_.joints.at(joint_name).child);
    }
    for (const auto& [link_name, link] : robot_.links)
      if (!reached.contains(link_name))
        refuse(link.line, "not connected to the root: its joints form a loop", link_name);
  }

  struct MimicLine {
    std::string joint, primary;
    int line;
  };

  const UrdfOptions& options_;
  Messages& messages_;
  Description robot_;
  std::map<std::string, int> material_lines_;        // of the first of each name
  std::map<std::string, std::string> parent_joint_;  // by link
  std::vector<MimicLine> mimics_;
};

}  // namespace

double smallestMoment(const Inertia<double>& I) {
  const double scale = I.inertia().cwiseAbs().maxCoeff();
  if (scale == 0) return 0;
  return Eigen::SelfAdjointEigenSolver<Matrix3<double>>(I.inertia() / scale, Eigen::EigenvaluesOnly)
      .eigenvalues()[0];
}

std::string whyUnphysicalLink(const Inertia<double>& I) {
  const double rounding = 16 * eps<double>();  // as in whyUnphysical
  return smallestMoment(I) < -rounding ? whyUnphysical(I, rounding) : whyUnphysical(I, printed_inertia_slack);
}

Description describe(const std::string& text, const UrdfOptions& options, Messages& messages) {
  return Reader(options, messages).robot(parseXml(text, messages));
}

}  // namespace liecheck::urdf_detail
