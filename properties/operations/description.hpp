#pragma once
// The record of an operation: everything about it that is not code, written once.
//
// These follow from a record: the slot of a subject (Slots), the outputs of a law (exp6[block::rotation]),
// the definitions in the JSON record, the printed program of a failure, the inputs and calls of `cost`, and
// the table of docs/operations.md. To add an operation, write its record in this folder, measure it in a law,
// and fill its slot in the subjects that have it.

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace liecheck::properties {

/// A list of at most N values that can be a constant.
template <class T, std::size_t N>
struct Few {
  std::array<T, N> items{};
  std::size_t count = 0;
  constexpr Few() = default;
  constexpr Few(std::initializer_list<T> list) {
    for (const T& x : list) items[count++] = x;
  }
  constexpr const T* begin() const { return items.data(); }
  constexpr const T* end() const { return items.data() + count; }
  constexpr std::size_t size() const { return count; }
  constexpr const T& operator[](std::size_t i) const { return items[i]; }
};

/// The size of a part that the robot determines.
enum Size : int { nq = -1, nv = -2, nv_by_nv = -3, six_by_nv = -4, three_by_nv = -5 };

/// Consecutive numbers of one unit. Matrices are stored row by row.
struct Part {
  std::string_view name;
  int size = 0;  ///< or a Size
  std::string_view unit;
};

/// An argument or a result: its parts, its axes, and its type in a printed program ("" if it has one part).
struct Layout {
  std::string_view name;
  Few<Part, 4> parts;
  std::string_view frame;
  std::string_view type = "";
};

/// The name of a block. These constants are in namespace block, so that a misspelt name does not compile.
struct BlockName {
  std::string_view text;
};

/// A separately measured part of a result: error = numerator / denominator, in eps of the scalar.
struct Block {
  BlockName name;
  std::string_view error;        ///< the numerator
  std::string_view denominator;  ///< "absolute" for 1
  std::string_view unit;         ///< of the numerator
};

/// The call of liecheck's function in a printed program, with the arguments' names.
struct Call {
  std::string_view header;       ///< below liecheck/
  std::string_view expression;   ///< the program prints its value
  std::string_view before = "";  ///< a statement that must run first
};

struct Operation;

/// One block of one operation: what a law records, a budget limits and a row of the record reports.
struct Output {
  std::string_view operation, block;
  const Operation* record = nullptr;
  const Block* definition = nullptr;
};

struct Operation {
  std::string_view name;
  std::string_view definition;  ///< the defining equation
  std::string_view source;      ///< author, year, equation
  Few<const Layout*, 6> arguments;
  Few<const Layout*, 2> results;
  Few<Block, 6> blocks;
  Call call;

  /// Compile-time look-up: a block that the record lacks is a compile error.
  consteval Output operator[](BlockName block) const {
    for (const Block& b : blocks)
      if (b.name.text == block.text) return {name, block.text, this, &b};
    throw "the operation has no such block";
  }
};

}  // namespace liecheck::properties
