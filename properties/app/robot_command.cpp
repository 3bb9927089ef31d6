#include <fmt/format.h>
#include <app/command.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <support/say.hpp>
#include <support/text.hpp>

namespace liecheck::properties {

namespace {

struct RobotChecksFlags {
  std::string file, root = "fixed";
  bool tied = false, strict = false;
};

UrdfOptions options_of(const RobotChecksFlags& f) {
  UrdfOptions options;
  options.strict = f.strict;
  options.mimic = f.tied ? MimicJoints::Tied : MimicJoints::Independent;
  if (f.root == "free-flyer") options.root = RootJoint::FreeFlyer;
  if (f.root == "planar") options.root_joint = Planar<double>();
  if (f.root == "spherical") options.root_joint = Spherical<double>();
  if (f.root == "translation") options.root_joint = Translation<double>();
  return options;
}

/// Prints the joints with their indices in q and v, and the warnings.
int run(const RobotChecksFlags& f) {
  const auto [model, warnings] = loadUrdf(f.file, options_of(f));
  double mass = 0;
  for (const auto& body : model.inertias) mass += body.mass();
  say("{}: nq {}, nv {}, {} joints including the universe, {} frames, {:.6g} kg\n", printable(model.name),
      model.nq, model.nv, model.njoints, model.nframes, mass);
  say("{:>5} {:>6} {:>5} {:>5}  {:<38} {}\n", "joint", "parent", "idx_q", "idx_v", "type", "name");
  for (std::size_t i = 1; i < model.joints.size(); ++i)
    say("{:>5} {:>6} {:>5} {:>5}  {:<38} {}\n", i, model.parents[i], model.idx_qs[i], model.idx_vs[i],
        shortname<double>(model.joints[i]), printable(model.names[i]));
  print_warnings(warnings);
  return within_budget;
}

}  // namespace

Command robot_command(CLI::App& program) {
  CommandWith<RobotChecksFlags> a(
      program, "robot", "show the model of a URDF: joints, indices, warnings. Exit code 0; 2 for bad input");
  a.text("FILE", a->file, "URDF", "the URDF").required();
  a.choice("--root", a->root, {"fixed", "free-flyer", "planar", "spherical", "translation"}, "",
           "the joint between root and world");
  a.toggle("--mimic", a->tied,
           "mimic joints follow the joint named in their <mimic> and have no coordinates in q and v");
  a.toggle("--strict", a->strict, "treat a warning as an error");
  return a.runs(run);
}

}  // namespace liecheck::properties
