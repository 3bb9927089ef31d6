#pragma once
// Choices: where several results are right, libraries differ in which they return. A choice is no error. An adapter may
// state it, and is then held to it.

#include <conventions/probe.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::properties::conventions {

/// The value that promises nothing.
inline constexpr std::string_view free_choice = "free";

struct Choice {
  std::string_view name;
  std::vector<std::string_view>
      values;  ///< the first is what liecheck does, where it decides; the last is "free"
};
const std::vector<Choice>& choices();

/// The choice of this name, or null.
const Choice* choice_named(std::string_view name);

/// The value of `choice` that the result breaks, in words that name its number; "" if it keeps to it. Every result keeps
/// to a choice that does not concern its operation or its arguments. `epsilon` is that of the scalar.
std::string broken_choice(std::string_view choice, std::string_view value, const Operation& operation,
                          std::span<const double> arguments, std::span<const double> result, double epsilon);

/// Arguments at which the values of the choices differ, rounded to S; empty if no choice concerns the operation.
template <class S>
std::vector<Numbers> choice_arguments(const Operation& operation);

/// What the answers choose, each in a sentence, with the line that states it. `stated` is not named again.
std::vector<Finding> choices_made(const std::vector<Probed>& all,
                                  const std::map<std::string, std::string>& stated, double epsilon);

}  // namespace liecheck::properties::conventions
