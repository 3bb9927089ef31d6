#pragma once
// The links and joints that a URDF text describes, checked: everything wrong with them is a UrdfError with its line.

#include <liecheck/spatial/inertia.hpp>
#include <liecheck/spatial/se3.hpp>
#include <liecheck/urdf/error.hpp>
#include <liecheck/urdf/options.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace liecheck::urdf_detail {

/// Inertias are printed with few digits: with three of them, a moment errs by this part of the largest moment.
constexpr double printed_inertia_slack = 1e-3;

enum class JointType { Fixed, Revolute, Continuous, Prismatic, Planar, Floating };

struct JointDescription {
  struct Limit {
    double lower, upper, effort, velocity;
  };
  struct Dynamics {
    double damping, friction;
  };
  struct Mimic {
    std::string primary;
    double multiplier, offset;
  };
  int line = 0;
  JointType type = JointType::Fixed;
  std::string parent, child;  ///< the links that it connects
  SE3<double> X_PJ;           ///< <origin>, in the parent link
  Vector3<double> axis;       ///< any length but zero where the type has one coordinate
  std::optional<Limit> limit;
  std::optional<Dynamics> dynamics;
  std::optional<Mimic> mimic;
};

struct LinkDescription {
  int line = 0;
  Inertia<double> inertia = Inertia<double>::Zero();  ///< in the link's axes at its origin
};

struct Description {
  /// The inertia of a link that no body has: an error unless the bodies that the link is fixed to make up for it.
  struct UnphysicalLink {
    std::string link;
    int line;
    std::string what, value;
  };
  std::string name, root;  ///< of the robot; the root link
  int line = 0;
  std::map<std::string, LinkDescription> links;
  std::map<std::string, JointDescription> joints;
  std::map<std::string, std::vector<std::string>> joints_below;  ///< of a link, in alphabetical order
  std::vector<UnphysicalLink> unphysical_links;
};

/// Throws UrdfError unless text is one well-formed robot: a tree of named links, joints of supported types, numbers that
/// are finite, masses >= 0.
Description describe(const std::string& text, const UrdfOptions& options, Messages& messages);

}  // namespace liecheck::urdf_detail
