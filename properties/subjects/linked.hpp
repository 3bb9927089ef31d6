#pragma once
// Subjects that are made from copies of liecheck, if the laboratory is linked into the program.

#include <subjects/typed.hpp>

namespace liecheck::properties {

/// The subjects bug:NAME and alike:NAME, or null in a program into which they are not linked.
template <class S>
inline std::vector<TypedSubject<S>> (*linked_bugs)(const TypedOperations<S>& good) = nullptr;

/// The subjects history:NAME, or null in a program into which they are not linked.
inline std::vector<TypedSubject<double>> (*linked_history)(const TypedOperations<double>& good) = nullptr;

}  // namespace liecheck::properties
