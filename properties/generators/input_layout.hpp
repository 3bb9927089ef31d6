#pragma once
// The layout of a property's input: groups of numbers. The kind of a group determines how its numbers are
// generated, mutated, shrunk and counted.

#include <cstdint>
#include <string>

namespace liecheck::properties {

enum class Kind {
  vector,
  rotation_vector,
  quaternion,      ///< of norm 1, up to 8 eps
  any_quaternion,  ///< of any norm
  rotation_matrix,
  inertia,
  positive,
  choice,
  opaque,
  direction,  ///< a vector of length 1 in space or in the plane, up to rounding
  fraction,   ///< a number in [0, 1]
  angle,      ///< angles [rad] up to pi in size, one or several
  parents,    ///< parents of the joints of a tree, -2 for an absent joint
  joints,     ///< kinds of the joints of a tree, then the primaries of mimics
  masses,     ///< masses of the bodies of a tree, 0 for an absent body
  near_rotation,  ///< a matrix A with |A^T A - I| <= 0.4 and a positive determinant
  covariance      ///< a symmetric positive matrix of 6 x 6, row by row
};
inline constexpr std::size_t kind_count = static_cast<std::size_t>(Kind::covariance) + 1;  // the last

/// The classes of inputs that the generator of a group must produce.
enum class Reach {
  limited,  ///< angles up to pi and moderate scales
  full,     ///< also angles beyond pi and scales up to 1e150
  beside,   ///< often values near the previous group of the same kind
  any       ///< no class is required
};

/// A group of consecutive numbers of a property's input.
struct Field {
  std::string name;
  Kind kind;
  int size;
  std::string unit;
  Reach reach = Reach::limited;
  std::uint32_t without = 0;  ///< bit i: its inputs are in no case of class i (input_classes.hpp)
};

}  // namespace liecheck::properties
