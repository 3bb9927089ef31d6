#pragma once

#include <stdexcept>
#include <string>
#include <subjects/typed.hpp>

namespace liecheck::properties {

/// The subject liecheck in double.
inline const TypedSubject<double>& own_subject() {
  for (const auto* s : typed_subjects<double>())
    if (s->name == "liecheck") return *s;
  throw std::logic_error("liecheck is not registered");
}

/// Registers a subject that has only what `plant` gives it.
inline Registered<double> registered(const std::string& name, void (*plant)(TypedOperations<double>&)) {
  TypedSubject<double> s;
  s.name = name;
  plant(s.operations);
  return Registered<double>(s);
}
/// Registers a subject whose only function is this one.
template <class Operation, class F>
Registered<double> registered(const std::string& name, const Operation& operation, F function) {
  TypedSubject<double> s;
  s.name = name;
  s.operations[operation] = function;
  return Registered<double>(s);
}

}  // namespace liecheck::properties
