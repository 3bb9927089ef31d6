#pragma once
// What a property's input is made of: groups of numbers, each of a kind that generators, searches, shrinking and
// coverage know.

#include <string>

namespace liecheck::properties {

/// How a group of numbers of an input is shrunk while it stays valid.
enum class Kind {
  vector,
  rotation_vector,
  quaternion,
  rotation_matrix,
  inertia,
  positive,
  choice,
  opaque,
  parents,  ///< of the joints of a tree, -2 where there is none
  joints,   ///< their kinds, and the primaries of mimics
  masses    ///< of their bodies, 0 where there is none
};

/// How far the generator of a group goes: angles beyond pi and scales to 1e150, or what the law allows; beside:
/// as far, and often next to the group of its kind before it; any: nothing is promised of it.
enum class Reach { limited, full, beside, any };

/// A group of consecutive numbers of a property's input.
struct Field {
  std::string name;
  Kind kind;
  int size;
  std::string unit;
  Reach reach = Reach::limited;
};

}  // namespace liecheck::properties
