#pragma once
// The classes of inputs on which code breaks, for each kind of a group of numbers, and how rarely a generator may give
// each of them.

#include <cstdint>
#include <generators/input_layout.hpp>
#include <span>
#include <string>
#include <vector>

namespace liecheck::properties {

/// A class of one kind's inputs. The generator gives at least one case in `one_in` of it; a test measures this.
struct InputClass {
  std::string name;
  std::uint64_t one_in;
  Reach reach = Reach::limited;  ///< of the fields for which it is required
};

/// The classes of a kind; bit i of a mask is entry i. Empty for kinds without classes.
const std::vector<InputClass>& classes_of(Kind kind);
bool requires_class(const Field& field, const InputClass& c);

/// The mask of the classes of the numbers x. `earlier`: the previous group of the same kind, or empty.
template <class S>
std::uint32_t classify(Kind kind, std::span<const S> x, std::span<const S> earlier);

}  // namespace liecheck::properties
