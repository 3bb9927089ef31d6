#pragma once
// Registers a correct implementation of the algorithms on trees. The large ones are compiled for each scalar in a file of
// its own.

#include <correct/correct_tree_parts.hpp>

namespace liecheck::properties::correct {

/// Of<S> is the implementation in the scalar S.
template <template <class> class Of, class S>
struct RegisteredTree {
  RegisteredTree() {
    TypedSubject<S> s{Of<S>::name, Of<S>::version, {}};
    s.operations.tree = bind<Of<S>, S>;
    Registered<S>(std::move(s));
  }
};

}  // namespace liecheck::properties::correct
