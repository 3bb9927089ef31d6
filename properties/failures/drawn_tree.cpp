#include <failures/drawn_tree.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <invariants/tree_case.hpp>
#include <invariants/tree_laws.hpp>
#include <oracles/joint_set.hpp>

namespace liecheck::properties {
namespace {

using Numbers = std::span<const double>;

std::string in_brackets(Numbers x) {
  return fmt::format("({:.6g})", fmt::join(x, ", "));
}
bool all_zero(Numbers x) {
  return std::ranges::all_of(x, [](double number) { return number == 0; });
}

/// "2  revolute on joint 1, axis (0, 0, 1), at (1, 0, 0); mass 1, c (0, 0, 1)". What is zero, or the identity, is left out.
std::string joint_line(std::size_t number, const oracles::JointOf<double>& j) {
  using oracles::JointKind;
  std::string text =
      fmt::format("{}  {} on {}", number, oracles::joint_names[static_cast<std::size_t>(j.kind)],
                  j.parent < 0 ? std::string("the world") : fmt::format("joint {}", j.parent + 1));
  const bool has_axis = j.kind == JointKind::revolute || j.kind == JointKind::continuous ||
                        j.kind == JointKind::prismatic || j.kind == JointKind::helical;
  if (has_axis) text += ", axis " + in_brackets(j.axis.x);
  if (j.kind == JointKind::helical) text += fmt::format(", pitch {:.6g}", j.pitch);
  if (!all_zero(j.p.x)) text += ", at " + in_brackets(j.p.x);
  if (j.Q[3] != 1) text += ", turned by Q " + in_brackets(j.Q.x);
  if (j.primary >= 0)
    text +=
        fmt::format(", moves as {:.6g} times joint {} plus {:.6g}", j.multiplier, j.primary + 1, j.offset);
  if (j.armature != 0) text += fmt::format(", armature {:.6g}", j.armature);
  text += fmt::format("; mass {:.6g}", j.body.mass);
  if (!all_zero(j.body.c.x)) text += ", c " + in_brackets(j.body.c.x);
  const std::array<double, 6> I{j.body.I_C(0, 0), j.body.I_C(1, 1), j.body.I_C(2, 2),
                                j.body.I_C(0, 1), j.body.I_C(0, 2), j.body.I_C(1, 2)};
  if (!all_zero(I))
    text += all_zero(Numbers(I).last(3)) ? ", moments " + in_brackets(Numbers(I).first(3))
                                         : ", Ixx Iyy Izz Ixy Ixz Iyz " + in_brackets(I);
  return text;
}

}  // namespace

std::string drawn_tree(const Series& series, const CaseId& id) {
  constexpr std::size_t most = 8;
  if (!is_tree_law(series.property) || series.on_robot) return "";
  const std::vector<double> x = series.parsed(id);
  const TreeCase<double> c(TreeLayout::of_size(x.size()), x, x);
  if (c.tree.joints.size() > most) return "";
  std::string text;
  const auto line = [&](const char* what, const std::string& words) {
    text += fmt::format("   {:<8} {}\n", what, words);
  };
  for (std::size_t i = 0; i < c.tree.joints.size(); ++i)
    line(i == 0 ? "tree" : "", joint_line(i + 1, c.tree.joints[i]));
  line("", "gravity " + in_brackets(c.tree.gravity.x));
  line("", "q = " + in_brackets(c.q));
  for (const auto& [name, numbers] :
       {std::pair("v", &c.v), std::pair("a", &c.a), std::pair("increment", &c.d)})
    if (!all_zero(*numbers)) line("", fmt::format("{} = {}", name, in_brackets(*numbers)));
  if (!all_zero(c.frame_p.x) || c.frame_Q[3] != 1)
    line("", fmt::format("frame on joint {}, at {}, turned by Q {}", c.frame_joint + 1,
                         in_brackets(c.frame_p.x), in_brackets(c.frame_Q.x)));
  if (!c.wrench.empty())
    line("", fmt::format("wrench {} on joint {}", in_brackets(c.wrench[0].F.x), c.wrench[0].joint + 1));
  return text;
}

}  // namespace liecheck::properties
