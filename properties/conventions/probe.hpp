#pragma once
// Names the conventions in which a library differs from liecheck, from its answers at moderate arguments.
//
// An operation disagrees if a part of a result is wrong by more than a thousandth of its size. Then the table of
// conventions is searched for the cheapest explanation of all answers: a convention costs 1, an operation that
// deviates by one convention from the others 1.5, an operation that nothing explains 4.

#include <conventions/finding.hpp>
#include <conventions/values.hpp>
#include <string>

namespace liecheck::properties::conventions {

/// What a library answered. Arguments that it refused are left out.
struct Answer {
  Numbers arguments, result;
};
struct Probed {
  const Operation* operation;
  std::vector<Answer> answers;
};

/// Whether the first argument is an order of Euler angles. A library refuses the orders that it lacks.
bool has_order(const Operation& operation);

/// Generic arguments with rotation angles from 0.3 to 2.5, rounded to S, and with each order of Euler angles.
template <class S>
std::vector<Numbers> probe_arguments(const Operation& operation);

/// The conventions and then the unexplained operations; nothing if all answers are right.
std::vector<Finding> explain(const std::vector<Probed>& all);

}  // namespace liecheck::properties::conventions
