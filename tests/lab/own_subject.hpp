#pragma once

#include <stdexcept>
#include <subjects/typed.hpp>

namespace liecheck::properties {

/// The subject liecheck in double.
inline const TypedSubject<double>& own_subject() {
  for (const auto* s : typed_subjects<double>())
    if (s->name == "liecheck") return *s;
  throw std::logic_error("liecheck is not registered");
}

}  // namespace liecheck::properties
