#pragma once
// The order of the numbers of a random tree (trees.hpp).
//
// The list has the parents, kinds, primaries and masses of all slots; gravity; a frame and a wrench, each on
// a joint; and the numbers of each slot (TreeSlot). A joint that is not a mimic has the primary -1. An absent
// joint has the parent and kind absent_joint, mass 0, identity rotations, and zeros in its slot otherwise.

#include <cstddef>

namespace liecheck::properties {

inline constexpr int tree_slots = 5;
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
  int parents() const { return 0; }
  int kinds() const { return slots; }
  int primaries() const { return 2 * slots; }
  int masses() const { return 3 * slots; }
  int gravity() const { return 4 * slots; }
  int frame() const { return gravity() + 3; }  ///< joint, Q, p
  int wrench() const { return frame() + 8; }   ///< joint, f, n
  int slot(int i) const { return wrench() + 7 + i * TreeSlot::size; }
  std::size_t size() const { return static_cast<std::size_t>(slot(slots)); }
};

}  // namespace liecheck::properties
