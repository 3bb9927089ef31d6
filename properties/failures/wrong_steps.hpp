#pragma once
// What algorithms on trees of bodies would give with one wrong step: Featherstone's recursions in double, which name causes.

#include <fmt/format.h>
#include <failures/spatial_tree.hpp>
#include <functional>
#include <span>

namespace liecheck::properties::spatial {

struct Named {
  Step step;
  const char* text;
};
using enum Step;

using Numbers = std::vector<double>;
inline Numbers numbers_of(const Vector& x) {
  return {x.begin(), x.end()};
}
inline Numbers numbers_of(const Matrix& M) {  // row by row
  return numbers_of(Vector(M.transpose().reshaped()));
}

/// A wrong step in words that follow "the result is what" and stand before "would give". Its result is that of an operation's
/// block, for frames in the measurement's reference frame; none where the step does not occur.
struct WrongStep {
  std::string text;
  std::function<std::optional<Numbers>(const Tree&, std::size_t measurement)> result;
};

/// The simplest first; none of an operation that is no algorithm on trees.
std::vector<WrongStep> wrong_steps(std::string_view operation, std::string_view block);

class Steps {
 public:
  using Result = std::function<std::optional<Numbers>(const Tree&, std::size_t)>;
  std::vector<WrongStep> all;

  void add(std::string text, Result result) { all.push_back({std::move(text), std::move(result)}); }
  /// Of all joints, then of one kind.
  template <class F>
  void add(std::span<const Named> steps, const F& f) {
    for (int k = -1; k < oracles::joint_kinds; ++k)
      for (const Named& n : steps) {
        Wrong wrong(n.step);
        if (k >= 0) wrong.kind = static_cast<oracles::JointKind>(k);
        add(k < 0 ? n.text
                  : fmt::format("{} of {} joints", n.text, oracles::joint_names[static_cast<std::size_t>(k)]),
            [f, wrong](const Tree& t, [[maybe_unused]] std::size_t view) {
              if constexpr (std::is_invocable_v<F, const Tree&, const Wrong&, std::size_t>)
                return f(t, wrong, view);
              else
                return f(t, wrong);
            });
      }
  }
};

/// What changes V or A.
inline constexpr Named of_motions[]{
    {no_coriolis, "accelerations without V x (S v)"},
    {opposite_coriolis, "accelerations with -V x (S v)"},
    {no_linear_coriolis, "accelerations without the linear part of V x (S v)"},
    {no_angular_coriolis, "accelerations without the angular part of V x (S v)"},
    {own_velocities, "velocities S v of each joint without its parent's"},
    {own_accelerations, "accelerations of each joint without its parent's"},
    {turned_velocities, "velocities of the parent that are turned, but not moved, to the joint"},
    {turned_accelerations, "accelerations of the parent that are turned, but not moved, to the joint"},
    {turned_motions, "motions of the parent that are turned, but not moved, to the joint"}};

void add_frame_steps(Steps& s, std::string_view operation, std::string_view block);
void add_momenta(Steps& s, std::string_view block);
void add_energies(Steps& s);
void add_potentials(Steps& s);

}  // namespace liecheck::properties::spatial
