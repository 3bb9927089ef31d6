#pragma once
// The known conventions in which libraries differ from liecheck. To add one, add its entry to table.cpp or
// functions.cpp.
//
// Most belong to a type of value: a function r = f(x) of a library is then r = encode(f(decode(x))), where `decode`
// turns the library's numbers into liecheck's. The others belong to what functions mean.

#include <conventions/values.hpp>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties::conventions {

using Function = std::function<Numbers(const Operation&, const Numbers& arguments)>;

/// How an adapter states a convention: {"quaternion": "wxyz"}, or liecheck's own: {"quaternion": "xyzw"}.
struct Statement {
  std::string_view name, value, of_liecheck;
};

/// An adapter may have converted one side only.
enum class Side { both, arguments, result };

struct Convention {
  std::string meaning;      ///< "twists are angular first"
  std::string_view advice;  ///< what to change in the adapter
  /// Turns a value in this convention into liecheck's, or does nothing to this kind of value.
  void (*decode)(Kind, std::span<double> value) = nullptr;
  /// The result of an operation that means something else, from the right functions.
  Numbers (*formula)(const Operation&, const Numbers& arguments, const Function& right) = nullptr;
  std::string_view operations = "";  ///< those that `formula` changes, each with a blank before and after
  Statement statement = {};
  /// Whether the conversion changes only the order and the signs of numbers, so that liecheck converts what states it.
  bool exact = false;
  /// Where `decode` applies. One side alone concerns operations that have values of the type on both.
  Side side = Side::both;
};

/// Conventions of values, of functions, and of values on one side only. If two explain the same numbers, the first is
/// the likelier. Those of values are decoded in this order.
const std::vector<Convention>& conventions();

/// The conventions of functions, the second part of the table.
std::vector<Convention> function_conventions();

}  // namespace liecheck::properties::conventions
