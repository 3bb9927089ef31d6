#pragma once
// What the joints of a tree may be: of some kinds, mimics of another joint, and with an armature.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace liecheck::oracles {

enum class JointKind { revolute, continuous, prismatic, helical, spherical, planar, translation, free_flyer };

/// The kinds in the order of JointKind, then "mimic" and "armature".
inline constexpr std::array<std::string_view, 10> joint_names{
    "revolute", "continuous",  "prismatic",  "helical", "spherical",
    "planar",   "translation", "free-flyer", "mimic",   "armature"};
inline constexpr int joint_kinds = 8;

/// A set of these names; by default all.
class JointSet {
 public:
  JointSet() = default;
  /// The named ones; all if there are none. A name that is not among joint_names is ignored.
  template <class Names>
  explicit JointSet(const Names& names) {
    if (names.empty()) return;
    has_ = 0;
    for (std::size_t i = 0; i < joint_names.size(); ++i)
      for (const auto& name : names)
        if (name == joint_names[i]) has_ |= 1u << i;
  }
  bool has(JointKind kind) const { return has_ >> static_cast<int>(kind) & 1; }
  bool mimics() const { return has_ >> 8 & 1; }
  bool armatures() const { return has_ >> 9 & 1; }
  bool everything() const { return has_ == all; }
  /// Whether it has a kind of joint that moves.
  bool moves() const { return has_ & ((1u << joint_kinds) - 1); }
  /// "revolute_free-flyer"
  std::string text() const {
    std::string names;
    for (std::size_t i = 0; i < joint_names.size(); ++i)
      if (has_ >> i & 1) names.append(names.empty() ? "" : "_").append(joint_names[i]);
    return names;
  }

 private:
  static constexpr std::uint32_t all = (1u << joint_names.size()) - 1;
  std::uint32_t has_ = all;
};

}  // namespace liecheck::oracles
