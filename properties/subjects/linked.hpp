#pragma once
// Subjects that are made from copies of liecheck, if the laboratory is linked into the program.

#include <subjects/subject.hpp>

namespace liecheck::properties {

/// The subjects bug:NAME and alike:NAME, or null in a program into which they are not linked.
template <class S>
inline std::vector<Subject<S>> (*linked_bugs)(const Operations<S>& good) = nullptr;

/// The subjects history:NAME, or null in a program into which they are not linked.
inline std::vector<Subject<double>> (*linked_history)(const Operations<double>& good) = nullptr;

}  // namespace liecheck::properties
