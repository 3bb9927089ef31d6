#pragma once
// The classes of inputs on which code breaks, for each kind of a group of numbers, and how rare a generator may make
// each of them.

#include <cstdint>
#include <generators/input_layout.hpp>
#include <span>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A class of one kind's inputs. The generator gives it to at least one case in `one_in`, by statement; a test
/// measures it.
struct InputClass {
  std::string name;
  std::uint64_t one_in;
  Reach reach =
      Reach::limited;  ///< required of fields that reach this far; beside: of those with a neighbour
};

/// The classes of a kind; bit i of a mask is entry i. Empty for what has no structure of its own.
const std::vector<InputClass>& classes_of(Kind kind);
bool requires_class(const Field& field, const InputClass& c);

/// The classes that the numbers of a field belong to. `earlier` is the field's neighbour, or empty.
template <class S>
std::uint32_t classify(Kind kind, std::span<const S> x, std::span<const S> earlier);

}  // namespace liecheck::properties
