#include <invariants/tree_program.hpp>

#include <fmt/format.h>
#include <sstream>

namespace liecheck::properties {
namespace {

using oracles::JointKind;

std::string number(double x) {
  return fmt::format("S({:a})", x);
}
template <class Numbers>
std::string list(const Numbers& x) {
  std::string text;
  for (const double& value : x) text += (text.empty() ? "" : ", ") + number(value);
  return text;
}
std::string three(const oracles::Vec3<double>& v) {
  return "Vector3<S>(" + list(v.x) + ")";
}
std::string pose(const oracles::Quaternion<double>& Q, const oracles::Vec3<double>& p) {
  return fmt::format("SE3<S>(SO3<S>(Vector4<S>({})).normalized(), {})", list(Q.x), three(p));
}
std::string joint(const oracles::JointOf<double>& j) {
  const std::string axis = three(j.axis);
  switch (j.kind) {
    case JointKind::revolute:
      return "Revolute<S>(" + axis + ")";
    case JointKind::prismatic:
      return "Prismatic<S>(" + axis + ")";
    case JointKind::helical:
      return fmt::format("Helical<S>({}, {})", axis, number(j.pitch));
    case JointKind::continuous:
      return "Continuous<S>(" + axis + ")";
    case JointKind::spherical:
      return "Spherical<S>()";
    case JointKind::planar:
      return "Planar<S>()";
    case JointKind::translation:
      return "Translation<S>()";
    case JointKind::free_flyer:
      break;
  }
  return "FreeFlyer<S>()";
}
std::string vector(const char* name, const std::vector<double>& x) {
  std::string text = fmt::format("  VectorX<S> {}({});\n", name, x.size());
  if (!x.empty()) text += fmt::format("  {} << {};\n", name, list(x));
  return text;
}

}  // namespace

std::string tree_program(const TreeCase<double>& c, const Call& call, const std::string& scalar) {
  std::string text = fmt::format(
      "// c++ -std=gnu++20 -I lib $(pkg-config --cflags eigen3) case.cpp -lliecheck_lib\n"
      "#include <iostream>\n#include <vector>\n#include <liecheck/{}>\nusing namespace "
      "liecheck;\n"
      "int main() {{\n  using S = {};\n  Model<S> model;\n  model.gravity = {};\n  int i = 0;\n",
      call.header, scalar, three(c.tree.gravity));
  for (std::size_t k = 0; k < c.tree.joints.size(); ++k) {
    const oracles::JointOf<double>& j = c.tree.joints[k];
    const std::string kind = j.primary < 0 ? joint(j)
                                           : fmt::format("Mimic<S>({}, {}, {}, {})", joint(j), j.primary + 1,
                                                         number(j.multiplier), number(j.offset));
    const auto& I = j.body.I_C;
    const double entries[] = {I(0, 0), I(0, 1), I(0, 2), I(1, 0), I(1, 1),
                              I(1, 2), I(2, 0), I(2, 1), I(2, 2)};
    text += fmt::format(
        "  i = model.addJoint({}, {}, {}, \"{}\");\n"
        "  model.appendBodyToJoint(i, Inertia<S>({}, {}, (Matrix3<S>() << {}).finished()));\n",
        j.parent + 1, kind, pose(j.Q, j.p), k, number(j.body.mass), three(j.body.c), list(entries));
    if (j.primary < 0 && j.armature != 0)
      text +=
          fmt::format("  model.armature.tail(model.nvs[{}]).setConstant({});\n", k + 1, number(j.armature));
  }
  const std::string uses = std::string(call.before) + std::string(call.expression);
  const auto mentions = [&](const std::string& word) { return uses.find(word) != std::string::npos; };
  if (mentions("frame"))
    text +=
        fmt::format("  const auto frame = model.addFrame({{\"frame\", {}, 0, {}, FrameType::OP_FRAME}});\n",
                    c.frame_joint + 1, pose(c.frame_Q, c.frame_p));
  text +=
      "  Data<S> data(model, Dense::Derivatives);\n" + vector("q", c.q) + vector("v", c.v) + vector("a", c.a);
  if (mentions("tau")) text += "  VectorX<S> tau = a;\n";
  if (mentions("* d)")) text += vector("d", c.d);
  if (mentions(", on)")) {
    text += fmt::format("  std::vector<Force<S>> on(std::size_t(model.njoints), Force<S>::Zero());\n");
    for (const auto& w : c.wrench)
      text += fmt::format(
          "  on[{}] = Force<S>({}, {});\n", w.joint + 1,
          fmt::format("Vector3<S>({})", list(std::vector<double>(w.F.x.begin(), w.F.x.begin() + 3))),
          fmt::format("Vector3<S>({})", list(std::vector<double>(w.F.x.begin() + 3, w.F.x.end()))));
  }
  text += "  std::cout.precision(17);\n";
  const std::string indent = mentions("seen") ? "    " : "  ";
  if (mentions("seen"))
    text +=
        "  for (auto seen : {ReferenceFrame::WORLD, ReferenceFrame::LOCAL, "
        "ReferenceFrame::LOCAL_WORLD_ALIGNED}) {\n";
  std::istringstream before{std::string(call.before)};
  for (std::string line; std::getline(before, line);) text += indent + line + "\n";
  text += fmt::format("{}std::cout << {} << '\\n';\n", indent, call.expression);
  return text + (mentions("seen") ? "  }\n}\n" : "}\n");
}

}  // namespace liecheck::properties
