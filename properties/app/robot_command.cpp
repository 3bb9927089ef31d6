#include <fmt/format.h>

#include <liecheck/urdf/urdf.hpp>
#include <app/robot_command.hpp>

namespace liecheck::properties {

int run_robot_command(const RobotFlags& flags) {
  UrdfOptions options;
  options.strict = flags.strict;
  options.mimic = flags.tied ? MimicJoints::Tied : MimicJoints::Independent;
  if (flags.root == "free-flyer") options.root = RootJoint::FreeFlyer;
  if (flags.root == "planar") options.root_joint = Planar<double>();
  if (flags.root == "spherical") options.root_joint = Spherical<double>();
  if (flags.root == "translation") options.root_joint = Translation<double>();
  const auto [model, warnings] = loadUrdf(flags.file, options);
  double mass = 0;
  for (const auto& body : model.inertias) mass += body.mass();
  fmt::print("{}: nq {}, nv {}, {} joints with the universe, {} frames, {:.6g} kg\n", model.name, model.nq,
             model.nv, model.njoints, model.nframes, mass);
  fmt::print("{:>5} {:>6} {:>5} {:>5}  {:<38} {}\n", "joint", "parent", "idx_q", "idx_v", "type", "name");
  for (std::size_t i = 1; i < model.joints.size(); ++i)
    fmt::print("{:>5} {:>6} {:>5} {:>5}  {:<38} {}\n", i, model.parents[i], model.idx_qs[i], model.idx_vs[i],
               shortname<double>(model.joints[i]), model.names[i]);
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
  return 0;
}

}  // namespace liecheck::properties
