#include <tellings/tellings.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <cmath>
#include <invariants/tree_law.hpp>
#include <optional>
#include <stdexcept>
#include <support/text.hpp>

namespace liecheck::properties::league {

namespace {

using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;

struct Inertial {
  Isometry3d at;  ///< centre of mass and axes, in the link's frame
  double mass;
  Matrix3d I;
};
struct Link {
  std::string name;
  std::optional<Inertial> inertial;
  std::string shape = {};  ///< XML of <visual> and <collision>
};
struct Joint {
  std::string name, type, parent, child;
  Isometry3d at;
  Vector3d axis = Vector3d::Zero();
  std::string more = {};  ///< XML beside <axis>
  double reach = 1e6;     ///< of <limit>, on both sides
};
struct Text {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;

  Link& link(const std::string& of) { return *std::ranges::find(links, of, &Link::name); }
};

std::string three(const Vector3d& x) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", x[0], x[1], x[2]);
}
/// R = Rz(yaw) Ry(pitch) Rx(roll). The roll is that of Rz(-yaw) R, so that it is right for every yaw if the pitch is
/// +-pi/2.
std::string origin(const Isometry3d& X) {
  const Matrix3d R = X.linear();
  const double yaw = std::atan2(R(1, 0), R(0, 0)), c = std::cos(yaw), s = std::sin(yaw);
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
  const double roll = std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1));
  return fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", three(X.translation()), three({roll, pitch, yaw}));
}

std::string written(const Text& t) {
  std::string text = fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", xml_escaped(t.name));
  for (const Link& l : t.links) {
    text += fmt::format("  <link name=\"{}\">\n", xml_escaped(l.name));
    if (l.inertial) {
      const Inertial& i = *l.inertial;
      text += fmt::format(
          "    <inertial>\n      {}\n      <mass value=\"{:.17g}\"/>\n      <inertia ixx=\"{:.17g}\" "
          "ixy=\"{:.17g}\" ixz=\"{:.17g}\" iyy=\"{:.17g}\" iyz=\"{:.17g}\" izz=\"{:.17g}\"/>\n    "
          "</inertial>\n",
          origin(i.at), i.mass, i.I(0, 0), i.I(0, 1), i.I(0, 2), i.I(1, 1), i.I(1, 2), i.I(2, 2));
    }
    text += l.shape + "  </link>\n";
  }
  for (const Joint& j : t.joints) {
    text += fmt::format(
        "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n    {}\n",
        xml_escaped(j.name), j.type, xml_escaped(j.parent), xml_escaped(j.child), origin(j.at));
    if (j.type != "fixed" && j.type != "floating")
      text += fmt::format("    <axis xyz=\"{}\"/>\n", three(j.axis));
    if (j.type == "revolute" || j.type == "prismatic")
      text += fmt::format("    <limit lower=\"{}\" upper=\"{}\" effort=\"{}\" velocity=\"{}\"/>\n", -j.reach,
                          j.reach, j.reach, j.reach);
    text += j.more + "  </joint>\n";
  }
  return text + "</robot>\n";
}

std::string type_of(oracles::JointKind kind) {
  using enum oracles::JointKind;
  if (kind == revolute) return "revolute";
  if (kind == continuous) return "continuous";
  if (kind == prismatic) return "prismatic";
  if (kind == free_flyer) return "floating";
  throw std::invalid_argument("the robot has a planar joint, which no telling supports");
}

/// A link for each joint that moves, and the root.
Text plain(const Robot& robot) {
  const RobotNumbers numbers = robot_numbers(robot);
  const TreeCase<double> c(numbers.at, numbers.numbers, numbers.numbers);
  const auto names = urdf_model(robot.urdf, robot.fixed)->joints;
  Text t{robot.name, {}, {}};
  if (robot.fixed) t.links.push_back({"root_link", {}});
  for (std::size_t i = 0; i < c.tree.joints.size(); ++i) {
    const auto& j = c.tree.joints[i];
    const bool base = i == 0 && !robot.fixed;
    Isometry3d at = Isometry3d::Identity();
    at.linear() = Quaterniond(j.Q[3], j.Q[0], j.Q[1], j.Q[2]).normalized().toRotationMatrix();
    at.translation() = Vector3d(j.p[0], j.p[1], j.p[2]);
    Link link{base ? "root_link" : names[i] + "_link", {}};
    const auto& b = j.body;
    Inertial own{Isometry3d::Identity(), b.mass, {}};
    own.at.translation() = Vector3d(b.c[0], b.c[1], b.c[2]);
    for (int k = 0; k < 9; ++k) own.I(k / 3, k % 3) = b.I_C(k / 3, k % 3);
    if (b.mass > 0 || own.I.norm() > 0) link.inertial = own;
    if (!base)
      t.joints.push_back({names[i], type_of(j.kind),
                          j.parent < 0 || (j.parent == 0 && !robot.fixed)
                              ? "root_link"
                              : names[static_cast<std::size_t>(j.parent)] + "_link",
                          link.name, at, Vector3d(j.axis[0], j.axis[1], j.axis[2])});
    t.links.push_back(link);
  }
  return t;
}

/// A pose without a symmetry, at a distance that a robot's link may have.
Isometry3d somewhere() {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Quaterniond(0.7, 0.1, -0.5, 0.4).normalized().toRotationMatrix();
  X.translation() = Vector3d(0.11, -0.07, 0.05);
  return X;
}

/// The body as a link sees it whose pose in the old link is X^-1: in the new link's axes.
Inertial moved(const Isometry3d& X, const Inertial& body) {
  Inertial y = body;
  y.at.translation() = X * body.at.translation();
  y.I = X.linear() * body.I * X.linear().transpose();
  return y;
}

Text inertial_rpy(Text t) {
  const Matrix3d R = somewhere().linear();
  for (Link& l : t.links)
    if (l.inertial) l.inertial->at.linear() = R, l.inertial->I = R.transpose() * l.inertial->I * R;
  return t;
}
/// A part of each body becomes a link that is fixed to the body's link: all of it, or half of it, on which the joints hang.
Text with_parts(Text t, bool all) {
  const Isometry3d X = somewhere();
  const std::size_t n = t.links.size(), joints = t.joints.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!t.links[i].inertial) continue;
    Inertial& own = *t.links[i].inertial;
    if (!all) own.mass /= 2, own.I /= 2;
    Inertial part = own;
    part = moved(X.inverse(), part);
    const std::string name = t.links[i].name + "_part";
    for (std::size_t k = 0; k < joints && !all; ++k)
      if (Joint& j = t.joints[k]; j.parent == t.links[i].name) j.parent = name, j.at = X.inverse() * j.at;
    t.joints.push_back({name + "_joint", "fixed", t.links[i].name, name, X});
    if (all) t.links[i].inertial.reset();
    t.links.push_back({name, part});
  }
  return t;
}
Text offset_frames(Text t) {
  const Isometry3d X = somewhere();
  const std::size_t n = t.joints.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string mount = t.joints[i].name + "_mount";
    t.joints.push_back({mount + "_joint", "fixed", t.joints[i].parent, mount, X});
    t.links.push_back({mount, {}});
    t.joints[i].parent = mount, t.joints[i].at = X.inverse() * t.joints[i].at;
  }
  return t;
}
/// A link without inertial at each body, which has no mass. Its shape must not give it one.
Text empty_links(Text t) {
  const std::size_t n = t.links.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = t.links[i].name + "_frame";
    t.joints.push_back({name + "_joint", "fixed", t.links[i].name, name, somewhere()});
    t.links.push_back(
        {name, {}, "    <collision><geometry><box size=\"0.3 0.2 0.1\"/></geometry></collision>\n"});
  }
  return t;
}
/// Each body on a link that is fixed to its own through another one.
Text fixed_twice(Text t) {
  const Isometry3d X = somewhere();
  const std::size_t n = t.links.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!t.links[i].inertial) continue;
    const std::string between = t.links[i].name + "_between", part = t.links[i].name + "_part";
    t.joints.push_back({between + "_joint", "fixed", t.links[i].name, between, X});
    t.joints.push_back({part + "_joint", "fixed", between, part, X});
    t.links.push_back({between, {}});
    t.links.push_back({part, moved((X * X).inverse(), *t.links[i].inertial)});
    t.links[i].inertial.reset();
  }
  return t;
}
/// A mesh in millimetres: its scale is of the shape alone.
Text scaled_meshes(Text t) {
  for (Link& l : t.links)
    l.shape =
        "    <visual><origin xyz=\"0.2 0 0.1\" rpy=\"0.3 0 0\"/><geometry>"
        "<mesh filename=\"package://robot/part.stl\" scale=\"0.001 0.001 0.001\"/></geometry></visual>\n";
  return t;
}
/// Limits that most configurations and velocities exceed: they belong to controllers and to contacts at the stops.
Text narrow_limits(Text t) {
  for (Joint& j : t.joints) {
    j.reach = 0.125;
    if (j.type == "revolute" || j.type == "prismatic")
      j.more =
          "    <safety_controller soft_lower_limit=\"-0.0625\" soft_upper_limit=\"0.0625\" k_position=\"8\" "
          "k_velocity=\"2\"/>\n";
  }
  return t;
}
Text damped(Text t) {
  for (Joint& j : t.joints)
    if (j.type != "fixed" && j.type != "floating")
      j.more = "    <dynamics damping=\"0.7\" friction=\"0.3\"/>\n";
  return t;
}
/// The second joint of one coordinate follows the first: a constraint, so that both keep their coordinates.
Text mimicking(Text t, const std::vector<std::string>& single) {
  std::ranges::find(t.joints, single[1], &Joint::name)->more =
      fmt::format("    <mimic joint=\"{}\" multiplier=\"-2\" offset=\"0.1\"/>\n", xml_escaped(single[0]));
  return t;
}
Text mirrored_axes(Text t) {
  for (Joint& j : t.joints) j.axis = -j.axis;
  return t;
}
/// Turns the joint around: its child is the root, and its parent, whose frame is now where the joint was, the child. The
/// coordinate is the same about the opposite axis.
Text re_rooted(Text t, const std::string& turned) {
  Joint& j = *std::ranges::find(t.joints, turned, &Joint::name);
  const Isometry3d back = j.at.inverse();
  if (auto& own = t.link(j.parent).inertial) own = moved(back, *own);
  for (Joint& other : t.joints)
    if (other.name != turned && other.parent == j.parent) other.at = back * other.at;
  j.at = Isometry3d::Identity(), j.axis = -j.axis;
  std::swap(j.parent, j.child);
  return t;
}

}  // namespace

std::vector<Telling> tellings(const Robot& robot) {
  const Text own = plain(robot);
  std::vector<std::string> single;
  std::string turned;
  for (const Joint& j : own.joints) {
    if (j.type == "floating") continue;
    single.push_back(j.name);
    if (turned.empty() && !robot.fixed && j.parent == "root_link") turned = j.name;
  }
  std::vector<Telling> all = {
      {"plain", "each link with its inertia in the link's axes", written(own)},
      {"inertial_rpy", "the axes of each inertia rotated by its rpy", written(inertial_rpy(own))},
      {"lumped_fixed_joints", "each body on a link that is fixed to its own", written(with_parts(own, true))},
      {"offset_frames", "a massless link before each joint", written(offset_frames(own))},
      {"split_bodies", "half of each body on a link that is fixed to its own",
       written(with_parts(own, false))},
      {"mirrored_axes", "each axis reversed", written(mirrored_axes(own)), single},
      {"empty_links", "a link without inertial, but with a shape, at each body", written(empty_links(own))},
      {"fixed_twice", "each body on a link that is fixed to its own through another",
       written(fixed_twice(own))},
      {"scaled_meshes", "a mesh in millimetres on each link", written(scaled_meshes(own))},
      {"narrow_limits", "limits that the motion exceeds", written(narrow_limits(own))}};
  all.push_back({"damped",
                 "damping and friction, judged by motions, momenta and energies",
                 written(damped(own)),
                 {},
                 {},
                 true});
  if (single.size() > 1)
    all.push_back({"mimicking", "a joint that mimics another, with a coordinate of its own",
                   written(mimicking(own, single))});
  if (!turned.empty())
    all.push_back(
        {"re_rooted", "a child of the base as the base", written(re_rooted(own, turned)), {}, turned});
  return all;
}

}  // namespace liecheck::properties::league
