#pragma once
// The classes of inputs on which code breaks, for each kind of a group of numbers, and the minimum share of
// cases that a generator must produce for each class.

#include <cstdint>
#include <generators/input_layout.hpp>
#include <span>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A class of inputs of one kind. A generator gives it at least once in `one_in` cases; a test measures this.
struct InputClass {
  std::string name;
  std::uint64_t one_in;
  Reach reach = Reach::limited;  ///< the fields with this reach require the class; limited: all fields
};

/// The classes of a kind, empty for a kind without classes. Bit i of a mask stands for entry i.
const std::vector<InputClass>& classes_of(Kind kind);
/// Whether inputs of the field must reach the class, one of classes_of(field.kind).
bool requires_class(const Field& field, const InputClass& c);

/// The mask of the classes that contain x. `earlier` is the previous group of the same kind, or empty.
template <class S>
std::uint32_t classify(Kind kind, std::span<const S> x, std::span<const S> earlier);

}  // namespace liecheck::properties
