#pragma once
// Arguments whose values are of some kinds, of which a library may have some only: an order of Euler angles, slerp at
// t = 1/2, a twist about the axes x, y and z.

#include <cstdint>
#include <operations/description.hpp>
#include <span>
#include <string>
#include <vector>

namespace liecheck::properties {

struct ArgumentKinds {
  std::string_view part;  ///< the name of the argument's part
  int count;
  int (*kind)(std::span<const double> value);  ///< of a value; -1 if it is of none
  std::vector<double> (*example)(int kind);
  std::vector<std::string_view> names;  ///< in words; empty if there are too many
  std::uint32_t every() const { return (1u << count) - 1; }
};

/// Of an order of Euler angles.
extern const ArgumentKinds order_kinds;
/// Of t: 0, 1/2, 1, any other.
extern const ArgumentKinds fraction_kinds;
/// Of an axis: x, y, z, any other.
extern const ArgumentKinds axis_kinds;

/// The kinds of an argument of the operation, or null; `first` is the place of its first number.
const ArgumentKinds* argument_kinds(const Operation& operation, std::size_t& first);

/// "fractions_0_1": the kinds whose bits are set; "" if all are.
std::string text_of(const ArgumentKinds& kinds, const char* plural, std::uint32_t taken);

}  // namespace liecheck::properties
