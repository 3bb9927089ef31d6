#pragma once
// The numbers of a random tree (generators/tree_layout.hpp) by what they are.

#include <Eigen/Geometry>
#include <cmath>
#include <generators/tree_layout.hpp>
#include <oracles/tree.hpp>
#include <span>
#include <vector>

namespace liecheck::properties {

/// A random tree as the list of its numbers, by what they are.
class TreeNumbers {
 public:
  using Span = std::span<double>;
  using JointKind = oracles::JointKind;

  explicit TreeNumbers(std::vector<double>& x) : x_(x), at_(TreeLayout::of_size(x.size())) {}

  int joints() const {
    int n = 0;
    while (n < at_.slots && parent(n) > absent_joint) ++n;
    return n;
  }
  int parent(int joint) const { return static_cast<int>(part(at_.parent(joint), 1)[0]); }
  /// Hangs a joint on another one, or on the world (-1).
  void hang(int joint, int on) const { part(at_.parent(joint), 1)[0] = on; }
  JointKind kind(int joint) const {
    return static_cast<JointKind>(static_cast<int>(part(at_.kind(joint), 1)[0]));
  }
  int primary(int joint) const { return static_cast<int>(part(at_.primary(joint), 1)[0]); }
  double& mass(int joint) const { return part(at_.mass(joint), 1)[0]; }
  Span of_joint(int joint, int from, int size) const { return part(at_.slot(joint) + from, size); }
  Span gravity() const { return part(at_.gravity(), 3); }
  double& frame_joint() const { return part(at_.frame(), 1)[0]; }
  Span frame_Q() const { return part(at_.frame() + 1, 4); }
  Span frame_p() const { return part(at_.frame() + 5, 3); }
  double& wrench_joint() const { return part(at_.wrench(), 1)[0]; }
  Span force() const { return part(at_.wrench() + 1, 3); }
  Span moment() const { return part(at_.wrench() + 4, 3); }
  /// The rotation from a joint's axes to the world's.
  Eigen::Quaterniond in_world(int joint) const {
    using enum JointKind;
    Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
    for (int i = joint; i >= 0; i = parent(i)) {
      const int primary = this->primary(i), from = primary < 0 ? i : primary;
      const Span c = of_joint(from, TreeSlot::q_circle, 2);
      const bool on_circle = kind(i) == continuous || kind(i) == planar;
      double angle = on_circle ? std::atan2(c[1], c[0]) : of_joint(from, TreeSlot::q_p, 1)[0];
      if (primary >= 0)
        angle = of_joint(i, TreeSlot::multiplier, 1)[0] * angle + of_joint(i, TreeSlot::offset, 1)[0];
      const Eigen::Vector3d axis(of_joint(i, TreeSlot::axis, 3).data());
      Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
      if (kind(i) == spherical || kind(i) == free_flyer)
        turned = Eigen::Quaterniond(of_joint(i, TreeSlot::q_Q, 4).data());
      else if (kind(i) == planar)
        turned = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
      else if (kind(i) == revolute || kind(i) == helical || kind(i) == continuous)
        turned = Eigen::AngleAxisd(angle, axis.normalized());
      R = Eigen::Quaterniond(of_joint(i, TreeSlot::Q, 4).data()) * turned * R;
    }
    return R;
  }
  /// Turns two numbers of a planar joint by its angle, or back.
  void turn_in_plane(int joint, int from, bool back) const {
    const Span circle = of_joint(joint, TreeSlot::q_circle, 2), u = of_joint(joint, from, 2);
    const double sin = back ? -circle[1] : circle[1], x = u[0];
    u[0] = circle[0] * x - sin * u[1], u[1] = sin * x + circle[0] * u[1];
  }
  /// Hangs the wrench on another joint, if there is such a joint.
  void hang_wrench(int on) const {
    if (wrench_joint() >= 0 && on >= 0 && on < joints()) wrench_joint() = on;
  }

 private:
  Span part(int from, int size) const {
    return Span(x_).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(size));
  }
  std::vector<double>& x_;
  TreeLayout at_;
};

}  // namespace liecheck::properties
