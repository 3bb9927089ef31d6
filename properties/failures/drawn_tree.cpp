#include <failures/drawn_tree.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <failures/pairs.hpp>
#include <invariants/tree_case.hpp>
#include <invariants/tree_laws.hpp>
#include <operations/trees.hpp>
#include <oracles/joint_set.hpp>
#include <tuple>

namespace liecheck::properties {
namespace {

using Numbers = std::span<const double>;

std::string in_brackets(Numbers x) {
  std::vector<double> numbers;
  for (const double number : x) numbers.push_back(number + 0.0);  // 0 for -0
  return fmt::format("({:.6g})", fmt::join(numbers, ", "));
}
bool all_zero(Numbers x) {
  return std::ranges::all_of(x, [](double number) { return number == 0; });
}

/// ", at (1, 0, 0), turned by Q (1, 0, 0, 0)", without what is zero or the identity.
std::string placed(Numbers p, Numbers Q) {
  std::string text;
  if (!all_zero(p)) text += ", at " + in_brackets(p);
  if (!all_zero(Q.first(3))) text += ", turned by Q " + in_brackets(Q);
  return text;
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
  text += placed(j.p.x, j.Q.x);
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

/// Whether what fails depends on an argument, or on a vector with which a law multiplies its result.
bool takes(const Output& output, std::string_view name) {
  const FormedNumbers* const formed = formed_numbers(output);
  return std::ranges::any_of(output.record->arguments, [&](const Layout* l) { return l->name == name; }) ||
         (formed && formed->vectors.find(name) != std::string_view::npos);
}

/// The forces that a law gives: none acts on a base whose momentum is conserved.
std::vector<double> tau_of(const Output& output, std::vector<double> all) {
  if (output.operation == op::momentum_conserved.name)
    std::fill_n(all.begin(), std::min<std::size_t>(6, all.size()), 0.0);
  return all;
}

}  // namespace

bool is_weightless(const Series& series) {
  return series.property == "tree_momentum" || series.property == "mass_matrix";
}

std::string drawn_tree(const Series& series, const CaseId& id, const Output& output,
                       const std::string& seen) {
  constexpr std::size_t most = 8;
  if (!is_tree_law(series.property) || series.on_robot) return "";
  const std::vector<double> x = series.parsed(id);
  const TreeCase<double> c(TreeLayout::of_size(x.size()), x, x);
  if (c.tree.joints.size() > most) return "";
  const auto gravity = is_weightless(series) ? oracles::zero_vector<3, double>() : c.tree.gravity;
  const std::vector<double> tau = tau_of(output, c.a);
  std::string text;
  const auto line = [&](const char* what, const std::string& words) {
    text += fmt::format("   {:<8} {}\n", what, words);
  };
  for (std::size_t i = 0; i < c.tree.joints.size(); ++i)
    line(i == 0 ? "tree" : "", joint_line(i + 1, c.tree.joints[i]));
  line("", "gravity " + in_brackets(gravity.x));
  line("", "q = " + in_brackets(c.q));
  const bool inverse = takes(output, op::tree_tau.name);  // the law gives tau what it gives a
  for (const auto& [name, argument, numbers] :
       {std::tuple("v", op::tree_v.name, &c.v), std::tuple("tau", op::tree_tau.name, &tau),
        std::tuple("a", op::tree_a.name, &c.a),
        std::tuple("in the direction d", std::string_view("d"), &c.d)})
    if (takes(output, argument) && !(inverse && argument == op::tree_a.name) && !all_zero(*numbers))
      line("", fmt::format("{} = {}", name, in_brackets(*numbers)));
  if (output.operation.starts_with("frame_") || takes(output, op::seen.name))
    line("", fmt::format("frame on joint {}{}{}", c.frame_joint + 1, placed(c.frame_p.x, c.frame_Q.x),
                         seen.empty() ? "" : ", seen in " + seen));
  if (takes(output, op::wrench.name) && !c.wrench.empty() && !all_zero(c.wrench[0].F.x))
    line("", fmt::format("wrench {} on joint {}", in_brackets(c.wrench[0].F.x), c.wrench[0].joint + 1));
  return text;
}

}  // namespace liecheck::properties
