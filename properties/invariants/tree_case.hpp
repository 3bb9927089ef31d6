#pragma once
// Converts a list of numbers (generators/trees.hpp) to a tree of bodies and its state.

#include <generators/tree_layout.hpp>
#include <subjects/tree.hpp>

namespace liecheck::properties {

/// A tree of bodies with its state, a frame and a wrench, in the number type T.
template <class T>
struct TreeCase {
  oracles::TreeOf<T> tree;
  std::vector<T> q, v, a, d;
  std::vector<oracles::WrenchOf<T>> wrench;
  int frame_joint = 0;
  oracles::Quaternion<T> frame_Q;
  oracles::Vec3<T> frame_p;
  std::shared_ptr<const UrdfModel> urdf;  ///< where the tree is from, or null

  /// Reads parents, kinds and other integers from `structure`, and all other numbers from `x`.
  TreeCase(TreeLayout at, const std::vector<double>& structure, const std::vector<T>& x) {
    using namespace oracles;
    const auto whole = [&](int i) { return static_cast<int>(structure[static_cast<std::size_t>(i)]); };
    const auto number = [&](int i) -> const T& { return x[static_cast<std::size_t>(i)]; };
    const auto three = [&](int i) -> Vec3<T> { return {{number(i), number(i + 1), number(i + 2)}}; };
    const auto four = [&](int i) -> Quaternion<T> {
      return {{number(i), number(i + 1), number(i + 2), number(i + 3)}};
    };
    tree.gravity = three(at.gravity());
    int joints = 0;
    while (joints < at.slots && whole(at.parent(joints)) > absent_joint) ++joints;
    tree.joints.reserve(static_cast<std::size_t>(joints));
    for (auto* numbers : {&q, &v, &a, &d}) numbers->reserve(static_cast<std::size_t>(2 * joints));
    for (int i = 0; i < joints; ++i) {
      using Slot = TreeSlot;
      const int slot = at.slot(i);
      JointOf<T> j;
      j.kind = static_cast<JointKind>(whole(at.kind(i)));
      j.parent = whole(at.parent(i)), j.primary = whole(at.primary(i));
      j.Q = four(slot + Slot::Q), j.p = three(slot + Slot::p), j.axis = three(slot + Slot::axis);
      j.pitch = number(slot + Slot::pitch), j.multiplier = number(slot + Slot::multiplier);
      j.offset = number(slot + Slot::offset), j.armature = number(slot + Slot::armature);
      j.body.mass = number(at.mass(i)), j.body.c = three(slot + Slot::c);
      Vec6<T> I;
      for (int k = 0; k < 6; ++k) I[k] = number(slot + Slot::I + k);
      j.body.I_C = symmetric(I);
      tree.joints.push_back(j);
      if (j.primary >= 0) continue;
      const auto add = [&](std::vector<T>& to, int from, int n) {
        for (int k = 0; k < n; ++k) to.push_back(number(slot + from + k));
      };
      const bool rotates = j.kind == JointKind::free_flyer || j.kind == JointKind::spherical;
      const bool turns = j.kind == JointKind::continuous || j.kind == JointKind::planar;
      const int all = configuration_size(j.kind), rest = rotates ? 4 : turns ? 2 : 0;
      add(q, Slot::q_p, all - rest);
      add(q, rotates ? Slot::q_Q : Slot::q_circle, rest);
      for (auto [to, from] : {std::pair(&v, +Slot::v), std::pair(&a, +Slot::a), std::pair(&d, +Slot::d)})
        add(*to, from, velocity_size(j.kind));
    }
    tree.index();
    frame_joint = whole(at.frame()), frame_Q = four(at.frame() + 1), frame_p = three(at.frame() + 5);
    if (const int on = whole(at.wrench()); on >= 0)
      wrench.push_back({on, stack(three(at.wrench() + 1), three(at.wrench() + 4))});
  }
};

/// The tree as a subject receives it.
template <class S>
Tree<S> described(const TreeCase<S>& c) {
  Tree<S> t;
  static_cast<oracles::TreeOf<S>&>(t) = c.tree;
  t.frame_joint = c.frame_joint, t.frame_Q = c.frame_Q, t.frame_p = c.frame_p;
  t.urdf = c.urdf;
  return t;
}
template <class S>
VecX<S> eigen(const std::vector<S>& x) {
  return Eigen::Map<const VecX<S>>(x.data(), static_cast<Eigen::Index>(x.size()));
}
inline Vec<double, 6> eigen(const std::vector<oracles::WrenchOf<double>>& wrench) {
  if (wrench.empty()) return Vec<double, 6>::Zero();
  return Eigen::Map<const Vec<double, 6>>(wrench[0].F.x.data());
}

}  // namespace liecheck::properties
