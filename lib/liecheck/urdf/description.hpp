#pragma once
// Reads and checks the links and joints of a URDF text. Every error throws a UrdfError that names its line.

#include <liecheck/spatial/inertia.hpp>
#include <liecheck/spatial/se3.hpp>
#include <liecheck/urdf/error.hpp>
#include <liecheck/urdf/options.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace liecheck::urdf_detail {

/// Allowed error of a printed inertia, relative to the largest moment: URDFs often print only three digits.
constexpr double printed_inertia_slack = 1e-3;

/// The smallest principal moment, relative to the largest entry of I_C; 0 if I_C is 0.
double smallestMoment(const Inertia<double>& I);

/// whyUnphysical, which tolerates printed_inertia_slack unless a moment is negative by more than rounding.
std::string whyUnphysicalLink(const Inertia<double>& I);

/// The model's name if the robot has none.
inline const std::string unnamed_robot = "unnamed";

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
  std::string parent, child;  ///< the links that the joint connects
  SE3<double> X_PJ;           ///< <origin>, in the frame of the parent link
  Vector3<double> axis;       ///< not normalised; not zero if the type has one coordinate
  std::optional<Limit> limit;
  std::optional<Dynamics> dynamics;
  std::optional<Mimic> mimic;
};

struct LinkDescription {
  int line = 0;
  Inertia<double> inertia = Inertia<double>::Zero();  ///< in the link's frame
};

struct Description {
  /// A link whose inertia no body can have, for a warning.
  struct UnphysicalLink {
    std::string link;
    int line;
    std::string what, value;
  };
  std::string name, root;  ///< names of the robot (it may be empty) and of its root link
  int line = 0;
  std::map<std::string, LinkDescription> links;
  std::map<std::string, JointDescription> joints;
  std::map<std::string, std::vector<std::string>> joints_below;  ///< of each link, in alphabetical order
  std::vector<UnphysicalLink> unphysical_links;
};

/// The robot of a text. Throws UrdfError unless the text is well-formed XML of one robot: a tree of named
/// links and joints of supported types, with finite numbers and masses >= 0.
Description describe(const std::string& text, const UrdfOptions& options, Messages& messages);

}  // namespace liecheck::urdf_detail
