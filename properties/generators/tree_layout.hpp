#pragma once
// The order of the numbers of a random tree (trees.hpp).
//
// The list has the parents, kinds, primaries and masses of the listed slots; gravity; a frame and a wrench,
// each on a joint; and the numbers of each listed slot (TreeSlot). A joint that is not a mimic has the primary
// -1. An absent joint has the parent and kind absent_joint, mass 0, identity rotations, and zeros in its slot
// otherwise. A tree with more joints than listed slots goes on with the parent, kind, primary, mass and slot
// of each further joint. So most trees are short lists, and the fields of a law are at the same places.

#include <cstddef>

namespace liecheck::properties {

inline constexpr int tree_slots = 5;    ///< listed slots of a random tree
inline constexpr int most_joints = 40;  ///< of a random tree
inline constexpr int absent_joint = -2;

/// The offsets of a joint's numbers in its slot.
struct TreeSlot {
  enum { Q = 0, p = 4, axis = 7, pitch = 10, multiplier, offset, armature, c, I = c + 3 };
  enum {
    q_p = I + 6,
    q_Q = q_p + 3,
    q_circle = q_Q + 4,
    v = q_circle + 2,
    a = v + 6,
    d = a + 6,
    size = d + 6
  };
};
/// The offsets in the whole list.
struct TreeLayout {
  int slots;
  int listed = slots;
  /// The layout of a random tree of so many joints, and of a random tree that is a list of `size` numbers.
  static TreeLayout of_joints(int n) { return {n < tree_slots ? tree_slots : n, tree_slots}; }
  static TreeLayout of_size(std::size_t size) {
    const int further = (static_cast<int>(size) - of_joints(0).end_of_listed()) / further_size;
    return of_joints(tree_slots + (further < 0 ? 0 : further));
  }

  int parent(int i) const { return i < listed ? i : further(i); }
  int kind(int i) const { return i < listed ? listed + i : further(i) + 1; }
  int primary(int i) const { return i < listed ? 2 * listed + i : further(i) + 2; }
  int mass(int i) const { return i < listed ? 3 * listed + i : further(i) + 3; }
  int gravity() const { return 4 * listed; }
  int frame() const { return gravity() + 3; }  ///< joint, Q, p
  int wrench() const { return frame() + 8; }   ///< joint, f, n
  int slot(int i) const { return i < listed ? wrench() + 7 + i * TreeSlot::size : further(i) + 4; }
  std::size_t size() const { return static_cast<std::size_t>(further(slots)); }

 private:
  static constexpr int further_size = 4 + TreeSlot::size;
  int end_of_listed() const { return wrench() + 7 + listed * TreeSlot::size; }
  int further(int i) const { return end_of_listed() + (i - listed) * further_size; }
};

}  // namespace liecheck::properties
