#include <campaign/robots.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/digest.hpp>
#include <cmath>
#include <generators/random_bits.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <span>
#include <support/embedded.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

Robot robot_of(const std::string& urdf, const std::string& path, bool fixed,
               std::vector<std::string>* warnings) {
  Robot r;
  r.urdf = urdf, r.path = path, r.fixed = fixed;
  r.hash = hexadecimal(sha256(fixed ? urdf + "\nroot fixed\n" : urdf)).substr(0, 16);
  const std::string source = path.empty() ? "the built-in robot" : path;
  UrdfRobot read = loadUrdfText(urdf, {.root = fixed ? RootJoint::Fixed : RootJoint::FreeFlyer}, source);
  const Model<double>& model = read.model;
  if (model.nv == 0)
    throw UrdfError(source, 0, "nothing moves: every joint is fixed, and --root is fixed", model.name);
  // Measured of mass_matrix: 0.16, 0.56 and more than 2 GB with 500, 1000 and 3000 joints.
  if (constexpr int most = 1000; model.nv > most)
    throw UrdfError(source, 0, fmt::format("too large for the laws, which take at most {} velocities", most),
                    fmt::format("{} velocities", model.nv));
  for (std::size_t j = 1; j < model.joints.size(); ++j)
    if (model.nqs[j] == 4)
      throw UrdfError(source, 0, "a planar joint: no law supports one yet", model.names[j]);
  r.name = model.name;
  r.mimics = std::ranges::any_of(read.warnings, [](const std::string& w) {
    return w.find(" is a mimic and is treated as independent") != w.npos;
  });
  // Measured of tree_momentum: 0.4, 2 and 16 s with 100, 200 and 400 joints.
  if (const double joints = model.njoints - 1; joints > 200)
    read.warnings.push_back(fmt::format(
        "{}: {} joints: a case of a law on trees takes about {:.0f} s, a time that grows with the cube of "
        "the joints",
        source, joints, 2 * std::pow(joints / 200, 3)));
  if (std::ranges::all_of(std::span(model.inertias).subspan(1), [](const auto& i) { return i.mass() == 0; }))
    read.warnings.push_back(source +
                            ": no body that moves has a mass: it has no centre of mass, so that the law "
                            "tree_momentum does not apply, and what solves with M is undefined");
  if (warnings) *warnings = std::move(read.warnings);
  return r;
}

Robot load_robot(const std::string& path, bool fixed, std::vector<std::string>* warnings) {
  return robot_of(readUrdf(path), path, fixed, warnings);
}

std::string robot_flags(const Robot& robot) {
  return " --robot " + shell_quoted(robot.path) + (robot.fixed ? " --root fixed" : "");
}

Robot built_in_robot() {
  return robot_of(built_in_robot_urdf, "");
}

}  // namespace liecheck::properties
